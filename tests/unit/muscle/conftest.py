"""A floating leg with muscles."""

from __future__ import annotations

from pathlib import Path

import pytest

import pydart2
from pydart2.muscle.skeleton import MusculoSkeleton

LINK = """
  <link name="{name}">
    <inertial>
      <origin xyz="0.01 -0.15 0.02"/>
      <mass value="{mass}"/>
      <inertia ixx="0.05" iyy="0.02" izz="0.06" ixy="0.001" ixz="0.002" iyz="0.003"/>
    </inertial>
  </link>
"""
JOINT = """
  <joint name="{name}" type="continuous">
    <origin xyz="0 -0.4 0"/>
    <axis xyz="{axis}"/>
    <parent link="{parent}"/>
    <child link="{child}"/>
  </joint>
"""


@pytest.fixture
def leg(tmp_path: Path) -> MusculoSkeleton:
    """Thigh, shank and foot, free in a world without gravity, bent."""
    parts = [
        LINK.format(name="thigh", mass=8.0),
        LINK.format(name="shank", mass=4.0),
        LINK.format(name="foot", mass=1.0),
        JOINT.format(name="knee", axis="0 0 1", parent="thigh", child="shank"),
        JOINT.format(name="ankle", axis="0 0.6 0.8", parent="shank", child="foot"),
    ]
    path = tmp_path / "leg.urdf"
    path.write_text(f'<robot name="leg">{"".join(parts)}</robot>')
    world = pydart2.World(0.001)
    world.set_gravity([0.0, 0.0, 0.0])
    skel = world.add_skeleton(path, MusculoSkeleton)
    skel.q = [0.3, -0.2, 0.5, 1.0, 2.0, 3.0, -0.6, 0.4]
    return skel
