"""What a Skeleton is made of: each file uses those before it: structure, coordinates, dynamics."""
