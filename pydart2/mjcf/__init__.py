"""MJCF files, compiled by MuJoCo itself (``pip install pydart2[mjcf]``) and built as skeletons.

Each tree of bodies with a joint is a skeleton; all geoms that cannot move are one more, ``static``, which weighs
nothing. Hinges and slides have MuJoCo's positions; several joints of one body become a chain of bodies without mass.
For free and ball joints `Coordinates` says how positions and velocities correspond. Ranges are enforced, bodies of one
skeleton collide as MuJoCo's filter says, sites are markers. What the engine has no counterpart of is named in one
warning.
"""

from pydart2.mjcf.coordinates import Coordinates
from pydart2.mjcf.model import MjcfModel

__all__ = ["Coordinates", "MjcfModel"]
