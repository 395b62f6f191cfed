#!/bin/sh
# From a bare Debian 12 to an installed checkout: Debian packages, .venv, build and install. Says what it does; does
# nothing twice. PYTHON is the interpreter that .venv is made with.
set -eu
cd "$(dirname "$0")/.."
python=${PYTHON:-python3}
venv=${VENV:-.venv}

say() { echo "setup: $*"; }

# To build, and to make a virtual environment with Debian's own Python.
packages="g++ cmake make swig libdart-all-dev python3-venv python3-dev"
# For tests: DART's own models, the oracle, a bare system.
packages="$packages dart-doc python3-dartpy python3-numpy debootstrap"
# To draw (EGL, OSMesa, Mesa's drivers), and for tests of windows.
packages="$packages libegl1 libgl1 libglx-mesa0 libgl1-mesa-dri libosmesa6 freeglut3-dev xvfb xauth fonts-dejavu-core"
# What Qt wants of X.
packages="$packages libxcb-icccm4 libxcb-image0 libxcb-keysyms1 libxcb-render-util0 libxcb-shape0 libxcb-xinerama0"
packages="$packages libxcb-xkb1 libxkbcommon-x11-0 libdbus-1-3 libfontconfig1 libfreetype6 libglib2.0-0"
missing=
for package in $packages; do
  dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
done
if [ -n "$missing" ]; then
  say "installing Debian packages:$missing"
  sudo=
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || { say "run as root, or install:$missing"; exit 1; }
    sudo=sudo
  fi
  $sudo apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends $missing >/dev/null
fi

if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
  say "pydart2 needs Python 3.11 or newer; set PYTHON to one (make PYTHON=python3.12 ...)"
  exit 1
fi
if [ ! -x "$venv/bin/pip" ]; then
  say "making $venv with $("$python" --version)"
  "$python" -m venv "$venv"
fi

# The build's own requirements, then the package with all that its tests need; again when one of its sources changes.
if [ -z "$(find "$venv/.requirements" -newer pyproject.toml 2>/dev/null)" ]; then
  say "installing the build requirements"
  "$venv/bin/pip" install --quiet --upgrade 'setuptools>=77' 'numpy>=2.0'
  touch "$venv/.requirements"
fi
newer=$(find setup.py pyproject.toml CMakeLists.txt src swig tools/make_stub.py "$venv/.requirements" \
  -newer "$venv/.installed" 2>/dev/null || echo all)
prefix=${PYDART2_DART_PREFIX:-} # of another DART than Debian's (make engine)
if [ "$(cat "$venv/.installed" 2>/dev/null || echo none)" != "$prefix" ] || [ -n "$newer" ] || ! ls pydart2/_pydart2_api.*.so >/dev/null 2>&1; then
  say "building and installing pydart2 (a minute or two)"
  "$venv/bin/pip" install --quiet --no-build-isolation -e '.[dev]'
  echo "$prefix" >"$venv/.installed"
fi
say "ready"
