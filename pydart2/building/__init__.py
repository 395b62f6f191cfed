"""Worlds and skeletons without files: bodies, joints and shapes that a script adds.

>>> world.add_ground()
>>> world.add_box((0.2, 0.2, 0.2), mass=1.0, position=(0, 1, 0))
>>> arm = world.add_empty_skeleton("arm")
>>> arm.add_body("upper", joint="revolute", axis=(0, 0, 1)).add_capsule(0.05, 0.3)
"""
