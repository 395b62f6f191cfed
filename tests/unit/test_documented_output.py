"""The examples print what the original's documentation shows (§2.2.5, §2.2.1)."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pydart2

EXAMPLES = Path(pydart2.__file__).resolve().parent.parent / "examples"
ATLAS = "data/sdf/atlas/atlas_v3_no_head.sdf"
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[+-]?\d+)?")

# What the documentation prints for the first three bodies.
BODIES = [
    {
        "body": "[BodyNode(0): pelvis]",
        "mass": "17.8820Kg",
        "parent": "None",
        "childs": "[[BodyNode(1): ltorso], [BodyNode(9): l_uglut], [BodyNode(21): r_uglut]]",
        "COM": [0.0111, 0.0, 0.0271],
        "# dependent dofs": "6",
        "# shapenodes": "[[ShapeNode(0:0)], [ShapeNode(0:1)]]",
        "# markers": "0",
    },
    {
        "body": "[BodyNode(1): ltorso]",
        "mass": "2.4090Kg",
        "parent": "[BodyNode(0): pelvis]",
        "childs": "[[BodyNode(2): mtorso]]",
        "COM": [-2.37984000e-02, -3.15366000e-06, 7.46835000e-02],
        "# dependent dofs": "7",
        "# shapenodes": "[[ShapeNode(1:0)], [ShapeNode(1:1)]]",
        "# markers": "0",
    },
    {
        "body": "[BodyNode(2): mtorso]",
        "mass": "0.6900Kg",
        "parent": "[BodyNode(1): ltorso]",
        "childs": "[[BodyNode(3): utorso]]",
        "COM": [-0.02066266, -0.0131245, 0.1925674],
        "# dependent dofs": "8",
        "# shapenodes": "[[ShapeNode(2:0)], [ShapeNode(2:1)]]",
        "# markers": "0",
    },
]


def run(folder: Path, example: str, *arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, str(EXAMPLES / example), *arguments], cwd=folder, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def inspected(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """From a folder that does not hold the model."""
    return run(tmp_path_factory.mktemp("elsewhere"), "inspect_skeleton.py", ATLAS).splitlines()


def test_basic_information(inspected: list[str]) -> None:
    start = inspected.index("[Basic information]")
    assert inspected[start - 1] == "-----"
    assert inspected[start + 1 : start + 6] == [
        "\tmass = 146.554000",
        "\t# DoFs = 33",
        "[BodyNode]",
        "root_bodynode[0] = [BodyNode(0): pelvis]",
        "\t[BodyNode(0): pelvis]",
    ]


def test_header(inspected: list[str]) -> None:
    assert inspected[0] == f"skeleton path = {ATLAS}"
    for line in ("pydart init OK", "World init OK", "Skeleton add OK"):
        assert line in inspected
    assert "Msg [pydart2_api] Initialize pydart manager OK" in inspected
    gravity = next(line for line in inspected if line.startswith("gravity = "))
    np.testing.assert_allclose([float(x) for x in NUMBER.findall(gravity)], [0, 0, -9.8])


@pytest.mark.parametrize("expected", BODIES, ids=lambda b: b["body"])
def test_bodies(inspected: list[str], expected: dict[str, str | list[float]]) -> None:
    start = inspected.index(f"\t{expected['body']}")
    printed = dict(line.strip().split(" = ", 1) for line in inspected[start + 1 : start + 8])
    com = [float(x) for x in NUMBER.findall(printed.pop("COM"))]
    np.testing.assert_allclose(com, expected["COM"], atol=1e-7)
    assert printed == {k: v for k, v in expected.items() if k not in ("body", "COM")}


def test_every_dof_belongs_to_a_joint(inspected: list[str]) -> None:
    lines = [line for line in inspected if " belongs to " in line]
    assert len(lines) == 33
    for i, line in enumerate(lines):
        assert re.fullmatch(rf"\t\[Dof\({i}\): \w+\] belongs to \[\w+Joint\(\d+\): \w+\]", line), line


def test_usage(tmp_path: Path) -> None:
    assert run(tmp_path, "inspect_skeleton.py") == "Usage: inspect_skeleton.py [*urdf/*sdf]\n"


def test_hello_pydart(tmp_path: Path) -> None:
    """2 s in steps of 1/2000 s, a line whenever the number of frames is a multiple of 100."""
    lines = run(tmp_path, "hello_pydart.py").splitlines()
    assert lines[0] == "Hello, PyDART!"
    assert lines[2:4] == ["pydart initialization OK", "pydart create_world OK"]
    rows = [re.fullmatch(r"(\d\.\d{4})s: The last cube COM = \[(.*)\]", line) for line in lines[4:]]
    assert all(rows)
    times = [float(row[1]) for row in rows if row]
    np.testing.assert_allclose(times, (100 * np.arange(1, 41) - 1) / 2000, atol=5.1e-5)
    heights = [float(row[2].split()[1]) for row in rows if row]
    assert heights[0] == pytest.approx(-0.195 - 0.5 * 9.81 * (99 * 100) / 2000**2, abs=1e-6)  # it falls freely yet
    assert heights[-1] > -0.35  # and does not fall through the floor
    assert heights[-1] == pytest.approx(heights[-2], abs=1e-4)
