"""The renderer interface of user code: every method, by the pixels that it must change."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from OpenGL import GL
from PIL import Image

import pydart2
from pydart2.gui import Camera, OffscreenRenderer, text
from pydart2.gui.opengl import renderer as ri_module
from pydart2.gui.opengl.renderer import R_axis_angle, Renderer, norm, normalize, rad_to_deg, rot2d
from pydart2.muscle.route import Route

from .worlds import body, box, sphere, world_of

Draw = Callable[[Renderer], None]
FRONT = Camera(np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -4], [0, 0, 0, 1]]))
PIXELS_PER_METRE = 90 / np.tan(np.pi / 8) / 4  # in the plane z = 0


class User:
    """User code."""

    def __init__(self, in_world: Draw | None = None, in_picture: Draw | None = None) -> None:
        if in_world:
            self.render_with_ri = in_world
        if in_picture:
            self.draw_with_ri = in_picture


@pytest.fixture(scope="module")
def plain() -> OffscreenRenderer:
    """240 by 180, no smoothing, so that pixels can be counted."""
    return OffscreenRenderer(240, 180, samples=0)


@pytest.fixture(scope="module")
def changed(plain: OffscreenRenderer) -> Callable[..., NDArray[np.bool_]]:
    """Where a drawing differs from the background."""
    empty = plain.render(None, camera=FRONT)

    def where(in_world: Draw | None = None, in_picture: Draw | None = None) -> NDArray[np.bool_]:
        return np.any(plain.render(User(in_world, in_picture), camera=FRONT) != empty, axis=2)

    return where


Changed = Callable[..., NDArray[np.bool_]]


def extent(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """First and last column, first and last row."""
    rows, columns = np.nonzero(mask)
    return columns.min(), columns.max(), rows.min(), rows.max()


def black(draw: Draw) -> Draw:
    def wrapped(ri: Renderer) -> None:
        ri.set_color(0.0, 0.0, 0.0)
        draw(ri)

    return wrapped


# In the picture


@pytest.mark.parametrize(
    ("draw", "expected"),
    [
        (lambda ri: ri.draw_line([20, 30], [120, 30]), (20, 119, 29, 30)),
        (lambda ri: ri.draw_box(40, 20, [100, 60], fill=True), (80, 119, 50, 69)),
        (lambda ri: ri.draw_box(40, 20, [100, 60], np.pi / 2, fill=True), (90, 109, 40, 79)),
        (lambda ri: ri.draw_box(40, 20, [100, 60]), (80, 120, 50, 70)),
        (lambda ri: ri.draw_circle(30, 60, [100, 80], fill=True), (70, 129, 50, 109)),
        (lambda ri: ri.draw_circle(30, 60, [100, 80]), (70, 130, 50, 110)),
        (lambda ri: ri.draw_ellipse_at(40, 20, [100, 80], None, 60, fill=True), (60, 139, 60, 99)),
        (lambda ri: ri.draw_ellipse_at(40, 20, [100, 80], np.pi / 2, 60, fill=True), (80, 119, 40, 119)),
        (lambda ri: ri.draw_ellipse([60, 80], [140, 80], 20, 60, fill=True), (55, 144, 60, 99)),  # with its marks
        (lambda ri: ri.draw_arrow([20, 90], [120, 90]), (20, 120, 75, 104)),  # the head's lines: 20 long at 45 degrees
        (lambda ri: ri.draw_arrow([50, 90], [50, 90]), None),
    ],
)
def test_flat_shapes_have_their_extent(changed: Changed, draw: Draw, expected: tuple[int, ...] | None) -> None:
    mask = changed(in_picture=black(draw))
    if expected is None:
        assert not mask.any()
    else:
        assert extent(mask) == pytest.approx(expected, abs=1)


def test_filled_areas(changed: Changed) -> None:
    assert changed(in_picture=black(lambda ri: ri.draw_box(40, 20, [100, 60], 0.3, fill=True))).sum() == pytest.approx(
        800, rel=0.03
    )
    circle = changed(in_picture=black(lambda ri: ri.draw_circle(30, 60, [100, 80], fill=True)))
    assert circle.sum() == pytest.approx(np.pi * 900, rel=0.02)
    outline = changed(in_picture=black(lambda ri: ri.draw_circle(30, 60, [100, 80])))
    assert outline.sum() < 300


def test_transforms_in_the_picture(changed: Changed) -> None:
    def draw(ri: Renderer) -> None:
        ri.set_color(0, 0, 0)
        ri.push()
        ri.translate(100, 60)
        ri.rotate2d(np.pi / 2)
        ri.scale(2, 1)
        ri.draw_box(20, 20, fill=True)
        ri.pop()
        ri.draw_box(4, 4, [2, 2], fill=True)

    mask = changed(in_picture=draw)
    assert extent(mask[20:]) == pytest.approx((90, 109, 20, 59), abs=1)
    assert extent(mask[:20]) == pytest.approx((0, 3, 0, 3), abs=1)


def test_matrices(changed: Changed) -> None:
    move = np.eye(4)
    move[:3, 3] = [50, 40, 0]

    def by_rows(ri: Renderer) -> None:
        ri.color(0, 0, 0)
        ri.mult_matrix(move)
        ri.draw_box(10, 10, fill=True)

    def by_columns(ri: Renderer) -> None:
        ri.color(0, 0, 0)
        ri.mult_matrix_raw(list(move.T.reshape(16)))
        ri.draw_box(10, 10, fill=True)

    assert extent(changed(in_picture=by_rows)) == pytest.approx((45, 54, 35, 44), abs=1)
    assert (changed(in_picture=by_rows) == changed(in_picture=by_columns)).all()


def test_text_starts_at_its_baseline_and_is_as_wide_as_the_atlas_says(changed: Changed) -> None:
    for size in (12, 18, 24):
        mask = changed(in_picture=black(lambda ri, size=size: ri.draw_text([30, 90], "HELLO", size)))
        left, right, top, bottom = extent(mask)
        assert left == pytest.approx(31, abs=2)
        assert right - left == pytest.approx(text.atlas(size).width("HELLO"), abs=5)
        assert bottom == pytest.approx(89, abs=1)  # capitals stand on the baseline
        assert 0.55 * size < bottom - top + 1 < size


def test_text_colour_fonts_and_letters(plain: OffscreenRenderer, changed: Changed) -> None:
    def red(ri: Renderer) -> None:
        ri.set_color(1, 0, 0)
        ri.draw_text([10, 50], "MMMM", 24)

    picture = plain.render(User(None, red), camera=FRONT)
    assert (picture == [255, 0, 0]).all(axis=2).sum() > 50
    same = [changed(in_picture=black(lambda ri, t=t: ri.draw_text([10, 50], t))) for t in ("cafe - 5", "café – 5")]
    assert (same[0] == same[1]).all()
    assert not changed(in_picture=lambda ri: ri.draw_text([10, 50], "")).any()
    assert text.plain("½ “µ” 木") == '1?2 "u" ?'
    assert [text.size_of(f) for f in (None, 9, "GLUT_BITMAP_HELVETICA_12", object())] == [18, 9, 12, 18]


def test_text_in_the_world_is_at_its_point_and_hidden_by_bodies(changed: Changed) -> None:
    mask = changed(in_world=black(lambda ri: ri.draw_text([0.0, 0.0, 0.0], "HHH", 18)))
    left, _, _, bottom = extent(mask)
    assert (left, bottom) == pytest.approx((121, 89), abs=2)

    def behind(ri: Renderer) -> None:
        ri.set_color(1, 1, 1)
        ri.render_box([0, 0, 1], [3, 3, 0.1])
        ri.set_color(0, 0, 0)
        ri.draw_text([0.0, 0.0, 0.0], "HHH", 18)

    def without(ri: Renderer) -> None:
        ri.set_color(1, 1, 1)
        ri.render_box([0, 0, 1], [3, 3, 0.1])

    assert (changed(in_world=behind) == changed(in_world=without)).all()


def test_images_are_upright_and_keep_their_colours(plain: OffscreenRenderer) -> None:
    pixels = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], np.uint8)
    image = Image.fromarray(pixels.repeat(20, axis=0).repeat(20, axis=1))

    def draw(ri: Renderer) -> None:
        (texture,) = ri.gen_textures()
        assert ri.textures[-1] == texture
        ri.set_texture_as_image(image)
        ri.set_color(0, 0, 0)  # of no effect on pictures
        ri.draw_image(40, 40, center=[100, 60])
        ri.draw_image(20, 20, texture, center=[200, 60], angle=np.pi)
        ri.delete_textures(texture)
        assert texture not in ri.textures

    picture = plain.render(User(None, draw), camera=FRONT)
    assert picture[45, 85] == pytest.approx([255, 0, 0]) and picture[45, 115] == pytest.approx([0, 255, 0])
    assert picture[75, 85] == pytest.approx([0, 0, 255]) and picture[75, 115] == pytest.approx([255, 255, 0])
    assert picture[65, 205] == pytest.approx([255, 0, 0]) and picture[55, 195] == pytest.approx([255, 255, 0])


def test_no_texture_yet(plain: OffscreenRenderer) -> None:
    with pytest.raises(ValueError, match="gen_textures"):
        plain.render(User(None, lambda ri: ri.draw_image(10, 10)))


# In the world


@pytest.mark.parametrize(
    ("draw", "expected"),
    [
        (lambda ri: ri.render_sphere([0.5, 0.2, 0.0], 0.3), (0.5, 0.2, 0.3, 0.3)),
        (lambda ri: ri.render_box([0.5, 0.2, 0.0], [0.6, 0.4, 0.01]), (0.5, 0.2, 0.3, 0.2)),
        (lambda ri: ri.render_box_two_points([0, -0.5, 0], [0, 0.5, 0], 0.2, 0.01), (0.0, 0.0, 0.1, 0.5)),
        (lambda ri: ri.render_cylinder_two_points([-0.5, 0, 0], [0.5, 0, 0], 0.1), (0.0, 0.0, 0.5, 0.1)),
        (lambda ri: ri.render_cylinder([0.2, 0.1, -0.1], 0.3, 0.1), (0.2, 0.1, 0.3, 0.3)),
        (lambda ri: ri.render_chessboard_xy(1.0, 4), (0.0, 0.0, 0.5, 0.5)),
        (lambda ri: ri.render_arrow([0, -0.5, 0], [0, 0.5, 0], 0.02, 0.1, 0.3), (0.0, 0.0, 0.1, 0.5)),
        (lambda ri: ri.render_arrow([0, 0, 0], [1, 0, 0], 0.02, 0.1, 0.3), (0.5, 0.0, 0.5, 0.1)),  # ints
        (lambda ri: ri.render_lines([[-0.5, -0.4, 0], [0.5, -0.4, 0], [0.5, 0.4, 0]]), (0.0, 0.0, 0.5, 0.4)),
        (lambda ri: ri.render_line([-0.5, -0.4, 0], [0.5, 0.4, 0]), (0.0, 0.0, 0.5, 0.4)),
        (lambda ri: ri.render_axes([0.1, 0.2, 0.0], 0.8), (0.1, 0.2, 0.4, 0.4)),
        (lambda ri: ri.render_axes([0.1, 0.2, 0.0], 0.8, r_base_=0.01), (0.1, 0.2, 0.4, 0.4)),
    ],
)
def test_bodies_have_their_extent(changed: Changed, draw: Draw, expected: tuple[float, ...]) -> None:
    x, y, half_x, half_y = np.array(expected) * PIXELS_PER_METRE
    box_ = extent(changed(in_world=black(draw)))
    assert box_ == pytest.approx((120 + x - half_x, 120 + x + half_x, 90 - y - half_y, 90 - y + half_y), abs=2.5)


@pytest.mark.parametrize(
    "draw",
    [
        lambda ri: ri.render_arrow([1, 1, 1], [1, 1, 1]),
        lambda ri: ri.render_cylinder_two_points([0, 0, 0], [0, 0, 0], 0.1),
        lambda ri: ri.render_box_two_points([0, 0, 0], [0, 0, 0], 0.1, 0.1),
    ],
)
def test_what_has_no_length_is_not_drawn(changed: Changed, draw: Draw) -> None:
    assert not changed(in_world=black(draw)).any()


def test_an_arrow_along_minus_z(changed: Changed) -> None:
    assert changed(in_world=black(lambda ri: ri.render_arrow([0, 0, 0.5], [0, 0, -0.5], 0.05, 0.1, 0.1))).sum() > 20


def test_bodies_look_as_those_of_the_world_do(plain: OffscreenRenderer) -> None:
    def draw(ri: Renderer) -> None:
        ri.set_color(0.8, 0.3, 0.3)
        ri.render_box([0.3, 0.1, 0.0], [0.5, 0.6, 0.7])

    plain.scene.style.shadows = False
    of_world = plain.render(world_of(body(box(0.5, 0.6, 0.7), "0.3 0.1 0 0 0 0")), camera=FRONT)
    of_user = plain.render(User(draw), camera=FRONT)
    plain.scene.style.shadows = True
    assert np.abs(of_world.astype(int) - of_user).max() <= 2


def test_colours_and_blending(plain: OffscreenRenderer) -> None:
    def draw(ri: Renderer) -> None:
        ri.set_color(1, 0, 0)
        ri.render_box([0, 0, 0], [2, 2, 0.1])
        ri.set_color(0, 0, 1, 0.5)
        ri.render_box([0.5, 0, 1], [0.8, 2, 0.1])

    picture = plain.render(User(draw), camera=FRONT).astype(int)
    left, right = picture[90, 100], picture[90, 140]
    assert left[0] > 150 and left[2] < 50
    assert right[0] > 60 and right[2] > 60


def test_chessboards(plain: OffscreenRenderer) -> None:
    def draw(ri: Renderer) -> None:
        ri.render_chessboard_xy(2.0, 2, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])

    picture = plain.render(User(draw), camera=FRONT).astype(int)
    kinds = [picture[row, column].argmax() for row, column in ((60, 90), (60, 150), (120, 90), (120, 150))]
    assert kinds in ([0, 1, 1, 0], [1, 0, 0, 1])
    from_above = Camera.look_at([0, 5, 0.01], [0, 0, 0], [0, 0, -1])
    empty = plain.render(None, camera=from_above)
    floor = plain.render(User(lambda ri: ri.render_chessboard(2.0)), camera=from_above)
    assert (floor != empty).any(axis=2).mean() > 0.1


def test_axes_are_red_green_and_blue(plain: OffscreenRenderer) -> None:
    camera = Camera.look_at([3, 3, 3], [0, 0, 0], [0, 1, 0])
    picture = plain.render(User(lambda ri: ri.render_axes([0, 0, 0], 2.0)), camera=camera)
    for color in ([255, 0, 0], [0, 255, 0], [0, 0, 255]):
        assert (picture == color).all(axis=2).sum() > 20
    grey = plain.render(
        User(lambda ri: (ri.set_color(0, 0, 0), ri.render_axes([0, 0, 0], 2.0, rgb=False))), camera=camera
    )
    assert not (grey == [255, 0, 0]).all(axis=2).any()


def test_line_width(changed: Changed) -> None:
    counts = []
    for width in (1, 3, 6):

        def draw(ri: Renderer, width: int = width) -> None:
            ri.set_color(0, 0, 0)
            ri.set_line_width(width)
            ri.render_line([-0.5, 0, 0], [0.5, 0, 0])

        counts.append(changed(in_world=draw).sum())
    assert counts[1] == pytest.approx(3 * counts[0], rel=0.1) and counts[2] == pytest.approx(6 * counts[0], rel=0.1)


def test_project_and_back(plain: OffscreenRenderer) -> None:
    seen: dict[str, Any] = {}
    points = [[0.0, 0.0, 0.0], [0.5, 0.3, -1.0], [-0.4, -0.2, 0.7]]

    def look(name: str) -> Draw:
        def draw(ri: Renderer) -> None:
            seen[name] = [ri.project(*p) for p in points]
            seen[name + " unflipped"] = [ri.project(*p, auto_flip_vertical=False) for p in points]
            seen[name + " back"] = [ri.unproject(*ri.project(*p)) for p in points]
            seen[name + " back unflipped"] = [ri.unproject(*ri.project(*p, False), False) for p in points]

        return draw

    plain.render(User(look("world"), look("picture")), camera=FRONT)
    for name in ("world", "picture"):
        for (x, y, z), projected in zip(points, seen[name]):
            scale = PIXELS_PER_METRE * 4 / (4 - z)
            assert projected[:2] == pytest.approx([120 + x * scale, 90 - y * scale], abs=1e-3)
            assert 0.0 < projected[2] < 1.0
        assert [p[1] for p in seen[name + " unflipped"]] == pytest.approx([180 - p[1] for p in seen[name]])
        for back in (" back", " back unflipped"):
            assert np.array(seen[name + back]) == pytest.approx(np.array(points), abs=1e-4)


# With OpenGL calls and mistakes of the user


def test_raw_opengl_in_between(changed: Changed) -> None:
    def draw(ri: Renderer) -> None:
        GL.glColor3f(0, 0, 0)
        GL.glPushMatrix()
        GL.glTranslatef(0.5, 0.0, 0.0)
        ri.render_sphere([0, 0, 0], 0.2)
        GL.glPopMatrix()
        GL.glDisable(GL.GL_LIGHTING)
        GL.glBegin(GL.GL_TRIANGLES)
        for corner in ((-1.0, -0.2, 0.0), (-0.6, -0.2, 0.0), (-0.8, 0.2, 0.0)):
            GL.glVertex3f(*corner)
        GL.glEnd()
        corners = np.array([[-0.2, -0.9, 0], [0.2, -0.9, 0], [0.0, -0.6, 0]], np.float32)
        GL.glEnableClientState(GL.GL_VERTEX_ARRAY)
        GL.glVertexPointer(3, GL.GL_FLOAT, 0, corners)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glDisableClientState(GL.GL_VERTEX_ARRAY)

    mask = changed(in_world=draw)
    assert extent(mask[70:110, 121:]) == pytest.approx((0.3 * 54.3 - 1, 0.7 * 54.3 - 1, 9, 31), abs=2)
    assert mask[90, 77] and mask[130, 120]


def test_what_user_code_leaves_behind_is_gone_in_the_next_picture(plain: OffscreenRenderer) -> None:
    world = world_of(body(sphere(0.5)))
    expected = plain.render(world, camera=FRONT)

    def careless(ri: Renderer) -> None:
        for _ in range(5):
            ri.push()
        ri.set_line_width(7)
        ri.disable("DEPTH_TEST")
        ri.enable(GL.GL_CULL_FACE)
        GL.glPolygonMode(GL.GL_FRONT_AND_BACK, GL.GL_LINE)
        GL.glColorMask(False, True, True, True)
        GL.glDepthMask(False)

    for _ in range(20):
        plain.render(User(careless, careless), camera=FRONT)
        assert (plain.render(world, camera=FRONT) == expected).all()


def test_an_error_in_user_code_comes_through_and_does_no_harm(plain: OffscreenRenderer) -> None:
    world = world_of(body(sphere(0.5)))
    expected = plain.render(world, camera=FRONT)

    def wrong(ri: Renderer) -> None:
        ri.push()
        raise RuntimeError("mine")

    for user in (User(wrong), User(None, wrong)):
        with pytest.raises(RuntimeError, match="mine"):
            plain.render(user, camera=FRONT)
        assert (plain.render(world, camera=FRONT) == expected).all()


def test_flags(plain: OffscreenRenderer) -> None:
    ri = Renderer()
    assert ri.parse_flag("COLOR_MATERIAL") == ri.parse_flag("GL_COLOR_MATERIAL") == GL.GL_COLOR_MATERIAL
    assert ri.parse_flag(GL.GL_BLEND) == GL.GL_BLEND
    with pytest.raises(ValueError, match="GL_NONSENSE"):
        ri.parse_flag("NONSENSE")
    assert ri.quadric is None and ri.textures == []


def test_world_with_render_of_its_own(plain: OffscreenRenderer) -> None:
    class Mine(pydart2.World):
        def render(self, *args: Any, **kwargs: Any) -> None:
            self.skeletons[0].render_with_color([0.0, 1.0, 0.0])
            self.skeletons[1].render_with_color([0.0, 0.0, 1.0, 1.0])

    path = pydart2.data_path("skel/cubes.skel")
    picture = plain.render(Mine(0.001, path), camera=FRONT).astype(int)
    usual = plain.render(pydart2.World(0.001, path), camera=FRONT)
    assert (picture != usual).any()
    assert ((picture[:, :, 1] > picture[:, :, 0] + 60) & (picture[:, :, 1] > picture[:, :, 2] + 60)).any()


def test_parts_draw_themselves(changed: Changed) -> None:
    marked = body(sphere(0.1)).replace("</body>", '<marker name="m"><offset>0.1 0 0</offset></marker></body>')
    world = world_of(marked, body(box(4, 0.1, 4), "0 -0.149 0 0 0 0", fixed=True).replace("visualization", "collision"))
    skel = world.skeletons[0]
    shape = skel.bodynodes[0].shapenodes[0].shape
    assert shape is not None
    assert extent(changed(lambda ri: skel.render())) == pytest.approx((115, 125, 85, 95), abs=1)
    for draw in (skel.markers[0].render, world.render_markers):  # a ball of 1 cm
        mask = changed(lambda ri, draw=draw: (ri.scale(5, 5, 5), draw()))
        assert extent(mask) == pytest.approx((144.5, 149.5, 87, 93), abs=1.5)
    assert extent(changed(lambda ri: (ri.translate(0.5, 0), shape.render()))) == pytest.approx(
        (142, 152, 85, 95), abs=1
    )
    assert not changed(lambda ri: world.render_contacts()).any()
    assert changed(lambda ri: world.render(render_markers=False)).sum() < changed(lambda ri: world.render()).sum()
    contact = pydart2.Contact(world, np.array([0.5, 0.0, 0.0, 0.0, 100.0, 0.0, 0, 0, 1, 0.0]))
    mask = changed(lambda ri: contact.render(0.02, 0.005))
    assert extent(mask) == pytest.approx((146, 148, 90 - 0.5 * PIXELS_PER_METRE, 91), abs=1.5)


def test_flat_functions_draw_the_same(changed: Changed) -> None:
    from pydart2 import pydart2_api as flat_api

    world = pydart2.World(0.001, pydart2.data_path("skel/cubes.skel"))
    wid = flat_api.createWorldFromSkel(pydart2.data_path("skel/cubes.skel"))
    for mine, flat in (
        (lambda ri: world.render(), lambda ri: flat_api.world__render(wid)),
        (lambda ri: world.skeletons[1].render(), lambda ri: flat_api.skeleton__render(wid, 1)),
        (
            lambda ri: world.skeletons[1].render_with_color([1, 0, 0, 1]),
            lambda ri: flat_api.skeleton__renderWithColor(wid, 1, [1, 0, 0, 1]),
        ),
        (
            lambda ri: world.skeletons[1].bodynodes[0].shapenodes[0].shape.render(),  # type: ignore[union-attr]
            lambda ri: flat_api.shape__render(wid, 1, 0, 0),
        ),
    ):
        assert changed(mine).any() and (changed(mine) == changed(flat)).all()
    force = [0.0, 0.0, 0.0, 0.0, 100.0, 0.0]
    assert changed(lambda ri: flat_api.collisionresult__renderContact(force, 0.05, 0.01)).any()
    with pytest.raises(IndexError):
        changed(lambda ri: flat_api.marker__render(wid, 1, 0))


def test_muscles_draw_with_it(changed: Changed) -> None:
    route = Route()
    route.world_points = [np.array([-0.5, 0.0, 0.0]), np.array([0.5, 0.0, 0.0])]
    assert extent(changed(black(route.render_with_ri))) == pytest.approx((93, 147, 88, 91), abs=2)


# The functions of the module


def test_functions() -> None:
    assert norm([3, 4]) == 5.0
    assert normalize([0, 0, 2]) == pytest.approx([0, 0, 1]) and normalize([0, 0]) == pytest.approx([0, 0])
    assert rot2d([1, 0], np.pi / 2) == pytest.approx([0, 1])
    assert rad_to_deg(np.pi) == pytest.approx(180.0)
    assert R_axis_angle([0, 0, 2], np.pi / 2) @ [1, 0, 0] == pytest.approx([0, 1, 0])
    assert R_axis_angle([1, 2, 3], 0.7) @ [1, 2, 3] == pytest.approx([1, 2, 3])
    assert ri_module.Renderer is Renderer
