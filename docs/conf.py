"""Settings of Sphinx. `make docs` builds docs/_build/html; warnings are errors."""

from __future__ import annotations

import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

project = "pydart2"
author = copyright = "the pydart2 authors"
release = version = version_of("pydart2")

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.viewcode", "generated_pages"]
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = f"pydart2 {release}"
html_static_path = ["_static"]
html_css_files = ["pydart2.css"]

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

suppress_warnings = ["ref.python"]  # short names in annotations that several modules have

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
autodoc_type_aliases = {"ArrayLike": "ArrayLike"}  # not the union of a dozen types that it is
autodoc_default_options = {"members": True, "ignore-module-all": True, "show-inheritance": True}
nb_execution_mode = "force"  # notebooks are kept without what they print
nb_execution_raise_on_error = True
nb_execution_timeout = 300

napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_custom_sections = [("Attributes", "params_style")]  # a list; by itself each would be a member once more
