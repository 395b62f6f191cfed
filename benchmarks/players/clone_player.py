"""Debian's dartpy copies a skeleton: clone_player.py MODEL COPIES ROUNDS; ms of CPU time a copy, a line a round."""

from __future__ import annotations

import sys
import time

from dartpy_player import load_robot


def main() -> None:
    """Without freeing what it makes."""
    robot, copies = load_robot(sys.argv[1]), int(sys.argv[2])
    for _ in range(int(sys.argv[3])):
        begin = time.thread_time()
        made = [robot.clone() for _ in range(copies)]
        print((time.thread_time() - begin) / copies * 1e3)
        del made


if __name__ == "__main__":
    main()
