"""Skeletons and worlds as the text of model files, which load as what they were.

>>> robot.save("robot.urdf")
>>> text = robot.to_skel()

What a format cannot hold is an ExportError where things would move or collide otherwise, and else one warning that
names all of it.
"""
