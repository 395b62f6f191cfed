"""OpenGLScene in `scene`, the drawing interface of user code in `renderer`."""
