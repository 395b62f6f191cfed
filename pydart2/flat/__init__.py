"""The original's 225 flat functions, as `pydart2.pydart2_api` has them. Frozen: what is new goes into the classes."""
