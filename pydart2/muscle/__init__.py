"""Hill-type muscles that pull on the bodies of a skeleton.

>>> from pydart2.muscle import MTU, Route
>>> from pydart2.muscle.skeleton import MusculoSkeleton
>>> leg = world.add_skeleton("leg.urdf", MusculoSkeleton)
>>> leg.add_muscle(MTU(4000.0, 0.04, 6.0, 0.26, L_MTU=0.3), Route([("shank", [0, 0.2, 0]), ("foot", [-0.05, 0, 0])]))
>>> while world.t < 1.0:
...     leg.stimulate([0.5])
...     leg.apply_muscle_forces()
...     world.step()
"""

from pydart2.muscle.route import Route
from pydart2.muscle.tendon_unit import MusculoTendonUnit

MTU = MusculoTendonUnit

__all__ = ["MTU", "MusculoTendonUnit", "Route"]
