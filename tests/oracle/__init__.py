"""Answers from the same engine by other routes, for the tests to compare with.

``DartpyOracle``  Debian's own Python binding, run by Debian's Python in a child process.
``CppOracle``     a small C++ program for what that binding lacks: markers, soft bodies, VSK, filters, mimic.
``dart_model``    the path of a model of Debian's ``dart-doc`` package.
"""
