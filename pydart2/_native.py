"""The only importer of the extension inside the package."""

from pydart2.pydart2_api import (
    BodyNodeHandle,
    DofHandle,
    JointHandle,
    MarkerHandle,
    MeshHandle,
    ModelSource,
    NamedVector,
    ShapeHandle,
    ShapeNodeHandle,
    SkeletonHandle,
    SoftBodyHandle,
    WorldHandle,
    restart,
)

__all__ = [
    "BodyNodeHandle",
    "DofHandle",
    "JointHandle",
    "MarkerHandle",
    "MeshHandle",
    "ModelSource",
    "NamedVector",
    "ShapeHandle",
    "ShapeNodeHandle",
    "SkeletonHandle",
    "SoftBodyHandle",
    "WorldHandle",
    "restart",
]
