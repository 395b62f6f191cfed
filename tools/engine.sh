#!/bin/sh
# Builds Debian's own source package of DART again, the version that is installed and with Debian's patches, but with
# -O3 -DNDEBUG and without gui, into build/engine/prefix. Takes 10 to 30 minutes; done already, it does nothing.
# JOBS: compilers at a time, default all processors.
set -eu
cd "$(dirname "$0")/.."
build=$PWD/build/engine
prefix=$build/prefix

say() { echo "engine: $*"; }

version=$(dpkg-query -W -f '${source:Version}' libdart-dev 2>/dev/null) || { say "first run: make setup"; exit 1; }
if [ "$(cat "$prefix/.version" 2>/dev/null)" = "$version" ]; then
  say "dart $version is in $prefix"
  exit 0
fi
for program in apt-get dpkg-source cmake c++; do
  command -v "$program" >/dev/null || { say "needs $program: apt-get install apt dpkg-dev cmake g++"; exit 1; }
done
mkdir -p "$build/apt/sources" "$build/apt/lists/partial"

# The machine's own package sources, asked for source packages; nothing outside build/ is changed.
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
  [ ! -e "$list" ] || sed 's/^deb /deb-src /' "$list" >"$build/apt/sources/$(basename "$list").list"
done
for list in /etc/apt/sources.list.d/*.sources; do
  [ ! -e "$list" ] || sed 's/^Types:.*/Types: deb-src/' "$list" >"$build/apt/sources/$(basename "$list")"
done
apt() {
  apt-get -qq -o "Dir::Etc::SourceList=/dev/null" -o "Dir::Etc::SourceParts=$build/apt/sources" \
    -o "Dir::State::Lists=$build/apt/lists" -o "APT::Sandbox::User=" "$@"
}
say "fetching the source package dart $version"
apt update
(cd "$build" && rm -rf dart-* && apt source --only-source "dart=$version" >apt.log)
source=$(find "$build" -maxdepth 1 -type d -name 'dart-*')

# Without its tests, examples and Python binding, which would want more packages.
for part in unittests examples tutorials python; do : >"$source/$part/CMakeLists.txt"; done
# Without gui and optimisers, which nothing here links: skipped where they are installed, said to be missing where DART's
# own files forget to.
cmake -S "$source" -B "$build/cmake" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" \
  -DCMAKE_INSTALL_LIBDIR=lib "-DCMAKE_INSTALL_RPATH=\$ORIGIN" -DBUILD_SHARED_LIBS=ON -DDART_BUILD_GUI_OSG=OFF \
  $(for part in OPENGL GLUT IPOPT NLOPT FLANN PAGMO DOXYGEN; do echo "-DDART_SKIP_$part=ON -D${part}_FOUND=OFF"; done) >"$build/configure.log" 2>&1 || {
  tail -20 "$build/configure.log"
  exit 1
}
say "building (log: $build/build.log)"
nice cmake --build "$build/cmake" --parallel "${JOBS:-$(nproc)}" >"$build/build.log" 2>&1 || {
  tail -20 "$build/build.log"
  exit 1
}
cmake --install "$build/cmake" >"$build/install.log"
echo "$version" >"$prefix/.version"
say "dart $version is in $prefix; to use it: PYDART2_DART_PREFIX=$prefix make setup"
