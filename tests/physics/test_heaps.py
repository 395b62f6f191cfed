"""The native detector with the iterative solver at default settings: what stands, slides, bounces and heaps up."""

from __future__ import annotations

import itertools
import pickle
from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pydart2
from physics.models import add_ragdoll

G = 9.81
Make = Callable[..., pydart2.Skeleton]


def world_of(dt: float = 0.002, ground: bool = True, **surface: float) -> pydart2.World:
    world = pydart2.World(dt, up="z")
    world.set_recording(False)
    world.set_collision_detector("native")
    world.set_constraint_solver("iterative")
    if ground:
        world.add_ground(size=(200.0, 200.0), **surface)
    return world


def centres(world: pydart2.World, first: int = 1) -> np.ndarray:
    return np.array([skeleton.C for skeleton in world.skeletons[first:]])


def energy(world: pydart2.World) -> float:
    return sum(skeleton.kinetic_energy() + skeleton.potential_energy() for skeleton in world.skeletons[1:])


def stack(world: pydart2.World, count: int, side: float = 0.2) -> None:
    for i in range(count):
        world.add_box((side, side, side), 1.0, (0.0, 0.0, side * (i + 0.5)))


def wall(world: pydart2.World, rows: int, side: float = 0.2) -> None:
    """Every second row is shifted by half a box and ends in half bricks."""
    for row in range(rows):
        height = side * (row + 0.5)
        for i in range(rows - row % 2):
            world.add_box((side, side, side), 1.0, (side * (i + 0.5 * (row % 2)), 0.0, height))
        if row % 2:
            for x in (-side / 4, side * (rows - 0.75)):
                world.add_box((side / 2, side, side), 0.5, (x, 0.0, height))


@pytest.mark.parametrize(
    ("build", "size", "seconds"), [(stack, 20, 4.0), (wall, 6, 2.0)], ids=["stack of 20", "wall of 36"]
)
def test_rest_is_quiet(build: Callable[[pydart2.World, int], None], size: int, seconds: float) -> None:
    """In the first second nothing moves by 5 mm, later by 0.1 mm or at 1 mm/s, and no energy comes from anywhere."""
    world = world_of()
    build(world, size)
    built = centres(world)
    world.step(500)
    stands, first = centres(world), energy(world)
    assert np.abs(stands - built).max() <= 5e-3
    weight = sum(skeleton.m for skeleton in world.skeletons[1:]) * G * built[:, 2].max()
    for _ in range(round(seconds / 0.2)):
        world.step(100)
        assert np.abs(centres(world) - stands).max() <= 1e-4
        assert max(np.abs(skeleton.dq).max() for skeleton in world.skeletons[1:]) <= 1e-3
        assert energy(world) <= first + 1e-6 * weight


@pytest.mark.soak
@pytest.mark.parametrize(("build", "size"), [(stack, 20), (wall, 10)], ids=["stack of 20", "wall of 100"])
def test_rest_is_quiet_for_ten_seconds(build: Callable[[pydart2.World, int], None], size: int) -> None:
    test_rest_is_quiet(build, size, 9.0)


@pytest.mark.parametrize(("rows", "most"), [(4, 1.5), (20, 5.0)])
def test_walls_at_rest_take_few_sweeps(rows: int, most: float) -> None:
    """A large wall no more than some: else a contact of it takes many times as long as one of a small wall."""
    world = world_of()
    wall(world, rows)
    world.step(250)
    options = world.constraint_solver_options()
    sweeps = []
    for _ in range(180):
        world.step()
        sweeps.append(world.solver_iterations())
        assert world.solver_residual() <= options["tolerance"] or sweeps[-1] == options["iterations"]
    assert np.mean(sweeps) <= most


@pytest.mark.parametrize(
    ("speed", "tolerance", "loss"), [(1e-4, 3e-6, 6e-6), (1e-4, 3e-3, 6e-6), (1e-3, 3e-6, 0.0), (1e-4, 1e-8, 0.0)]
)
def test_what_sweeps_leave_comes_to_rest(speed: float, tolerance: float, loss: float) -> None:
    """On a floor without friction a box loses two tolerances a step, if it is slower than a hundred."""
    world = world_of(friction=0.0)
    world.set_constraint_solver("iterative", tolerance=tolerance)
    box = world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.0, 0.1))
    world.step(20)
    box.dq = [0.0, 0.0, 0.0, speed, 0.0, 0.0]
    for step in range(1, 26):
        world.step()
        assert box.dC[0] == pytest.approx(max(speed - step * loss, 0.0), abs=1e-7)


def test_no_gap_without_a_force_is_a_contact() -> None:
    """In a wall, where many shapes nearly touch."""
    world = world_of()
    wall(world, 6)
    for _ in range(20):
        world.step(20)
        assert all(contact.depth >= 0.0 or contact.f.any() for contact in world.collision_result.contacts)


def test_what_nothing_touches_keeps_its_speed() -> None:
    """However slow it is, and however near the ground."""
    world = world_of()
    world.set_gravity([0.0, 0.0, 0.0])
    box = world.add_box((0.2, 0.2, 0.2), 1.0, (0.0, 0.0, 0.1001))
    box.dq = [0.0, 0.0, 0.0, 1e-4, 0.0, 0.0]
    world.step(50)
    assert box.dC[0] == pytest.approx(1e-4, rel=1e-12)


def test_heavy_on_light() -> None:
    """A mass ratio of 1,000, three high: it stands, and sinks in by no more than 2 % of the light one."""
    world = world_of()
    for i, mass in enumerate((1.0, 1000.0, 1.0)):
        world.add_box((0.2, 0.2, 0.2), mass, (0.0, 0.0, 0.2 * (i + 0.5)))
    world.set_constraint_solver("iterative", iterations=200)
    world.step(2500)
    assert np.abs(centres(world) - [[0.0, 0.0, 0.2 * (i + 0.5)] for i in range(3)]).max() <= 0.02 * 0.2


def test_heavy_on_a_light_joint() -> None:
    """A thousand kilograms below one, each hung on the one above by a ball joint."""
    world = world_of(ground=False)
    top = None
    for i, mass in enumerate((1.0, 1.0, 1000.0)):
        body = world.add_box((0.1, 0.1, 0.1), mass, (0.0, 0.0, -0.3 * i)).bodynodes[0]
        place = [0.0, 0.0, 0.15 - 0.3 * i]
        joint = pydart2.constraints.BallJointConstraint
        joint(body, top, place).add_to_world(world)
        top = body
    world.set_constraint_solver("iterative", iterations=200)
    world.step(2500)
    assert np.abs(centres(world, 0) - [[0.0, 0.0, -0.3 * i] for i in range(3)]).max() <= 2e-3


def test_slope() -> None:
    """A flat box on a slope: a = g (sin - mu cos), from rest."""
    mu, angle, dt = 0.3, 0.5, 0.001
    world = world_of(dt, friction=mu)
    world.set_gravity([G * np.sin(angle), 0.0, -G * np.cos(angle)])
    world.set_constraint_solver("iterative", friction="cone")
    box = world.add_box((0.4, 0.4, 0.02), 1.0, (0.0, 0.0, 0.01), friction=mu)
    world.step(1000)
    expected = G * (np.sin(angle) - mu * np.cos(angle))
    assert abs(box.dC[0] - expected) <= 0.01 * expected


def test_rod_that_slides_down_a_wall() -> None:
    """Without friction: its middle is on a circle, and energy gives the speed of the angle."""
    length, start, dt = 1.0, 0.3, 0.0005
    world = world_of(dt, friction=0.0)
    world.add_box((0.2, 4.0, 4.0), None, (-0.1, 0.0, 1.0), fixed=True, friction=0.0)
    radius = 0.001
    rod = world.add_capsule(radius, length, 1.0, friction=0.0)
    inertia = rod.bodynodes[0].I[0, 0]
    half = length / 2.0
    rod.q = [0.0, -start, 0.0, half * np.sin(start) + radius, 0.0, half * np.cos(start) + radius]
    world.step(round(0.4 / dt))
    axis = rod.bodynodes[0].T[:3, 2]
    angle = float(np.arccos(abs(axis[2])))
    assert 0.4 < angle < 0.8  # the top still leans on the wall: until cos = 2/3 cos(start)
    rate = np.sqrt(2.0 * G * half * (np.cos(start) - np.cos(angle)) / (half**2 + inertia))
    assert abs(np.abs(rod.dq[:3]).max() - rate) <= 0.01 * rate


@pytest.mark.parametrize("restitution", [0.5, 0.8, 0.95])
def test_bounces(restitution: float) -> None:
    """Each of 20 bounces, as long as they count as such, comes to e² of the height before, within 2 %."""
    dt = 1e-4
    world = world_of(dt, restitution=1.0)
    ball = world.add_sphere(0.1, 1.0, (0.0, 0.0, 1.1), restitution=restitution)
    tops, height, rising = [1.0], 0.0, False
    while len(tops) < 21:
        world.step()
        speed = ball.dC[2]
        if rising and speed <= 0.0:
            tops.append(height)
        rising, height = speed > 0.0, ball.C[2] - 0.1
        if tops[-1] < 0.02 or world.t > 12.0:
            break
    ratios = np.array(tops[1:]) / np.array(tops[:-1])
    assert len(ratios) >= (20 if restitution > 0.9 else 2)
    assert np.abs(ratios / restitution**2 - 1.0).max() <= 0.02


def grid(heights: np.ndarray, spacing: float) -> tuple[np.ndarray, np.ndarray]:
    """Corners and triangles of a height field."""
    rows, columns = heights.shape
    x, y = np.meshgrid(spacing * (np.arange(columns) - columns / 2), spacing * (np.arange(rows) - rows / 2))
    corners = np.c_[x.ravel(), y.ravel(), heights.ravel()]
    cell = np.array([i * columns + j for i in range(rows - 1) for j in range(columns - 1)])
    lower = np.c_[cell, cell + 1, cell + columns + 1]
    return corners, np.r_[lower, np.c_[cell, cell + columns + 1, cell + columns]]


@pytest.mark.parametrize("kind", ["box", "ball"])
@pytest.mark.parametrize(
    ("floor", "angle", "direction"),
    [("mesh", 0.0, 0.0), ("mesh", 0.0, 0.3), ("heights", 0.0, 0.0), ("heights", 0.0, 0.3), ("heights", 0.2, 0.0)],
)
def test_inner_edges_do_not_catch(kind: str, floor: str, angle: float, direction: float) -> None:
    """Over a floor of triangles, level or a slope, a box slides and a ball rolls straight on, and neither hops."""
    world = world_of(0.001, ground=False)
    world.set_constraint_solver("iterative", friction="cone")  # a pyramid brakes more across its edges
    if floor == "mesh":
        world.add_mesh(*grid(np.zeros((41, 41)), 0.2), None, fixed=True, friction=0.1)
    else:
        heights = np.tile(0.2 * np.tan(angle) * np.arange(20.0, -21.0, -1.0), (41, 1))
        world.add_heightfield(heights, (0.2, 0.2, 1.0), friction=0.1)
    tilt = Rotation.from_rotvec([0.0, angle, 0.0]).as_matrix()
    up, way = tilt[:, 2], tilt @ [np.cos(direction), np.sin(direction), 0.0]
    place = tilt @ [-1.0, 0.03, 0.15]
    if kind == "box":
        body = world.add_box((0.3, 0.3, 0.3), 1.0, place, orientation=tilt, friction=0.1)
        body.dq = [0.0, 0.0, 0.0, *(2.0 * tilt.T @ way)]  # in the body's frame
    else:
        body = world.add_sphere(0.15, 1.0, place, friction=0.1)
        body.dq = [*(np.cross(up, 2.0 * way) / 0.15), *(2.0 * way)]
    start = body.C
    for _ in range(20):
        world.step(40)
        assert abs((body.C - start) @ up) <= 1e-3
    gone = body.C - start
    assert gone @ way > 1.0
    assert abs(gone @ np.cross(up, way)) <= 1e-3 * (gone @ way)


def built(
    world: pydart2.World, place: tuple[float, float, float], add: Callable[[pydart2.BodyNode], object]
) -> pydart2.Skeleton:
    """A free body with a shape that the world has no short way for."""
    skeleton = world.add_empty_skeleton(f"built {len(world.skeletons)}")
    add(skeleton.add_body("body", position=place))
    return skeleton


SHAPES: dict[str, Make] = {
    "box": lambda world, size, place: world.add_box((size, size, size), size**3 * 1000.0, place),
    "ball": lambda world, size, place: world.add_sphere(size / 2, size**3 * 500.0, place),
    "cylinder": lambda world, size, place: world.add_cylinder(size / 2, size, size**3 * 800.0, place),
    "capsule": lambda world, size, place: world.add_capsule(size / 4, size / 2, size**3 * 200.0, place),
    "cone": lambda world, size, place: built(world, place, lambda body: body.add_cone(size / 2, size)),
    "ellipsoid": lambda world, size, place: built(
        world, place, lambda body: body.add_ellipsoid((size, size, size / 2))
    ),
}


def drop(below: str, above: str, size: float, dt: float) -> tuple[float, float]:
    """One shape falls on another that stands on the ground, from its own size: depth over size, and speed, at 2 s.

    The depth is the largest of the last 0.1 s.
    """
    world = world_of(dt)
    height = {"capsule": size, "ellipsoid": size / 2}
    SHAPES[below](world, size, (0.0, 0.0, height.get(below, size) / 2.0))
    SHAPES[above](world, size, (0.0, 0.0, 2.0 * size + height.get(below, size) / 2.0))
    world.step(round(1.9 / dt))
    depth = 0.0
    for _ in range(round(0.1 / dt)):
        world.step()
        depth = max(depth, *(contact.depth for contact in world.collision_result.contacts), 0.0)
    speed = max(float(np.linalg.norm(skeleton.dC)) for skeleton in world.skeletons[1:])
    assert np.isfinite(world.x).all()
    assert centres(world)[:, 2].min() > 0.0
    return depth / size, speed


@pytest.mark.parametrize("dt", [0.001, 0.005])
@pytest.mark.parametrize("size", [0.01, 0.1, 1.0, 10.0])
def test_drops(size: float, dt: float) -> None:
    """What can rest does so, no deeper than 1 % of its size, at most at 1 mm/s: here two of a kind and boxes below."""
    for below, above in (
        ("box", "box"),
        ("box", "cylinder"),
        ("cylinder", "box"),
        ("cylinder", "cylinder"),
        ("box", "cone"),
    ):
        depth, speed = drop(below, above, size, dt)
        assert depth <= 0.01, (below, above)
        assert speed <= 1e-3, (below, above)


@pytest.mark.parametrize("speed", [1.0, 10.0, 60.0])
@pytest.mark.parametrize("kind", ["box", "ball"])
def test_what_comes_fast_stops_at_the_surface(kind: str, speed: float) -> None:
    """Also where a step takes it farther than its size."""
    world = world_of()
    body = SHAPES[kind](world, 0.1, (0.0, 0.0, 0.5))
    body.dq = [0.0, 0.0, 0.0, 0.0, 0.0, -speed]
    for _ in range(250):
        world.step()
        assert body.C[2] >= 0.05 - 1e-5
    assert body.C[2] <= 0.05 + 1e-5


def random_heap(seed: int, count: int = 12) -> pydart2.World:
    """Bodies of all kinds, of 3 cm to 30 cm and 1 g to 1,000 kg."""
    rng = np.random.default_rng(seed)
    world = world_of()
    for i in range(count):
        size = 10.0 ** rng.uniform(-1.5, -0.5)
        body = SHAPES[rng.choice(list(SHAPES))](world, size, (*rng.uniform(-0.2, 0.2, 2), 0.2 + 0.25 * i))
        mass = 10.0 ** rng.uniform(-3.0, 3.0)
        scale = mass / body.m
        part = body.bodynodes[0]
        part.set_mass(mass)
        part.set_inertia(scale * part.I)
        body.q = [*rng.uniform(-2.0, 2.0, 3), *body.q[3:]]
    return world


def check_random_heap(seed: int) -> None:
    world = random_heap(seed)
    world.step(200)
    assert np.isfinite(world.x).all(), seed
    assert centres(world)[:, 2].min() > 0.0, seed


def test_random_heaps() -> None:
    for seed in (*range(12), 4967):  # there 282 kg fall on 4 g that lie on the floor
        check_random_heap(seed)


@pytest.mark.soak
def test_ten_thousand_random_heaps() -> None:
    for seed in range(10_000):
        check_random_heap(seed)


@pytest.mark.soak
@pytest.mark.parametrize("dt", [0.001, 0.005])
@pytest.mark.parametrize("size", [0.01, 0.1, 1.0, 10.0])
def test_all_drops(size: float, dt: float) -> None:
    """Each shape on each other; what is round rolls off, and then only must not sink."""
    for below, above in itertools.product(SHAPES, SHAPES):
        depth, speed = drop(below, above, size, dt)
        assert depth <= 0.01, (below, above)
        assert speed <= 1e-3 or {below, above} & {"ball", "capsule", "ellipsoid", "cone"}, (below, above, speed)


def test_heap_with_sleepers_goes_on_bit_for_bit() -> None:
    """Snapshot, clone, pickle and batch in the middle of a heap some of which sleeps."""
    world = world_of()
    world.set_sleeping()
    stack(world, 3)
    for i in range(6):
        world.add_box((0.2, 0.2, 0.2), 1.0, (2.0 + 0.05 * i, 0.0, 0.15 + 0.3 * i))
    world.step(600)
    for i in range(4):
        world.add_capsule(0.05, 0.1, 1.0, (0.02 * i, 0.0, 1.0 + 0.3 * i))
    world.step(60)
    assert 0 < len(world.sleepers()) < len(world.skeletons) - 1
    snapshot = world.snapshot()
    copies = [world.clone(), pickle.loads(pickle.dumps(world))]
    batch = pydart2.Batch(world, 2)
    world.step(300)
    expected, asleep = world.x.tobytes(), [skeleton.name for skeleton in world.sleepers()]
    copies[0].step(300)
    copies[1].step(300)
    batch.step(300)
    copies += batch.worlds
    for copy in copies:
        assert copy.x.tobytes() == expected
        assert [skeleton.name for skeleton in copy.sleepers()] == asleep
    world.restore(snapshot)
    world.step(300)
    assert world.x.tobytes() == expected


def test_three_rows_of_shapes_fall_asleep() -> None:
    """Dropped 2 cm with a spin: all sleep within 3 s, none sinks by 1 mm, and a ball wakes just what it reaches."""
    world = world_of(0.001)
    world.set_sleeping()
    rng = np.random.default_rng(0)
    for i in range(10):
        for row, make in enumerate((world.add_box, world.add_cylinder, world.add_sphere)):
            size = ((1.0, 1.0, 1.0),) if row == 0 else (0.5, 1.0) if row == 1 else (0.5,)
            body = make(*size, None, (1.5 * i, 1.5 * row, 0.52))
            body.dq = [*rng.uniform(-0.1, 0.1, 3), 0.0, 0.0, 0.0]
    world.step(3000)
    assert len(world.sleepers()) == 30
    assert centres(world)[:, 2].min() >= 0.499
    ball = world.add_sphere(0.1, None, (-1.0, 0.0, 0.1))
    ball.dq = [0.0, 1.0 / 0.1, 0.0, 1.0, 0.0, 0.0]
    world.step(600)
    assert [skeleton for skeleton in world.skeletons[1:] if not skeleton.is_asleep()] == [world.skeletons[1], ball]


def grip(seconds: float) -> float:
    """How far a box of 0.2 kg slips in PR2's left gripper, m, once it is held."""
    world = world_of(0.001, ground=False)
    robot = world.add_skeleton(pydart2.data_path("urdf/PR2/pr2.urdf"))
    fingers = [f"l_gripper_{side}_finger{part}_joint" for side in "lr" for part in ("", "_tip")]
    for joint in robot.joints:
        if joint.num_dofs() and joint.name not in fingers:
            joint.set_actuator_type(pydart2.Joint.LOCKED)
    q = robot.q
    for name in fingers:
        q[robot.dof(name).id] = 0.5
    robot.q = q
    tool, finger = robot.body("l_gripper_tool_frame"), robot.dof(fingers[0])
    box = world.add_box((0.03, 0.06, 0.03), 0.2, tool.T[:3, 3])

    def held(steps: int) -> np.ndarray:
        for _ in range(steps):
            finger.set_force(-3.0)
            world.step()
        return tool.T[:3, :3].T @ (box.C - tool.C)

    first = held(750)
    return float(np.linalg.norm(held(round(1000.0 * seconds)) - first))


def test_gripper_holds() -> None:
    assert grip(1.0) <= 1e-4


@pytest.mark.soak
def test_gripper_holds_for_ten_seconds() -> None:
    assert grip(10.0) <= 1e-3


def check_ragdolls(count: int, steps: int) -> None:
    """Limp humans of 33 dofs that fall on each other: none blows up or gets through the floor."""
    world = world_of(0.001)
    for i in range(count):
        add_ragdoll(world, f"doll {i}", 1.2 + 0.8 * i, float(np.sin(7.0 * i)))
    assert {skeleton.ndofs for skeleton in world.skeletons[1:]} == {33}
    world.step(steps)
    bodies = [body for skeleton in world.skeletons[1:] for body in skeleton.bodynodes]
    assert min(body.C[2] for body in bodies) > 0.0
    assert max(float(np.linalg.norm(body.dC)) for body in bodies) < 20.0


def test_ragdolls() -> None:
    check_ragdolls(2, 600)


@pytest.mark.soak
def test_ten_ragdolls() -> None:
    check_ragdolls(10, 3000)
