"""Each example runs without a window, from any folder, and what it claims is true; without its controller it is not."""

from __future__ import annotations

import importlib
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from PIL import Image

import pydart2
from pydart2.cli import main
from pydart2.cli.examples import example_names
from pydart2.resources import examples_folder

ATLAS = "./data/sdf/atlas/atlas_v3_no_head.sdf"
OPTIONS = {"view_skeleton": [ATLAS], "inspect_skeleton": [ATLAS]}

# How many things each finds true of itself, and lines that the original's documentation shows.
CLAIMS = {
    "balance": 1,
    "biped_jump": 2,
    "biped_stand": 3,
    "chain": 1,
    "contacts": 4,
    "foot_forces": 2,
    "grasp": 1,
    "gravity_compensation": 1,
    "headless_video": 2,
    "heap": 2,
    "hello_pydart": 1,
    "ik": 1,
    "inverse_dynamics": 1,
    "inspect_skeleton": 0,
    "keep_away": 1,
    "lidar": 1,
    "many_worlds": 2,
    "momentum": 1,
    "move_arm": 1,
    "pull": 2,
    "reach": 1,
    "rubble": 2,
    "save_restore": 1,
    "shapes": 8,
    "simple_tracking": 1,
    "soft_bodies": 2,
    "soft_cushion": 2,
    "three_thousand_shapes": 4,
    "view_skeleton": 0,
    "wall": 3,
}
WRITTEN = {"headless_video": ["pictures"]}
PRINTED = {
    "biped_jump": ["Example: bipedJump", "skeleton position OK", "create controller OK"],
    "biped_stand": [
        "MyWorld  OK",
        "'1'--'2': programmed interaction",
        "    '1': push forward",
        "    '2': push backward",
    ],
    "chain": ["pydart initialization OK", "pydart create_world OK"],
    "gravity_compensation": ["Example: gravity compensation", "pydart add_skeleton OK", "create controller OK"],
    "hello_pydart": ["Hello, PyDART!", "pydart initialization OK", "pydart create_world OK"],
    "ik": ["Example: inverse kinematics", "click step to rotate the target", ">>> theta = 0.1745"],
    "simple_tracking": ["World OK", "Skeleton = [Skeleton(0): drc_skeleton]", "create controller OK"],
    "view_skeleton": ["Pydart init OK", "World init OK", "Skeleton add OK", "    drag: rotate camera"],
}


def run(folder: Path, name: str, *options: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(examples_folder() / f"{name}.py"), *options]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=900)


def test_the_table_has_every_example() -> None:
    assert sorted(CLAIMS) == example_names()


@pytest.mark.parametrize("name", sorted(CLAIMS))
def test_example(name: str, tmp_path: Path) -> None:
    done = run(tmp_path, name, *OPTIONS.get(name, []), "--headless")
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    lines = done.stdout.splitlines()
    assert sum(line.startswith("ok: ") for line in lines) == CLAIMS[name], lines[-10:]
    assert set(PRINTED.get(name, [])) <= set(lines)
    assert "NG!!!!" not in lines  # a wrong gradient in ik
    files = sorted(path.name for path in tmp_path.iterdir())
    assert files == WRITTEN.get(name, [])


@pytest.mark.parametrize("name", ["chain", "ik"])
def test_pictures_and_clips(name: str, tmp_path: Path) -> None:
    """One picture at the end, and one before each 1/25 s, or each step of ik."""
    steps = {"chain": 1000, "ik": 2}[name]
    run(tmp_path, name, "--headless", "--steps", str(steps), "--output", "out").check_returncode()
    with Image.open(tmp_path / "out" / f"{name}.png") as picture, Image.open(tmp_path / "out" / f"{name}.webp") as clip:
        assert picture.size == clip.size == (640, 480)
        assert len(picture.convert("RGB").getcolors(maxcolors=640 * 480) or ()) > 100
        assert getattr(clip, "n_frames", 1) == {"chain": 6, "ik": 3}[name]


def test_the_jump_changes_its_pose_three_times(tmp_path: Path) -> None:
    """As in the documentation: at 0, 0.4 and 0.8 s."""
    done = run(tmp_path, "biped_jump", "--headless", "--steps", "1700")
    times = [float(t) for t in re.findall(r"^update pose! at (\S+)$", done.stdout, re.MULTILINE)]
    np.testing.assert_allclose(times, [0.0, 0.4, 0.8], atol=0.0006)
    assert done.stdout.splitlines()[-1] == "not checked: that takes 2600 steps"


def test_options_that_make_no_sense(tmp_path: Path) -> None:
    done = run(tmp_path, "chain", "--steps", "10")
    assert done.returncode == 2
    assert "--headless" in done.stderr


# The claims are not true of themselves


@pytest.fixture
def example(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> ModuleType:
    monkeypatch.syspath_prepend(str(examples_folder()))
    return importlib.import_module(request.param)


@pytest.mark.parametrize("example", ["chain"], indirect=True)
def test_an_undamped_chain_keeps_its_energy(example: ModuleType) -> None:
    world = pydart2.World(1.0 / 5000.0, "./data/skel/chain.skel")
    chain = world.skeletons[0]
    chain.set_positions(np.random.default_rng(0).random(chain.ndofs) - 0.5)
    start = example.energy(chain)
    world.step(5000)
    assert example.energy(chain) == pytest.approx(start, abs=0.01)
    assert not any(example.check(chain).values())


@pytest.mark.parametrize("example", ["simple_tracking"], indirect=True)
def test_without_stiffness_atlas_stays_as_it_is(example: ModuleType) -> None:
    world = pydart2.World(1.0 / 2000.0)
    world.set_gravity([0.0, 0.0, 0.0])
    atlas = world.add_skeleton(ATLAS)
    target = atlas.q
    target["l_arm_shy"] = -1.0
    controller = example.Controller(atlas)
    controller.target, controller.Kp = target, 0.0 * controller.Kp
    atlas.set_controller(controller)
    world.step(100)
    assert not any(example.check(atlas, target).values())


@pytest.mark.parametrize("example", ["gravity_compensation"], indirect=True)
def test_without_compensation_the_arms_of_pr2_fall(example: ModuleType) -> None:
    world = example.MyWorld()
    world.on_key_press("G")
    world.step(1000)
    assert not any(example.check(world).values())
    assert (
        np.linalg.norm(
            world.robot.body("l_gripper_palm_link").C - world.start[world.robot.bodynode_index("l_gripper_palm_link")]
        )
        > 0.1
    )


@pytest.mark.parametrize("example", ["biped_jump"], indirect=True)
def test_a_crouch_alone_is_no_jump(example: ModuleType) -> None:
    """Neither is leaving the ground a property of the model, nor of the first pose."""
    world = pydart2.World(1.0 / 2000.0, "./data/skel/fullbody1.skel")
    human = world.skeletons[1]
    controller = example.Controller(human, world.dt)
    controller.target_times = controller.target_times[:1]
    controller.jt.apply = lambda names, f: np.zeros(human.ndofs)
    human.set_controller(controller)
    world.step(1600)
    claims = example.check(world)
    assert not any(claims.values()), claims


# python -m pydart2 examples


def test_list(capsys: pytest.CaptureFixture[str]) -> None:
    main(["examples"])
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == example_names()
    assert all(len(line.split()) > 3 for line in lines)


def test_run_by_name(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "pydart2", "examples", "chain", "--headless", "--steps", "3"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.splitlines()[-1] == "not checked: that takes 15000 steps"


def test_an_unknown_name_is_answered_with_the_nearest() -> None:
    with pytest.raises(SystemExit, match=r"did you mean 'biped_stand'\?"):
        main(["examples", "biped_stnd"])


def test_copies_run_where_they_are_put(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["examples", "--copy", str(tmp_path / "mine")])
    copied = sorted(path.name for path in (tmp_path / "mine").iterdir())
    assert copied == sorted(path.name for path in examples_folder().glob("*.py"))
    command = [sys.executable, str(tmp_path / "mine" / "hello_pydart.py"), "--headless", "--steps", "3"]
    subprocess.run(command, cwd=tmp_path, capture_output=True, timeout=60, check=True)


def test_a_copy_never_writes_over_a_file(tmp_path: Path) -> None:
    (tmp_path / "chain.py").write_text("mine")
    with pytest.raises(SystemExit, match=r"chain\.py"):
        main(["examples", "--copy", str(tmp_path)])
    assert [path.name for path in tmp_path.iterdir()] == ["chain.py"]
    assert (tmp_path / "chain.py").read_text() == "mine"
