"""Rows without a check: those of drawing, and what is left out on purpose."""

from __future__ import annotations

#: What puts something on a screen; its checks need a renderer and are with it. Move a row from here to its check.
DRAWING = {
    "pydart2.gui",
    "world.World.render",
    "world.World.render_markers",
    "world.World.render_contacts",
    "skeleton.Skeleton.render",
    "skeleton.Skeleton.render_with_color",
    "marker.Marker.render",
    "shape.Shape.render",
    "contact.Contact.render",
    "gui.opengl.renderer.Renderer.render_box_two_points",
    "gui.opengl.scene.OpenGLScene(w,h,rot_quat,trans,window)",
    "pydart2_api.marker__render",
    "pydart2_api.collisionresult__renderContact",
    "pydart2_api.world__render",
    "pydart2_api.skeleton__render",
    "pydart2_api.skeleton__renderWithColor",
    "pydart2_api.shape__render",
}

_BUILDER = (
    "models come from files or from XML text; its one user's builder of bodies in code is not part of the original"
)
_LIMITS = "a learnt joint-limit model of one human figure, which its users have commented out"

#: Row → why there is nothing of this name.
LEFT_OUT = {
    "pydart2.sys": "an import that leaked, not an offer",
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
