"""A window by GLUT, for programs that have a GLUT loop of their own."""
