"""``python -m pydart2``."""

from pydart2.cli import main

if __name__ == "__main__":
    main()
