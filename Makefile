# make demo   set up, then the first examples
# make test   set up, then the tests
# make wheel  a wheel that carries DART, and the source archive, in dist/
# make test-packaging, make bench   see tests/README.md
# Set-up (tools/setup.sh): Debian packages, .venv, build and install; what is done already is not done again.
PYTHON ?= python3
VENV := .venv
export PYTHON VENV

.PHONY: demo test test-packaging bench wheel lint setup clean

demo: setup
	$(VENV)/bin/python examples/hello_pydart.py
	$(VENV)/bin/python examples/inspect_skeleton.py data/sdf/atlas/atlas_v3_no_head.sdf

test: setup lint
	$(VENV)/bin/python -m pytest

test-packaging: setup
	$(VENV)/bin/python -m pytest -m packaging

bench: setup
	$(VENV)/bin/python benchmarks/step_overhead.py
	$(VENV)/bin/python benchmarks/reading.py
	$(VENV)/bin/pip install --quiet mujoco
	$(VENV)/bin/python benchmarks/rendering.py

wheel: setup
	$(VENV)/bin/python tools/make_wheel.py

lint: setup
	$(VENV)/bin/ruff check .
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/mypy

setup:
	@tools/setup.sh

clean:
	rm -rf build $(VENV) *.egg-info pydart2/pydart2_api.py pydart2/pydart2_api.pyi pydart2/_pydart2_api.*.so pydart2/_try_load
