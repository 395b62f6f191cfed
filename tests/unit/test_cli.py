"""The command line."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pydart2
from pydart2.cli import main, parser
from pydart2.gui.first_look import open_world
from pydart2.models import find

LINK = """<link name="{0}"><inertial><mass value="2"/><inertia ixx="{1}" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
  </inertial><visual><geometry><box size="1 2 3"/></geometry></visual>
  <collision><geometry><sphere radius="0.5"/></geometry></collision></link>"""
JOINT = """<joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/>
  <limit lower="{0}" upper="1.5" effort="7" velocity="1"/></joint>"""
SWING = """<skel version="1.0"><world name="w"><skeleton name="swing"><body name="b">
  <inertia><mass>1</mass></inertia></body><joint type="revolute" name="hinge"><parent>world</parent><child>b</child>
  <axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis><init_pos>2</init_pos></joint>
  </skeleton></world></skel>"""
COMMANDS = ("inspect", "check", "render", "record", "bench")


@pytest.fixture
def arm(tmp_path: Path) -> str:
    return write(tmp_path, 1.0, -0.5)


def write(folder: Path, moment: float, lower: float) -> str:
    path = folder / "arm.urdf"
    links = LINK.format("upper", 1.0) + LINK.format("lower", moment)
    path.write_text(f'<robot name="arm">{links}{JOINT.format(lower)}</robot>')
    return str(path)


def test_inspect(arm: str, capsys: pytest.CaptureFixture[str]) -> None:
    main(["inspect", arm])
    text = capsys.readouterr().out
    assert "arm: 4 kg, 2 bodies, 7 dofs" in text
    assert "    lower  elbow" not in text and "  lower" in text
    assert "elbow                0   -0.5    1.5       7" in text


def test_inspect_as_json(arm: str, capsys: pytest.CaptureFixture[str]) -> None:
    main(["inspect", arm, "--json"])
    [skeleton] = json.loads(capsys.readouterr().out)
    assert [(body["name"], body["parent"]) for body in skeleton["bodies"]] == [("upper", None), ("lower", "upper")]
    assert [shape["size"] for shape in skeleton["bodies"][1]["shapes"]] == [[1.0, 2.0, 3.0], [1.0, 1.0, 1.0]]
    [elbow] = [dof for dof in skeleton["dofs"] if dof["name"] == "elbow"]
    assert (elbow["limits"], elbow["force_limits"], elbow["velocity_limits"]) == ([-0.5, 1.5], [-7, 7], [-1, 1])


def test_the_tree_is_listed_from_the_root_down(capsys: pytest.CaptureFixture[str]) -> None:
    main(["inspect", "sdf/atlas/atlas_v3_no_head.sdf", "--json"])
    [atlas] = json.loads(capsys.readouterr().out)
    seen: list[str] = []
    for body in atlas["bodies"]:
        assert body["parent"] is None or body["parent"] in seen
        seen.append(body["name"])
    assert seen.index("l_hand") == seen.index("l_farm") + 1
    assert sum(body["mass"] for body in atlas["bodies"]) == pytest.approx(atlas["mass"])


def test_convert_writes_the_format_of_the_suffix(arm: str, tmp_path: Path) -> None:
    out = str(tmp_path / "arm.skel")
    main(["convert", arm, out])
    main(["convert", out, str(tmp_path / "again.urdf"), "--strict"])
    texts = [pydart2.World(0.001).add_skeleton(file).to_skel() for file in (arm, str(tmp_path / "again.urdf"))]
    assert texts[0] == texts[1] == (tmp_path / "arm.skel").read_text()


def test_convert_takes_worlds_and_one_of_their_skeletons(tmp_path: Path) -> None:
    swing, one = tmp_path / "swing.skel", tmp_path / "one.skel"
    swing.write_text(SWING.replace("<skeleton", "<physics><time_step>0.005</time_step></physics><skeleton", 1))
    main(["convert", str(swing), str(tmp_path / "world.skel")])
    assert "<time_step>0.005</time_step>" in (tmp_path / "world.skel").read_text()
    main(["convert", str(swing), str(tmp_path / "swing.urdf")])
    main(["convert", "skel/cubes.skel", str(one), "--only", "skeleton_2"])
    assert pydart2.World(0.001).add_skeleton(one).name == "skeleton_2"


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["skel/chain.skel", "out.urdf"], r"not in URDF: joint 'joint 1' of 'skeleton 1' is of the kind 'ball'"),
        (["skel/cubes.skel", "out.urdf"], r"not in URDF: a world; save its skeletons one by one"),
        (["skel/cubes.skel", "out.urdf", "--only", "nobody"], r"no skeleton 'nobody'"),
        (["skel/cubes.skel", "out.obj"], r"no format for 'out.obj'; its suffix is one of .urdf"),
        (["none.skel", "out.urdf"], r"no file 'none.skel'"),
        (["skel/cubes.skel", "nowhere/out.skel"], r"No such file or directory: '.*nowhere/out.skel'"),
        (
            ["skel/fullbody1.skel", "out.urdf", "--only", "fullbody1", "--strict"],
            r"not in URDF: joints of several dofs",
        ),
    ],
)
def test_convert_says_what_is_wrong(
    arguments: list[str], reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match=f"^pydart2 convert: .*{reason}"):
        main(["convert", *arguments])
    assert list(tmp_path.iterdir()) == []


def test_check_finds_nothing_wrong(arm: str, capsys: pytest.CaptureFixture[str]) -> None:
    main(["check", arm])
    assert capsys.readouterr().out == "loads    arm: 4 kg, 2 bodies, 7 dofs\nok       nothing looks wrong\n"


def test_check_takes_frames_without_mass_but_no_moving_part_without(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, link = tmp_path / "arm.urdf", LINK.format("upper", 1.0)
    joint = JOINT.format(-0.5)
    path.write_text(f'<robot name="arm">{link}<link name="lower"/>{joint.replace("revolute", "fixed")}</robot>')
    main(["check", str(path)])
    assert capsys.readouterr().out.endswith("nothing looks wrong\n")
    nothing = LINK.format("lower", 0.0).replace('value="2"', 'value="0"').replace('"1"', '"0"')
    path.write_text(f'<robot name="arm">{link}{nothing}{joint}</robot>')
    with pytest.raises(SystemExit):
        main(["check", str(path), "--json"])
    assert any("'lower' of 'arm' moves" in line for line in json.loads(capsys.readouterr().out)["wrong"])


def test_check_tells_what_cannot_be(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for model, reason in (
        (write(tmp_path, 3.0, -0.5), "body 'lower' of 'arm' has moments of inertia that no body has: 1, 1, 3 kg m²"),
        (SWING, "dof 'hinge' of 'swing' starts at 2, outside its limits -1 to 1"),
    ):
        with pytest.raises(SystemExit) as end:
            main(["check", model, "--json"])
        assert end.value.code == 1
        assert any(reason in line for line in json.loads(capsys.readouterr().out)["wrong"])


def test_render_and_record(arm: str, tmp_path: Path) -> None:
    main(["render", arm, "-o", str(tmp_path / "a.png"), "--size", "160x120", "--camera", "front"])
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.size == (160, 120) and np.asarray(picture).std() > 10.0
    movie = ["-o", str(tmp_path / "a.gif"), "--size", "80x60", "--seconds", "0.2", "--fps", "10"]
    main(["record", arm, *movie])
    with Image.open(tmp_path / "a.gif") as picture:
        assert getattr(picture, "n_frames", 1) == 3


def test_an_arm_can_be_welded_to_the_world() -> None:
    with pytest.raises(SystemExit, match=r"^pydart2 record: seconds must be positive, got -1\.0$"):
        main(["record", "ur5e", "--fixed", "--seconds", "-1"])
    assert open_world(find("ur5e"), ground=True, fixed=True).skeletons[0].ndofs == 6
    assert open_world(find("ur5e")).skeletons[0].ndofs == 12


def test_bench_measures_every_choice(
    arm: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pydart2.cli.bench._SECONDS", 0.001)
    main(["bench", arm, "--json"])
    data = json.loads(capsys.readouterr().out)
    choices = {(row["detector"], row["solver"]) for row in data["choices"]}
    assert data["dofs"] == 7 and len(choices) == len(data["choices"]) >= 8
    assert (data["choices"][0]["detector"], data["choices"][0]["solver"]) == ("fcl", pydart2.engine_info().solver)
    assert all(row["us_per_step"] > 0.0 for row in data["choices"])


def test_info(capsys: pytest.CaptureFixture[str]) -> None:
    main(["info", "--json"])
    data = json.loads(capsys.readouterr().out)
    assert data["pydart2"] == pydart2.__version__ and data["numpy"] == np.__version__


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("text", [None, "", "no XML", "<robot name='x'><link/></robot>"])
def test_a_broken_file_is_a_sentence_and_status_1(
    command: str, text: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    if text is not None:
        Path("robot.urdf").write_text(text)
    with pytest.raises(SystemExit) as end:
        main([command, "robot.urdf"])
    assert str(end.value).startswith(f"pydart2 {command}: ") and "robot.urdf" in str(end.value)
    assert "Traceback" not in str(end.value)


@pytest.mark.parametrize("arguments", [["render", "x", "--size", "large"], ["fly"], ["--fly"]])
def test_a_line_without_sense_is_status_2(arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2


def test_a_robot_of_an_installed_package_by_name(capsys: pytest.CaptureFixture[str]) -> None:
    main(["inspect", "ur5e"])
    assert "shoulder_pan_joint" in capsys.readouterr().out
    with pytest.raises(SystemExit, match=r"^pydart2 inspect: no model 'fulbody1' in .*; did you mean 'fullbody1'\?"):
        main(["inspect", "fulbody1"])


def test_the_time_step_is_the_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pydart2.cli.bench._SECONDS", 0.001)
    path = tmp_path / "swing.skel"
    path.write_text(SWING.replace("<skeleton", "<physics><time_step>0.004</time_step></physics><skeleton", 1))
    main(["bench", str(path), "--json"])
    assert json.loads(capsys.readouterr().out)["dt"] == 0.004


def test_who_reads_the_first_line_only_is_no_error() -> None:
    line = f"{sys.executable} -m pydart2 inspect sdf/atlas/atlas_v3_no_head.sdf | head -n 1"
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("drc_skeleton: 146.6 kg, 28 bodies, 33 dofs\n", "")


def test_help(capsys: pytest.CaptureFixture[str]) -> None:
    main([])
    text = capsys.readouterr().out
    [commands] = [action for action in parser()._actions if action.dest == "command"]
    assert set(COMMANDS) < set(commands.choices or ())
    assert all(f"\n    {command} " in text for command in COMMANDS)
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0 and capsys.readouterr().out == f"pydart2 {pydart2.__version__}\n"
    done = subprocess.run([sys.executable, "-m", "pydart2", "render", "--help"], capture_output=True, text=True)
    assert done.returncode == 0 and "--camera" in done.stdout
