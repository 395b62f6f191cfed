"""Inspect skeleton: its bodies, joints, dofs, shapes and markers.

python inspect_skeleton.py data/sdf/atlas/atlas_v3_no_head.sdf
"""

import sys

from _headless import arguments, rehearse

import pydart2 as pydart


def main(skel_path: str) -> pydart.World:
    """Print everything about the skeleton of a URDF or SDF file; returns its world."""
    print(f"skeleton path = {skel_path}")

    pydart.init()
    print("pydart init OK")

    world = pydart.World(1.0 / 1000.0)
    print("World init OK")

    world.g = [0.0, 0.0, -9.8]
    print(f"gravity = {world.g}")

    skel = world.add_skeleton(skel_path)
    print("Skeleton add OK")

    print("-----")
    print("[Basic information]")
    print(f"\tmass = {skel.m:.6f}")
    print(f"\t# DoFs = {skel.ndofs}")
    print_bodies(skel)
    print_joints(skel)
    print_vectors(skel)
    print("-----")
    return world


def print_bodies(skel: pydart.Skeleton) -> None:
    """The tree of bodies."""
    print("[BodyNode]")
    print(f"root_bodynode[0] = {skel.root_bodynode(index=0)}")
    for body in skel.bodynodes:
        print(f"\t{body}")
        print(f"\t\tmass = {body.m:.4f}Kg")
        print(f"\t\tparent = {body.parent_bodynode}")
        print(f"\t\tchilds = {body.child_bodynodes}")
        print(f"\t\tCOM = {body.C}")
        print(f"\t\t# dependent dofs = {len(body.dependent_dofs)}")
        print(f"\t\t# shapenodes = {body.shapenodes}")
        print(f"\t\t# markers = {len(body.markers)}")


def print_joints(skel: pydart.Skeleton) -> None:
    """Dofs, joints and markers."""
    print("[DegreeOfFreedom]")
    for dof in skel.dofs:
        print(f"\t{dof} belongs to {dof.joint}")

    print("[Joint]")
    for joint in skel.joints:
        print(f"\t{joint}")
        print(f"\t\tparent = {joint.parent_bodynode}")
        print(f"\t\tchild = {joint.child_bodynode}")
        print(f"\t\tdofs = {joint.dofs}")

    print("[Markers]")
    for marker in skel.markers:
        print(f"\t{marker} attached to {marker.bodynode}")
        print(f"\t\t{marker.world_position()}")


def print_vectors(skel: pydart.Skeleton) -> None:
    """State, limits, mass matrix and forces."""
    print("[Position]")
    print(f"\tpositions = {skel.q}")
    print(f"\tvelocities = {skel.dq}")
    print(f"\tstates = {skel.x}")

    print("[Limits]")
    print(f"\tposition_lower_limits = {skel.q_lower}")
    print(f"\tposition_upper_limits = {skel.q_upper}")
    print(f"\tforce_lower_limits = {skel.tau_lower}")
    print(f"\tforce_upper_limits = {skel.tau_upper}")

    print("[Lagrangian]")
    print(f"\tmass matrix = {skel.M}")
    print(f"\tcoriolis_and_gravity_forces = {skel.c}")
    print(f"\tconstraint_forces = {skel.constraint_forces()}")


if __name__ == "__main__":
    args = arguments(model=True)
    if args.model is None:
        print("Usage: inspect_skeleton.py [*urdf/*sdf]")
        sys.exit(0)
    world = main(args.model)
    if args.headless:
        rehearse(world, args, steps=0, camera=None)
