"""What sensors read: the signs of real ones, contact forces, rate, noise and bias."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pydart2 import Batch, SimpleFrame, World
from pydart2.sensors import IMU, BatchSensors, ForceTorque, JointEncoder, Lidar, Sensors, Touch

G = 9.81


def test_an_accelerometer_at_rest_and_in_free_fall() -> None:
    """9.81 upwards on the ground, in the axes of the sensor; zero while falling."""
    world = World(0.001)
    world.add_ground()
    box = world.add_box((0.2, 0.2, 0.2), mass=2.0, position=(0, 0.1, 0)).bodynodes[0]
    ball = world.add_sphere(0.1, position=(0, 50.0, 0)).bodynodes[0]
    resting, falling = IMU(SimpleFrame(box, [[1, 0, 0], [0, 0, 1], [0, -1, 0]], [0, 0.05, 0])), IMU(ball)
    world.step(500)
    assert_allclose(resting.read(), [0.0, 0.0, G, 0.0, 0.0, 0.0], atol=1e-6)
    assert_allclose(falling.read(), np.zeros(6), atol=1e-9)
    assert_allclose(Touch(box).read(), [2.0 * G], rtol=1e-6)
    assert_allclose(Touch(ball).read(), [0.0], atol=0.0)


def test_an_accelerometer_on_a_turntable() -> None:
    """Towards the axis with w^2 r, and the gyroscope with w."""
    world = World(1e-4)
    world.set_gravity([0.0, 0.0, -G])
    table = world.add_empty_skeleton("table")
    disc = table.add_body("disc", joint="revolute", axis=(0, 0, 1))
    disc.add_cylinder(0.5, 0.1, mass=1.0)
    table.dq = [3.0]
    world.step()
    reading = IMU(SimpleFrame(disc, translation=[0.4, 0.0, 0.0])).read()
    assert_allclose(reading, [-9.0 * 0.4, 0.0, G, 0.0, 0.0, 3.0], atol=1e-9)


def test_a_force_sensor_reads_what_the_table_does() -> None:
    """An arm presses a finger on a table: the wrist carries the contact force but for the finger's own weight."""
    world = World(0.001)
    world.set_collision_detector(0)
    world.add_box((0.5, 0.1, 0.5), position=(0, -0.05, 0), fixed=True)
    arm = world.add_empty_skeleton("arm")
    slide = arm.add_body("slide", joint="prismatic", axis=(0, 1, 0), position=(0, 0.3, 0))
    slide.add_mass(1.0, inertia=0.01 * np.eye(3))
    finger = arm.add_body("finger", slide, "weld", position=(0, -0.25, 0))
    finger.add_box((0.1, 0.1, 0.1), mass=0.2)
    for _ in range(2000):
        arm.tau = [-20.0]
        world.step()
    wrist = ForceTorque(finger.parent_joint)
    table = finger.contact_force()
    assert_allclose(table, [0.0, 20.0 + 1.2 * G, 0.0], atol=1e-6)
    assert_allclose(wrist.read()[3:], [0.0, 0.2 * G, 0.0] - table, atol=1e-9)


def test_rate_noise_and_bias() -> None:
    """A reading stays until the next is due; noise comes from the seed."""
    world = World(0.001)
    table = world.add_empty_skeleton("table")
    table.add_body("disc", joint="revolute", axis=(0, 1, 0)).add_cylinder(0.5, 0.1, mass=1.0)
    table.dq = [1.0]
    slow, biased = JointEncoder(table.dofs, rate=100.0), JointEncoder(table.dofs, bias=0.5)
    noisy, same = (JointEncoder(table.dofs, noise=0.01, seed=4) for _ in range(2))
    readings, errors = [], []
    for _ in range(1000):
        world.step()
        readings.append(slow.read()[0])
        errors.append(noisy.read()[0] - table.q[0])
        assert noisy.read()[0] == same.read()[0] == noisy.read()[0]
    assert len(set(readings)) == 100
    assert_allclose(biased.read(), table.q + 0.5, atol=1e-12)
    assert_allclose([np.mean(errors), np.std(errors)], [0.0, 0.01], atol=1e-3)


def test_one_array_for_a_robot() -> None:
    """With a name for each number."""
    world = World(0.001)
    arm = world.add_empty_skeleton("arm")
    link = arm.add_body("link", joint="revolute", axis=(0, 0, 1))
    link.add_box((0.3, 0.1, 0.1), mass=1.0)
    sensors = Sensors([JointEncoder(arm.dofs), ForceTorque(arm.joints[0]), Touch(link), IMU(link)])
    world.step()
    assert sensors.read().shape == (len(sensors.labels),) == (14,)
    assert sensors.labels[0] == "link_joint.position" and sensors.labels[-1] == "link.rate_z"
    assert Sensors([]).read().shape == (0,)


def test_what_does_not_fit_is_refused() -> None:
    """With a sentence."""
    with pytest.raises(ValueError, match="needs a dof"):
        JointEncoder([])
    with pytest.raises(ValueError, match="rate"):
        Touch(World(0.001).add_sphere(0.1).bodynodes[0], rate=0.0)
    with pytest.raises(ValueError, match="fixed in the world"):
        IMU(SimpleFrame())


def test_what_is_set_later_is_checked() -> None:
    """As what is given at first; a refusal changes nothing, and copies change nothing."""
    body = World(0.001).add_sphere(0.1).bodynodes[0]
    imu = IMU(body, noise=0.5, rate=10.0)
    for rate in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="rate"):
            imu.rate = rate
    for noise in (-1.0, np.nan, np.ones(5)):
        with pytest.raises(ValueError, match="noise"):
            imu.noise = noise
    with pytest.raises(ValueError, match="one for each of its 6"):
        imu.bias = [1.0, 2.0]
    imu.noise[:] = 7.0
    assert imu.rate == 10.0 and imu.noise.tolist() == [0.5] * 6 and imu.bias.tolist() == [0.0] * 6
    imu.rate, imu.noise, imu.bias = None, np.zeros(6), np.arange(6)
    assert_allclose(imu.read() - imu.measure(), np.arange(6), atol=1e-12)
    with pytest.raises(AttributeError):
        imu.world = None  # type: ignore[misc, assignment]


def test_the_pose_of_a_frame_stays_one() -> None:
    """What is set is checked as what is given at first."""
    frame = SimpleFrame()
    for wrong in (np.eye(3), 2.0 * np.eye(4), np.full((4, 4), np.nan), np.diag([1.0, 1.0, -1.0, 1.0])):
        with pytest.raises(ValueError, match=r"pose|rotation"):
            frame.relative = wrong
    for wrong in (np.eye(2), np.eye(4), np.ones(3)):
        with pytest.raises(ValueError, match="an orientation is"):
            SimpleFrame(rotation=wrong)
    assert frame.relative.tolist() == np.eye(4).tolist()


def test_an_encoder_reads_one_skeleton() -> None:
    """The dofs of another would be read in the first one's places."""
    world = World(0.001)
    one, other = (world.add_sphere(0.1, position=(x, 0, 0)) for x in (0.0, 1.0))
    with pytest.raises(ValueError, match="of one skeleton"):
        JointEncoder([one.dofs[0], other.dofs[1]])


def test_a_lidar_in_a_corridor() -> None:
    """Walls at x = 3 and y = 2 seen from the origin, from a frame that is turned and moves along."""
    world = World(0.001, up="z")
    world.set_gravity([0.0, 0.0, 0.0])
    for place in ([3.5, 0.0, 0.0], [0.0, 2.5, 0.0]):
        world.add_box([1.0, 9.0, 9.0] if place[0] else [9.0, 1.0, 9.0], 1.0, place, fixed=True)
    robot = world.add_sphere(0.2, 1.0, name="robot")
    angles = np.deg2rad([-20.0, 0.0, 20.0, 80.0])
    directions = 5.0 * np.stack([np.cos(angles), np.sin(angles), np.zeros(4)], axis=1)
    expected = [3 / np.cos(angles[0]), 3.0, 3 / np.cos(angles[2]), 2 / np.sin(angles[3])]
    assert_allclose(Lidar(robot.bodynodes[0], directions).read(), expected, rtol=1e-12)
    quarter = SimpleFrame(robot.bodynodes[0], [[0, -1, 0], [1, 0, 0], [0, 0, 1]])  # its x is the robot's y
    assert_allclose(Lidar(quarter, [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]).read(), [2.0, 3.0], rtol=1e-12)
    robot.q = [0.0, 0.0, 0.0, 0.5, 0.0, 0.0]
    ahead = Lidar(robot.bodynodes[0], [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], max_distance=9.0)
    assert_allclose(ahead.read(), [2.5, np.inf])
    assert [label.split(".")[1] for label in ahead.labels] == ["range_0", "range_1"]


def test_a_fan_of_rays() -> None:
    rays = Lidar.fan(np.pi, 5)
    assert_allclose(np.arctan2(rays[:, 1], rays[:, 0]), np.linspace(-np.pi / 2, np.pi / 2, 5))
    world = World(0.001)
    body = world.add_sphere(0.1).bodynodes[0]
    with pytest.raises(ValueError, match="shape \\(n, 3\\), none of them 0"):
        Lidar(body, [[0.0, 0.0, 0.0]])
    with pytest.raises(ValueError, match="a sensor sits on a body"):
        Lidar(SimpleFrame(None), rays)
    for many in (0, -1, 2**31, 10**30):  # of which NumPy would fill the memory with 50 GB
        with pytest.raises(ValueError, match="a fan has 1 to 10,000,000 rays, got"):
            Lidar.fan(np.pi, many)
    with pytest.raises(TypeError, match="a sensor sits on a body or a SimpleFrame"):
        Lidar("sphere", rays)  # type: ignore[arg-type]


def test_sensors_of_a_batch() -> None:
    world = World(0.001)
    world.set_gravity([0.0, -G, 0.0])
    world.add_ground()
    world.add_sphere(0.1, position=(0, 5.0, 0), name="ball")
    batch = Batch(world, 3)
    batch.q = batch.q + np.array([[0.0, 0, 0, 0, i, 0] for i in range(3)])
    sensors = BatchSensors(
        batch, lambda w: Sensors([Lidar(w["ball"].bodynodes[0], [[0.0, -1.0, 0.0]]), JointEncoder(w["ball"].dofs[4:5])])
    )
    assert_allclose(sensors.read(), [[5.0 + i, 5.0 + i] for i in range(3)])
    assert len(sensors.labels) == 2
