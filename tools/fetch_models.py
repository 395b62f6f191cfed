"""Brings the models of PyPI's pybullet and dm_control without installing them: python fetch_models.py FOLDER."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

PARTS = {"pybullet": "pybullet_data/", "dm_control": "dm_control/"}


def fetch(package: str, part: str, folder: Path) -> None:
    """Download a wheel and unpack the part with the models; nothing if it is there."""
    if (folder / part).is_dir():
        return
    with tempfile.TemporaryDirectory() as temporary:
        command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary", ":all:"]
        subprocess.run([*command, "--python-version", "3.11", "--dest", temporary, package], check=True)
        (wheel,) = Path(temporary).glob("*.whl")
        with zipfile.ZipFile(wheel) as content:
            content.extractall(folder, [name for name in content.namelist() if name.startswith(part)])


def main() -> None:
    """Fetch all."""
    for package, part in PARTS.items():
        fetch(package, part, Path(sys.argv[1]))


if __name__ == "__main__":
    main()
