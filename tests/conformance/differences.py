"""Where a row deliberately does something else than the original did, and why."""

from __future__ import annotations

_MISTAKE = "the original did something else by mistake: "
_CRASH = "the original crashed or went on with what was in memory: "
_IGNORED = "the original printed a line and went on: "

#: Row → what differs, with the reason.
DIFFERENCES = {
    # The package
    "pydart2.init": "may be left out; worlds from before it raise DestroyedError. " + _CRASH + "it had to come first",
    "pydart2.__version__": "a string, the version of the installed package; three versions contradicted each other",
    "pydart2.utils": "imported on first use, so that `import pydart2` needs NumPy only",
    # Worlds
    "world.create_world": _MISTAKE + "its path can be left out; the default raised TypeError",
    "world.World": _CRASH + "a file that is missing or cannot be read is a LoadError",
    "world.World.CLASS_SKELETON": _MISTAKE + "a subclass's own one counts",
    "world.World.add_skeleton": _CRASH + "LoadError; it also takes SKEL files, and paths among the package's models",
    "world.World.destroy": _CRASH + "any later use raises DestroyedError",
    "world.World.set_states": "the wrong length is a ValueError; the original set as many skeletons as there were",
    "world.World.check_collision": _MISTAKE + "it changes nothing but the contacts",
    "world.World.set_collision_detector": "an unknown one is a ValueError, not an AssertionError, which is for bugs",
    "world.World.collision_detector_string": _MISTAKE + "right for ODE too, where it raised IndexError",
    "recording.Recording": "keeps the newest frames up to a memory limit, since steps of long runs filled the memory",
    "recording.Recording.set_frame": "False for a frame that the limit dropped; num_frames() counts it still",
    # Skeletons
    "skeleton.Skeleton.set_positions": _IGNORED + "the wrong length is a ValueError",
    "skeleton.Skeleton.set_velocities": _IGNORED + "the wrong length is a ValueError",
    "skeleton.Skeleton.set_forces": _IGNORED + "the wrong length is a ValueError",
    "skeleton.Skeleton.forces": _MISTAKE + "zeros before the first set_forces(), where it raised AttributeError",
    "skeleton.Skeleton.position_differences": _MISTAKE + "it was exchanged with velocity_differences",
    "skeleton.Skeleton.velocity_differences": _MISTAKE + "it was exchanged with position_differences",
    "skeleton.Skeleton.linear_momentum": _MISTAKE + "it raised AttributeError",
    "skeleton.Skeleton.bodynode": _MISTAKE + "takes integers, of NumPy too; what is not there or makes no sense raises",
    "skeleton.Skeleton.body": _MISTAKE + "takes integers, of NumPy too; what is not there or makes no sense raises",
    "skeleton.Skeleton.joint": _IGNORED + "what is not there or makes no sense raises; NumPy's integers are integers",
    "skeleton.Skeleton.dof": _IGNORED + "what is not there or makes no sense raises; NumPy's integers are integers",
    # Vectors
    "skel_vector.SkelVector: v[i:j:k]": _MISTAKE + "a slice has the names of its entries",
    "skel_vector.SkelVector: v[ndarray]": _MISTAKE + "what is picked has the names of its entries",
    "skel_vector.SkelVector: v[mask]": _MISTAKE + "what is picked has the names of its entries",
    "skel_vector.SkelVector: repr(v)": "a table of names and numbers helps more than the numbers alone",
    # Bodies and joints
    "bodynode.BodyNode.set_mass": _CRASH + "a mass that is not positive is a ValueError",
    "bodynode.BodyNode.set_inertia": "a matrix that is not symmetric is a ValueError; the original read its upper half",
    "bodynode.BodyNode.jacobian": _MISTAKE + "zeros for a body that no dof moves, where it raised IndexError",
    "bodynode.BodyNode.expand_jacobian": _MISTAKE + "takes a Jacobian without columns",
    "joint.Joint.set_name": _MISTAKE + "`name`, the dictionary and the names of dofs follow",
    "joint.Joint.set_actuator_type": "an unknown one is a ValueError; the numbers stay, the engine's have changed",
    "joint.UniversalJoint.axis1_in_world_frame": _MISTAKE + "also at a root and behind an offset",
    "joint.UniversalJoint.axis2_in_world_frame": _MISTAKE + "also at a root and behind an offset",
    "joint.EulerJoint.set_axis_order": _IGNORED + "an unknown order is a ValueError",
    "joint.create_joint": "a plain Joint for a type without a class; the original gave None, and failed later",
    "marker.Marker.p": _MISTAKE + "the position, not the method",
    "shape.create_shape": "a plain Shape for a kind without a class; the original gave None",
    "shape.SphereShape.set_radius": _CRASH + "a radius that is not positive is a ValueError",
    # Contacts and muscles
    "collision_result.CollisionResult.contacted_bodies": "in the order of the contacts, so that runs are alike",
    "contact.Contact.bodynode1": "None for a skeleton that the world has no object for, where it raised IndexError",
    "contact.Contact.bodynode2": "None for a skeleton that the world has no object for, where it raised IndexError",
    "muscle.skeleton.MusculoSkeleton.update": _MISTAKE + "it raised AttributeError",
    "muscle.route.Route.__repr__": _MISTAKE + "also before the route is initialised",
    # Flat functions
    "pydart2_api.IntVector": "a list",
    "pydart2_api.world__getTime": _CRASH + "an id that is not there is an IndexError, in all of these functions",
    "pydart2_api.world__addSkeleton": _CRASH + "LoadError, where it returned -1",
    "pydart2_api.revolute_joint__getAxis": _CRASH
    + "TypeError for a joint or shape that has no such thing, in all of them",
    "pydart2_api.euler_joint__getAxisOrder": "TypeError for another joint, where it returned a sentence",
    "pydart2_api.skeleton__getPositions": _CRASH + "the wrong length is a ValueError, in all of these functions",
    "pydart2_api.skeleton__getMassMatrix": _CRASH + "an `out` of the wrong shape is a ValueError, in all of these",
}
