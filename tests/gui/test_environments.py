"""The viewer where there is no display at all, with Qt's `offscreen`, and under a real X server (Xvfb)."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def run(*command: str, seconds: float = 120.0, **environment: str) -> subprocess.CompletedProcess[str]:
    inherited = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "QT_QPA_PLATFORM")}
    inherited |= {
        "PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}",
        "XDG_RUNTIME_DIR": "/tmp",
        "PYTHONFAULTHANDLER": "1",
        **environment,
    }
    return subprocess.run(command, capture_output=True, text=True, env=inherited, cwd=ROOT, timeout=seconds)


def run_code(code: str, seconds: float = 120.0, **environment: str) -> subprocess.CompletedProcess[str]:
    return run(sys.executable, "-c", textwrap.dedent(code), seconds=seconds, **environment)


def test_the_window_tests_pass_under_an_x_server(display: str) -> None:
    tests = [f"tests/gui/test_{name}.py" for name in ("window", "glut")]
    pytest_here = (sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    result = run(*pytest_here, *tests, DISPLAY=display, QT_QPA_PLATFORM="xcb", PYDART2_QT_PICTURES="1", seconds=900.0)
    assert result.returncode == 0, result.stdout[-3000:] + result.stderr[-1000:]
    assert "skipped" not in result.stdout


LAUNCH = """
    import sys
    import pydart2 as pydart

    class MyWorld(pydart.World):
        steps = 0
        def on_step_event(self):
            self.steps += 1
        def on_close(self):
            print("closed after", self.steps > 0)

    world = MyWorld(0.001, "./data/skel/cubes.skel")
    window = pydart.gui.viewer.launch(world, title="Cubes", default_camera=1)
    camera = window.scene.cameras.index(window.scene.tb)
    print(type(window).__name__, window.windowTitle(), type(window.glwidget).__name__, camera)
"""


@pytest.mark.parametrize(
    ("platform", "qt", "widget"),
    [("offscreen", "1", "ImageWidget"), ("xcb", "1", "GLWidget"), ("xcb", "", "ImageWidget")],
)
def test_launch_blocks_until_closed_and_returns_the_window(platform: str, qt: str, widget: str, display: str) -> None:
    """Without a graphics card, as here, Qt's OpenGL is taken only if that is asked for."""
    environment = {"PYDART2_QT_PICTURES": qt} | ({"DISPLAY": display} if platform == "xcb" else {})
    result = run_code(LAUNCH, QT_QPA_PLATFORM=platform, PYDART2_VIEWER_SECONDS="1", **environment)
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()[-2:]
    assert lines == ["closed after True", f"PyQt5Window Cubes {widget} 1"]


def test_without_a_display_launch_says_what_to_do() -> None:
    code = """
        import pydart2 as pydart
        world = pydart.World(0.001, "./data/skel/cubes.skel")
        for launch in (pydart.gui.viewer.launch, pydart.gui.viewer.launch_glut):
            try:
                launch(world)
            except pydart.PydartError as error:
                print(error)

        world.step()
        print(pydart.gui.render(world, 64, 48).shape, world.frame)
    """
    result = run_code(code)
    assert result.returncode == 0, result.stderr
    lines = result.stdout.splitlines()
    first, second = (line for line in lines if line.startswith("no window"))
    assert first.startswith("no window: DISPLAY is not set; ") and "QT_QPA_PLATFORM=offscreen" in first
    assert second == first
    assert lines[-1] == "(48, 64, 3) 1"


def test_a_display_that_does_not_answer_is_named() -> None:
    code = "import pydart2; pydart2.gui.viewer.launch(pydart2.World(0.001))"
    result = run_code(code, DISPLAY=":987")
    assert result.returncode == 1
    assert "NoDisplayError: no window: the X server of DISPLAY=:987 does not answer" in result.stderr.splitlines()[-1]


@pytest.mark.parametrize("where", ["on_step_event", "draw_with_ri", "a slot"])
def test_user_code_that_raises_makes_the_exit_status_1(where: str) -> None:
    code = f"""
        import pydart2 as pydart
        class MyWorld(pydart.World):
            pass
        def fail(*args):
            raise ArithmeticError("in {where}")
        world = MyWorld(0.001, "./data/skel/cubes.skel")
        window = pydart.gui.viewer.PydartWindow(world)
        if "{where}" == "a slot":
            from PyQt5.QtCore import QTimer
            QTimer.singleShot(50, fail)
        else:
            window.set_callback("{where}", fail)
        window.run_application()
        print("not reached")
    """
    result = run_code(code, QT_QPA_PLATFORM="offscreen", PYDART2_VIEWER_SECONDS="0.7")
    assert result.returncode == 1
    assert f"ArithmeticError: in {where}" in result.stderr
    assert "not reached" not in result.stdout


GLUT = """
    import os, signal
    import pydart2 as pydart
    class MyWorld(pydart.World):
        def on_step_event(self):
            if self.frame == 1:
                {deed}
    world = MyWorld(0.001, "./data/skel/cubes.skel")
    window = pydart.gui.viewer.launch_glut(world)
    print("closed", world.frame > 0, window.window)
"""


@pytest.mark.parametrize(
    ("deed", "status"),
    [
        ("pass", 0),
        ("os.kill(os.getpid(), signal.SIGINT)", 0),
        ("raise SystemExit(3)", 3),
        ("raise ArithmeticError('mine')", 1),
    ],
)
def test_glut_closes_by_itself_by_ctrl_c_and_by_exit(deed: str, status: int, display: str) -> None:
    seconds = "1" if deed == "pass" else "8" if "Arithmetic" in deed else "60"
    result = run_code(GLUT.format(deed=deed), DISPLAY=display, PYDART2_VIEWER_SECONDS=seconds, seconds=45.0)
    assert result.returncode == status, result.stderr
    assert ("closed True None" in result.stdout.splitlines()) is (status == 0)
    assert ("ArithmeticError: mine" in result.stderr) is (status == 1)


@pytest.mark.parametrize(
    "when",
    [
        "threading.Timer(0.7, interrupt).start()",
        "window.show = lambda: (interrupt(), type(window).show(window))",  # while it opens
    ],
)
def test_ctrl_c_closes_the_window(when: str) -> None:
    code = f"""
        import os, signal, threading
        import pydart2 as pydart
        interrupt = lambda: os.kill(os.getpid(), signal.SIGINT)
        window = pydart.gui.viewer.PydartWindow(pydart.World(0.001))
        before = signal.getsignal(signal.SIGINT)
        {when}
        window.run()
        print("closed", signal.getsignal(signal.SIGINT) is before)
    """
    result = run_code(code, QT_QPA_PLATFORM="offscreen", seconds=45.0)
    assert (result.returncode, result.stdout.splitlines()[-1]) == (0, "closed True"), result.stderr


def test_high_resolution_screens_give_pictures_of_all_their_pixels(display: str) -> None:
    code = """
        import pydart2 as pydart
        from PyQt5.QtCore import QTimer
        window = pydart.gui.viewer.PydartWindow(pydart.World(0.001, "./data/skel/cubes.skel"))
        window.show()
        QTimer.singleShot(300, window.app.quit)
        window.app.exec_()
        picture = window.glwidget
        shown = picture.picture()
        height, width = shown.shape[:2]
        headless = pydart.gui.render(window.sim, width, height, camera=window.scene.tb)
        print(width == 2 * picture.width(), height == 2 * picture.height(), (shown == headless).all())
    """
    for environment in ({"QT_QPA_PLATFORM": "offscreen"}, {"QT_QPA_PLATFORM": "xcb", "DISPLAY": display}):
        result = run_code(code, QT_SCALE_FACTOR="2", **environment)
        assert result.returncode == 0, result.stderr
        assert result.stdout.splitlines()[-1] == "True True True"


SCRIPTS = {
    "a controller and a camera": """
        import pydart2 as pydart

        class Damping:
            def __init__(self, skel):
                self.skel = skel
            def compute(self):
                return -0.01 * self.skel.dq

        world = pydart.World(1.0 / 5000.0, "./data/skel/chain.skel")
        world.skeletons[0].set_controller(Damping(world.skeletons[0]))
        pydart.gui.viewer.launch(world, default_camera=0)
    """,
    "the older window, keys and text": """
        import pydart2 as pydart

        class MyWorld(pydart.World):
            compensated = False
            def on_key_press(self, key):
                if key == "G":
                    self.compensated = not self.compensated
            def draw_with_ri(self, ri):
                ri.set_color(0, 0, 0)
                ri.draw_text([20, 40], "time = %.4fs" % self.t)
                ri.draw_text([20, 70], "on" if self.compensated else "off")

        win = pydart.gui.viewer.PydartWindow(MyWorld(0.001, "./data/skel/cubes.skel"))
        win.camera_event(1)
        win.set_capture_rate(10)
        win.run_application()
    """,
    "a world whose methods have the names of properties, and a window of its own": """
        import pydart2 as pydart

        class MyWorld(pydart.World):
            def f(self, x):
                return x
            def g(self, x):
                return x
            def step(self):
                super(MyWorld, self).step()
            def render_with_ri(self, ri):
                ri.set_color(1.0, 0.0, 0.0)
                ri.render_sphere([0.4, 0.0, 0.3], 0.05)
                ri.render_arrow([0, 0, 0], [1, 0, 0], r_base=0.05, head_width=0.1, head_len=0.1)

        win = pydart.gui.pyqt5.window.PyQt5Window(MyWorld(0.001))
        win.scene.set_camera(1)
        win.run()
    """,
}


@pytest.mark.parametrize("script", SCRIPTS)
def test_scripts_run_as_they_are_in_ci(script: str, display: str) -> None:
    result = run_code(SCRIPTS[script], DISPLAY=display, PYDART2_VIEWER_SECONDS="0.7")
    assert result.returncode == 0, result.stderr


AT_THE_END = """
    import atexit, gc
    from PyQt5 import QtWidgets, sip
    from pydart2.gui import context
    import pydart2 as pydart

    @atexit.register
    def report():
        print("windows gone:", [sip.isdeleted(window) for window in windows], "contexts freed:", freed)

    freed = 0
    class Counting(context._WAYS["egl"]):
        def destroy(self):
            global freed
            freed += 1
            super().destroy()

    context._WAYS["egl"] = Counting
    application = QtWidgets.QApplication([]) if users_own else None
    world = pydart.World(0.001, "./data/skel/cubes.skel")
    pydart.gui.render(world, 64, 48)
    from pydart2.gui.pyqt5.window import PyQt5Window
    windows = [PyQt5Window(world), PyQt5Window(world)]
    for window in windows:
        window.show()
    window.glwidget.grab_image()
    windows[0].close()
    if drop:
        del window, windows[:]
        gc.collect()
        print("freed by then:", freed)
"""


def at_the_end(users_own: bool = False, drop: bool = False) -> list[str]:
    code = f"users_own, drop = {users_own}, {drop}\n{textwrap.dedent(AT_THE_END)}"
    result = run_code(code, QT_QPA_PLATFORM="offscreen", PYDART2_GL="egl")
    assert result.returncode == 0, result.stderr
    return result.stdout.splitlines()


@pytest.mark.parametrize("users_own", [True, False])
def test_windows_and_contexts_are_freed_before_python_is_taken_apart(users_own: bool) -> None:
    assert at_the_end(users_own)[-1] == "windows gone: [True, True] contexts freed: 3"


def test_the_context_of_a_window_is_freed_with_it() -> None:
    assert "freed by then: 2" in at_the_end(drop=True)
