"""Brings the models of PyPI's pybullet without installing it: python fetch_models.py FOLDER."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path


def main() -> None:
    """Download the wheel and unpack ``pybullet_data``; nothing if it is there."""
    folder = Path(sys.argv[1])
    if (folder / "pybullet_data").is_dir():
        return
    with tempfile.TemporaryDirectory() as temporary:
        command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary", ":all:"]
        subprocess.run([*command, "--python-version", "3.11", "--dest", temporary, "pybullet"], check=True)
        (wheel,) = Path(temporary).glob("*.whl")
        with zipfile.ZipFile(wheel) as content:
            content.extractall(folder, [name for name in content.namelist() if name.startswith("pybullet_data/")])


if __name__ == "__main__":
    main()
