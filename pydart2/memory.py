"""How much memory there is, and how much of it this process has."""

from __future__ import annotations

import resource
from pathlib import Path


def resident_bytes() -> int:
    """What this process has in memory."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


def available_bytes() -> int:
    """What it may still take: what the machine has free, or less where it is limited (``ulimit -v``)."""
    lines = Path("/proc/meminfo").read_text().splitlines()
    free = next(int(line.split()[1]) * 1024 for line in lines if line.startswith("MemAvailable:"))
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    if limit == resource.RLIM_INFINITY:
        return free
    return min(free, limit - int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize())
