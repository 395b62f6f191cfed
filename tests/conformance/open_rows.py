"""Rows without a check here: those of drawing, and what is left out on purpose."""

from __future__ import annotations

_PARTS = "gui.test_ri.test_parts_draw_themselves"
_FLAT = "gui.test_ri.test_flat_functions_draw_the_same"

#: What puts something on a screen → the test of pictures that checks it.
DRAWING = {
    "pydart2.gui": "gui.test_offscreen.test_render_function",
    "world.World.render": _PARTS,
    "world.World.render_markers": _PARTS,
    "world.World.render_contacts": _PARTS,
    "skeleton.Skeleton.render": _PARTS,
    "skeleton.Skeleton.render_with_color": "gui.test_ri.test_world_with_render_of_its_own",
    "marker.Marker.render": _PARTS,
    "shape.Shape.render": _PARTS,
    "contact.Contact.render": _PARTS,
    "gui.opengl.renderer.Renderer.render_box_two_points": "gui.test_ri.test_bodies_have_their_extent",
    "pydart2_api.marker__render": _FLAT,
    "pydart2_api.collisionresult__renderContact": _FLAT,
    "pydart2_api.world__render": _FLAT,
    "pydart2_api.skeleton__render": _FLAT,
    "pydart2_api.skeleton__renderWithColor": _FLAT,
    "pydart2_api.shape__render": _FLAT,
}

_BUILDER = (
    "models come from files or from XML text; its one user's builder of bodies in code is not part of the original"
)
_LIMITS = "a learnt joint-limit model of one human figure, which its users have commented out"

#: Row → why there is nothing of this name.
LEFT_OUT = {
    "pydart2.sys": "an import that leaked, not an offer",
    "gui.opengl.scene.OpenGLScene(w,h,rot_quat,trans,window)": "one fork's order of arguments, against the original's; "
    "OpenGLScene.replace_camera sets the view",
    "ik.IK": "minimising a distance with scipy.optimize over q takes as few lines as its set-up",
    "constraints.HumanArmJointLimitConstraint": _LIMITS,
    "constraints.HumanLegJointLimitConstraint(thighJoint, shinJoint, ankleJoint, mirror)": _LIMITS,
    "constraints.BallJointConstraintV2": "BallJointConstraint and World.remove_all_constraints do it",
    "constraints.NonHolonomicContactConstraint[V2]": "a research constraint of one fork that needs its patched engine",
    "skeleton.Skeleton.add_box": _BUILDER,
    "skeleton.Skeleton.set_box_size": "BoxShape.set_size does it",
    "skeleton_builder": _BUILDER,
    "skeleton_builder.SkeletonBuilder.set_collision_filter": "World.collision_filter does it",
    "skeleton_builder.SkeletonBuilder.reset_momentum": "Skeleton.set_velocities does it",
    "world.World.add_empty_skeleton": _BUILDER,
    "world.World.add_capsule": _BUILDER,
    "world.World.add_weld_box": _BUILDER,
    "world.World.add_built_skeleton": _BUILDER,
}
