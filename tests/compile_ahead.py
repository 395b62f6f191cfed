"""Compiles the C++ programs of the tests, beside the first tests: `make test` starts it. Who needs one waits for it."""

from __future__ import annotations

from oracle import cpp_oracle
from solver import program

if __name__ == "__main__":
    cpp_oracle.build(cpp_oracle.BUILD)
    program.build(1)
