"""The extension by its old top-level name: ``import _pydart2_api`` is ``import pydart2.pydart2_api``."""

import sys

from pydart2 import pydart2_api

sys.modules[__name__] = pydart2_api
