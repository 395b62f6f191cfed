#!/bin/sh
# A second build of the extension, beside the installed one, and a command that runs with it:
#   tools/instrumented.sh sanitize|threads|coverage COMMAND...
# It runs in build/KIND, a copy of the sources with that build in place, so that whatever the command starts finds it.
# The engine's own libraries stay as Debian built them.
set -eu
cd "$(dirname "$0")/.."
kind=$1
shift
folder=$PWD/build/$kind
installed=$PWD/pydart2
python=$PWD/${VENV:-.venv}/bin/python

mkdir -p "$folder/pydart2"
git ls-files -z --cached --others --exclude-standard | xargs -0 cp -u --parents -t "$folder"
ln -sfn "$PWD/${VENV:-.venv}" "$folder/.venv"
mkdir -p "$folder/build"
ln -sfn "$PWD"/build/cmake-* "$folder/build/" # whose library the programs of the tests link
cmake -S . -B "$folder/cmake" -DPYDART2_INSTRUMENT="$kind" -DPYDART2_OUTPUT_DIR="$folder/pydart2" \
  -DPython3_EXECUTABLE="$python" >"$folder/cmake.log"
cmake --build "$folder/cmake" --parallel "$(nproc)" --target pydart2_api pydart2_stub >>"$folder/cmake.log"

cd "$folder"
export PYTHONPATH="$folder"
# The helper that tries models is the installed one: it limits its memory, and the sanitizers want terabytes of addresses.
printf '#!/bin/sh\nunset LD_PRELOAD\nexec "%s" "$@"\n' "$installed/_try_load" >pydart2/_try_load
chmod +x pydart2/_try_load
# Python is not instrumented, so the sanitizers come first.
if [ "$kind" = sanitize ]; then
  export LD_PRELOAD="$(gcc -print-file-name=libasan.so) $(gcc -print-file-name=libstdc++.so.6)"
  export ASAN_OPTIONS="detect_leaks=0:detect_container_overflow=0:abort_on_error=1:${ASAN_OPTIONS:-}"
  export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1"
elif [ "$kind" = threads ]; then
  export LD_PRELOAD="$(gcc -print-file-name=libtsan.so) $(gcc -print-file-name=libstdc++.so.6)"
  export TSAN_OPTIONS="suppressions=$folder/tests/crash/threads.supp:${TSAN_OPTIONS:-}"
fi
exec "$@"
