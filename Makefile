# make demo   set up, then a first example, a picture of Atlas and a clip of the standing biped
# make test   set up, then the tests
# make docs   docs/_build/html, with a picture or clip of each example
# make wheel  a wheel that carries DART, and the source archive, in dist/; both as an index would check them
# make engine the same DART with -O3 -DNDEBUG in build/engine/prefix; then PYDART2_DART_PREFIX=build/engine/prefix make ...
# make test-debian13, make test-packaging, make test-third-party, make test-mujoco, make test-viewer, make test-launches, make test-solver,
#   make test-heaps, make fuzz, make soak, make mutations, make sanitize, make coverage, make bench   see tests/README.md
# Set-up (tools/setup.sh): Debian packages, .venv, build and install; what is done already is not done again.
PYTHON ?= python3
VENV := .venv
export PYTHON VENV

FUZZ_MODELS ?= 5000
FUZZ_LOADS ?= 20000
FUZZ_CALLS ?= 1000000
FUZZ_SECONDS ?= 300

.PHONY: demo test ahead docs test-debian13 test-packaging test-third-party test-mujoco test-viewer test-launches test-solver features fuzz mutations \
  test-limp test-heaps soak sanitize coverage \
  bench wheel engine lint setup clean

demo: setup
	$(VENV)/bin/python examples/hello_pydart.py
	$(VENV)/bin/python examples/inspect_skeleton.py data/sdf/atlas/atlas_v3_no_head.sdf
	$(VENV)/bin/python examples/view_skeleton.py data/sdf/atlas/atlas_v3_no_head.sdf --headless --output build/demo
	$(VENV)/bin/python examples/biped_stand.py --headless --steps 5000 --output build/demo
	@echo "a picture of Atlas:             build/demo/view_skeleton.png"
	@echo "a clip of the standing biped:   build/demo/biped_stand.webp"
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then echo "in a window:                    $(VENV)/bin/python examples/biped_stand.py"; fi

# If the process ends in the middle of a test, C++ has the last word: it is shown after all else, without pytest's frames.
test: setup ahead lint
	$(VENV)/bin/python -m pytest --capture=sys --numprocesses=2 --dist=loadfile --max-worker-restart=0 2>build/test.err || { status=$$?; \
	  grep -v -e '^Extension modules' -e '/_pytest/' -e '/pluggy/' -e '/xdist/' -e '/execnet/' build/test.err | tail -50 >&2; exit $$status; }

ahead: setup
	@mkdir -p build
	@nice $(VENV)/bin/python tests/compile_ahead.py >build/ahead.log 2>&1 &

docs: setup
	$(VENV)/bin/pip install --quiet -e '.[docs]' --no-build-isolation
	$(VENV)/bin/python -m sphinx -W --keep-going -q -b html docs docs/_build/html
	@echo "docs: docs/_build/html/index.html"

test-debian13:
	@tools/debian13.sh

test-packaging: setup
	$(VENV)/bin/python -m pytest -m packaging

test-solver: setup
	$(VENV)/bin/python -m pytest -m solver

test-viewer: setup
	for model in cubes chain fullbody1 softBodies atlas; do \
	  PYTHONPATH=tests QT_QPA_PLATFORM=offscreen $(VENV)/bin/python tests/gui/random_events.py 500 $$model >build/events-$$model.log \
	  && tail -1 build/events-$$model.log || exit 1; done

test-launches: setup
	$(VENV)/bin/python tests/soak/launches.py 500

# The limp human falls from 1,000 starts of 5 s and 20 of 60 s, at 1 and 2 ms; LIMP_STARTS=100 for fewer.
test-limp: setup
	$(VENV)/bin/python -m pytest -m soak -s tests/soak/test_soak.py -k limp

# 10,000 heaps of random bodies, 0.4 s each; each shape dropped on each other; what stands does so for 10 s.
test-heaps: setup
	$(VENV)/bin/python -m pytest -m soak tests/physics/test_heaps.py

soak: setup
	$(VENV)/bin/python -m pytest -m soak -s

# AddressSanitizer and UndefinedBehaviorSanitizer on our own code; what leaks; then ThreadSanitizer. TESTS=tests/unit for
# a part.
sanitize: setup
	tools/instrumented.sh sanitize $(VENV)/bin/pytest -p no:cacheprovider --ignore=tests/packaging $(TESTS)
	ASAN_OPTIONS=detect_leaks=1:fast_unwind_on_malloc=0 LSAN_OPTIONS=suppressions=tests/soak/leaks.supp PYTHONMALLOC=malloc \
	  tools/instrumented.sh sanitize $(VENV)/bin/python tests/soak/leaks.py
	tools/instrumented.sh threads $(VENV)/bin/python tests/crash/fuzz_threads.py 60

# Lines of pydart2/ and src/cpp/ that the tests reach; HTML in build/coverage/html.
coverage: setup
	find build/coverage -name '*.gcda' -delete 2>/dev/null || true
	tools/instrumented.sh coverage $(VENV)/bin/pytest -p no:cacheprovider --ignore=tests/packaging --cov=pydart2 --cov-report=term $(TESTS)
	mkdir -p build/coverage/html
	$(VENV)/bin/gcovr --root . --filter 'src/cpp/' --exclude-throw-branches --txt --html-details build/coverage/html/ \
	  --fail-under-line 90 build/coverage/cmake
	$(VENV)/bin/coverage report --data-file=build/coverage/.coverage --fail-under=95 --format=total

# The models in PyPI's pybullet (100 MB) and dm_control (60 MB), unpacked without installing them.
test-third-party: setup
	$(VENV)/bin/python tools/fetch_models.py build/third-party
	$(VENV)/bin/pip install --quiet pin example-robot-data
	$(VENV)/bin/python tests/models/what_loads.py build/third-party >docs/what-loads.md
	$(VENV)/bin/python -m pytest -m third_party

# The readers of MJCF with the oldest and the newest mujoco that the extra allows, each in a folder of its own.
OLDEST_MUJOCO = $(shell sed -n 's/^mjcf = \["mujoco>=\(.*\)"\]/\1/p' pyproject.toml)

test-mujoco: setup
	$(VENV)/bin/pip install --quiet --upgrade --no-deps --target build/mujoco-oldest mujoco==$(OLDEST_MUJOCO)
	$(VENV)/bin/pip install --quiet --upgrade --no-deps --target build/mujoco-newest mujoco
	for age in oldest newest; do \
	  PYTHONPATH=build/mujoco-$$age $(VENV)/bin/python -c 'import mujoco; print(mujoco.__file__, mujoco.__version__)' \
	  && PYTHONPATH=build/mujoco-$$age $(VENV)/bin/python -m pytest -q tests/unit/test_mjcf.py tests/models/test_mjcf_models.py \
	    tests/unit/test_exporting_mjcf.py tests/gui/test_mounted_cameras.py || exit 1; done

# The others' packages are big (1 GB), so they have a folder of their own.
features: setup
	$(PYTHON) -m venv build/features
	build/features/bin/pip install --quiet dartpy mujoco mujoco-mjx pin drake pybullet
	$(VENV)/bin/python tools/probe_features.py build/features/bin/python >build/features.md
	mv build/features.md docs/features.md

fuzz: setup
	$(VENV)/bin/python tests/crash/fuzz_models.py $(FUZZ_MODELS)
	$(VENV)/bin/python tests/crash/fuzz_loaders.py $(FUZZ_LOADS) 2>build/fuzz.log || { tail -50 build/fuzz.log; exit 1; }
	@tail -6 build/fuzz.log
	$(VENV)/bin/python tests/crash/fuzz_api.py $(FUZZ_CALLS)
	$(VENV)/bin/python tests/crash/fuzz_worlds.py $(FUZZ_CALLS)
	$(VENV)/bin/python tests/crash/fuzz_threads.py $(FUZZ_SECONDS)

# Small mistakes, one at a time, each with the tests beside it: which of them no test notices.
mutations: setup
	$(VENV)/bin/python tools/mutate.py $(FILES)

bench: setup
	$(VENV)/bin/pip install --quiet mujoco pin
	$(VENV)/bin/python benchmarks/run_all.py
	$(VENV)/bin/python benchmarks/rendering.py
	QT_QPA_PLATFORM=offscreen $(VENV)/bin/python benchmarks/window.py

wheel: setup
	$(VENV)/bin/python tools/make_wheel.py

engine:
	@tools/engine.sh

lint: setup
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy

setup:
	@tools/setup.sh

clean:
	rm -rf build $(VENV) *.egg-info pydart2/pydart2_api.py pydart2/pydart2_api.pyi pydart2/_pydart2_api.*.so pydart2/_try_load
