"""Homogeneous transforms, quaternions, Euler angles and an arcball.

Names and conventions are those of C. Gohlke's transformations.py; the code is on NumPy and SciPy's Rotation.

- A transform is a matrix of shape (4, 4), row-major, for column vectors: ``M @ [x, y, z, 1]``.
- A quaternion is ``[w, x, y, z]``, shape (4,); SciPy has w last.
- Angles are in radians (orthogonalization_matrix() excepted).
- A point or a direction is a vector of shape (3,); of (4,) the last number is not used.
- Euler angles come with axes: 's' for static (extrinsic) or 'r' for rotating (intrinsic) and three letters in the
  order of rotation, such as 'sxyz' or 'rzxz'; all 24 are allowed. The same as four numbers: (first axis, parity,
  repetition, frame) where the axis is 0 to 2; parity is 0 if the next one follows it in x y z x, else 1; repetition is
  1 if the last axis is the first one; frame is 0 for static and 1 for rotating; for a rotating frame it is the last
  letter of the name that is the first axis: 'rzyx' is (0, 0, 0, 1).
- What ..._from_matrix() returns makes the same matrix again; a matrix of another kind is a ValueError.
"""

from pydart2.utils.transformations._arcball import (
    Arcball,
    arcball_constrain_to_axis,
    arcball_map_to_sphere,
    arcball_nearest_axis,
)
from pydart2.utils.transformations._compose import (
    compose_matrix,
    decompose_matrix,
    orthogonalization_matrix,
)
from pydart2.utils.transformations._euler import (
    euler_from_matrix,
    euler_from_quaternion,
    euler_matrix,
    quaternion_from_euler,
)
from pydart2.utils.transformations._fit import affine_matrix_from_points, superimposition_matrix
from pydart2.utils.transformations._matrices import (
    concatenate_matrices,
    identity_matrix,
    inverse_matrix,
    is_same_transform,
    reflection_from_matrix,
    reflection_matrix,
    rotation_from_matrix,
    rotation_matrix,
    scale_from_matrix,
    scale_matrix,
    shear_from_matrix,
    shear_matrix,
    translation_from_matrix,
    translation_matrix,
)
from pydart2.utils.transformations._projection import clip_matrix, projection_from_matrix, projection_matrix
from pydart2.utils.transformations._quaternions import (
    quaternion_about_axis,
    quaternion_conjugate,
    quaternion_from_matrix,
    quaternion_imag,
    quaternion_inverse,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_real,
    quaternion_slerp,
    random_quaternion,
    random_rotation_matrix,
)
from pydart2.utils.transformations._vectors import (
    angle_between_vectors,
    random_vector,
    unit_vector,
    vector_norm,
    vector_product,
)

__version__ = "2015.07.18"  # of the interface

__all__ = [
    "Arcball",
    "affine_matrix_from_points",
    "angle_between_vectors",
    "arcball_constrain_to_axis",
    "arcball_map_to_sphere",
    "arcball_nearest_axis",
    "clip_matrix",
    "compose_matrix",
    "concatenate_matrices",
    "decompose_matrix",
    "euler_from_matrix",
    "euler_from_quaternion",
    "euler_matrix",
    "identity_matrix",
    "inverse_matrix",
    "is_same_transform",
    "orthogonalization_matrix",
    "projection_from_matrix",
    "projection_matrix",
    "quaternion_about_axis",
    "quaternion_conjugate",
    "quaternion_from_euler",
    "quaternion_from_matrix",
    "quaternion_imag",
    "quaternion_inverse",
    "quaternion_matrix",
    "quaternion_multiply",
    "quaternion_real",
    "quaternion_slerp",
    "random_quaternion",
    "random_rotation_matrix",
    "random_vector",
    "reflection_from_matrix",
    "reflection_matrix",
    "rotation_from_matrix",
    "rotation_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_from_matrix",
    "shear_matrix",
    "superimposition_matrix",
    "translation_from_matrix",
    "translation_matrix",
    "unit_vector",
    "vector_norm",
    "vector_product",
]
