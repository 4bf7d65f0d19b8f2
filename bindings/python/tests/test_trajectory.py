# SPDX-License-Identifier: MIT
"""Trajectories: errors of known perturbations and those that truth/trajectory_truth.py finds; motion and inertial
sensors."""

import importlib.util
import pickle

import cubemap
import numpy as np
import pytest

Pose = cubemap.Pose
CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


@pytest.fixture(scope="module")
def judge(root):
    specification = importlib.util.spec_from_file_location("trajectory_truth", root / "truth/trajectory_truth.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@pytest.fixture
def path(random):
    """200 poses in 10 s."""
    stamps = np.sort(random.uniform(0, 10, 200))
    return cubemap.Trajectory(stamps, Pose.exp(np.cumsum(0.05 * random.normal(size=(200, 6)), axis=0)))


def standing(positions, interval=0.5):
    return cubemap.Trajectory(interval * np.arange(len(positions)), Pose(position=positions))


def test_ate_of_known_perturbations():
    truth = standing(CUBE)
    moved = Pose.exp((1, 2, 3, 0.3, -0.2, 0.5))
    exact = truth.evaluate(cubemap.Trajectory(truth.stamps, moved @ truth.poses))
    assert exact.ate_rmse < 1e-15 and exact.rpe_translation_rmse < 1e-15 and exact.rpe_rotation_rmse_degrees < 1e-13
    assert np.abs((exact.alignment @ moved).matrix - np.eye(4)).max() < 1e-15
    assert (exact.rank, exact.is_determined) == (3, True)
    assert (exact.pairs, exact.motions) == (8, 6)
    # larger by a tenth about its middle: no motion makes it better, and every corner is off by a tenth of sqrt(3)
    assert truth.evaluate(standing(1.1 * CUBE)).ate_rmse == pytest.approx(0.1 * np.sqrt(3), rel=1e-14)
    # on a line the alignment is one of many
    line = standing(np.arange(9)[:, np.newaxis] * (1.0, 2.0, 3.0))
    assert line.evaluate(line)[-2:] == (1, False) and line.evaluate(line).ate_rmse < 1e-14


def test_rpe_of_known_drifts():
    """2 degrees each step, 2 steps a second: 4 degrees an interval of 1 s, 8 of 2 s."""
    steps = np.arange(20)
    truth = standing(np.zeros((20, 3)))
    turned = cubemap.Trajectory(truth.stamps, Pose.exp(np.radians(2) * steps[:, np.newaxis] * (0, 0, 0, 0, 0, 1.0)))
    found = truth.evaluate(turned)
    assert found.rpe_rotation_rmse_degrees == pytest.approx(4, rel=1e-13) and found.rpe_translation_rmse == 0
    assert found.motions == 18
    assert truth.evaluate(turned, interval=2.0).rpe_rotation_rmse_degrees == pytest.approx(8, rel=1e-13)
    moved = standing(steps[:, np.newaxis] * (0.3, 0.4, 0))
    assert truth.evaluate(moved).rpe_translation_rmse == pytest.approx(1.0, rel=1e-14)
    assert np.isnan(truth.evaluate(turned, interval=100.0).rpe_translation_rmse)


def test_errors_are_those_of_the_judge(judge, path, random, tmp_path):
    for number in range(5):
        pose = path.poses @ Pose.exp(0.02 * random.normal(size=(200, 6)))
        estimate = cubemap.Trajectory(path.stamps + random.uniform(-5e-4, 5e-4, 200) + 5e-3 * np.arange(200), pose)
        for name, one in (("truth", path), ("estimate", estimate)):
            np.savetxt(tmp_path / name, np.column_stack((one.stamps, one.poses.position, one.poses.quaternion)),
                       fmt="%.17g")
        expected = judge.evaluate(tmp_path / "truth", tmp_path / "estimate")
        found = path.evaluate(estimate)
        assert 5 < found.pairs < 200 and found.is_determined != expected["rank_deficient"]
        for name in ("pairs", "motions", "ate_rmse", "rpe_translation_rmse", "rpe_rotation_rmse_degrees"):
            assert getattr(found, name) == pytest.approx(expected[name], abs=1e-9), name
        mine, others = path.associate(estimate)
        assert list(zip(mine, others, strict=True)) == judge.associate(path.stamps, estimate.stamps)


def test_alignment(random):
    points = random.normal(size=(30, 3))
    motion = Pose.exp((1, 2, 3, 0.5, 0.6, 0.7))
    found = cubemap.align(points, motion.apply_back(points))
    assert np.abs(found.motion.matrix - motion.matrix).max() < 1e-14 and found[1:] == (3, True)
    assert cubemap.align(points * (1, 1, 0), points * (1, 1, 0))[1:] == (2, True)
    assert cubemap.align(points, points * (1, 1, -1)).rank == 3
    assert cubemap.align(np.ones((4, 3)), np.ones((4, 3)))[1:] == (0, False)
    for wrong in ((points, points[:5]), (points[:, :2], points[:, :2]), (points[0], points[0])):
        with pytest.raises(ValueError):
            cubemap.align(*wrong)
    for wrong in ((points[:0], points[:0]), (np.nan * points, points), (1e101 * points, points)):
        with pytest.raises(cubemap.Error):
            cubemap.align(*wrong)


def test_times(path):
    stamps = path.stamps
    assert len(path) == 200 and np.array_equal(path.interpolate(stamps).matrix, path.poses.matrix)
    middle = 0.5 * (stamps[3] + stamps[4])
    expected = path.poses[3].interpolate(path.poses[4], 0.5)
    assert np.abs(path.interpolate(middle).matrix - expected.matrix).max() < 1e-13
    assert path.interpolate(middle).shape == ()
    beside = path.interpolate([[stamps[0] - 1e-9, stamps[5]], [stamps[-1] + 1e-9, np.nan]])
    assert beside.shape == (2, 2) and np.isnan(beside.position[..., 0]).tolist() == [[True, False], [True, True]]
    assert np.array_equal(path.nearest(stamps[::-1] + 1e-9, 1e-6), np.arange(200)[::-1])
    assert path.nearest(stamps[0] - 1) == path.nearest(np.nan) == cubemap.NO_INDEX
    assert path.nearest([[stamps[9]]]).tolist() == [[9]]
    assert path.nearest(stamps[0] - 1, [0.5, 2.0]).tolist() == [-1, 0]
    stamp, rotation, position = path.at([[5], [7]])
    assert np.array_equal(stamp, stamps[[[5], [7]]])
    assert np.array_equal(Pose(rotation, position).matrix, path.poses[[[5], [7]]].matrix)
    assert np.isnan(path.at([200, -1])[0]).all()
    for wrong in ((np.zeros(3), np.zeros(4)),):
        with pytest.raises(ValueError):
            path.nearest(*wrong)
    with pytest.raises(TypeError):
        path.at(0.5)


def test_trajectories_are_values(path):
    again = pickle.loads(pickle.dumps(path))
    assert again == path and hash(again) == hash(path) and again != standing(CUBE) and "200 poses" in repr(path)
    motion = cubemap.Motion(path)
    assert pickle.loads(pickle.dumps(motion)) == motion and motion.trajectory == path


def test_refused_trajectories(path):
    poses = Pose(position=CUBE)
    for stamps, index in (([0, 1, 2, 2, 3, 4, 5, 6], 3), ([0, 1, 2, 3, 2.5, 4, 5, 6], 4),
                          ([0, np.nan, 2, 3, 4, 5, 6, 7], 1)):
        with pytest.raises(cubemap.Error, match=f"index {index}") as caught:
            cubemap.Trajectory(stamps, poses)
        assert caught.value.status == 20
    with pytest.raises(cubemap.Error, match="index 7") as caught:
        cubemap.Trajectory(np.arange(8),
                           Pose._make((poses.rotation, np.where(np.arange(8)[:, np.newaxis] == 7, np.nan, CUBE))))
    assert caught.value.status == 17
    for stamps in (np.arange(7), np.arange(8).reshape(2, 4)):
        with pytest.raises(ValueError):
            cubemap.Trajectory(stamps, poses)
    with pytest.raises(cubemap.Error):
        cubemap.Trajectory([], poses[:0])
    later = cubemap.Trajectory(path.stamps + 100, path.poses)
    with pytest.raises(cubemap.Error) as caught:
        path.evaluate(later)
    assert caught.value.status == 18 and all(one.size == 0 for one in path.associate(later))
    for wrong in ({"apart": -1.0}, {"apart": np.nan}, {"interval": -1.0}):
        with pytest.raises(cubemap.Error):
            path.evaluate(path, **wrong)
    with pytest.raises(cubemap.Error):
        path.associate(path, -1.0)


def circle():
    """A turn a 2 pi seconds, 2 m from the middle, looking ahead: closed forms for all there is."""
    t = np.linspace(0, 6, 601)
    zero = 0 * t
    return cubemap.Trajectory(t, Pose.from_quaternion(np.stack((2 * np.cos(t), 2 * np.sin(t), zero), axis=-1),
                                                      np.stack((zero, zero, np.sin(t / 2), np.cos(t / 2)), axis=-1)))


def test_motion_on_a_circle():
    motion = cubemap.Motion(circle())
    t = np.linspace(1, 5, 9)[:, np.newaxis] + [0, 0.003]
    state = motion.at(t)
    zero = 0 * t
    assert state.pose.shape == (9, 2)
    assert np.abs(state.pose.position - np.stack((2 * np.cos(t), 2 * np.sin(t), zero), -1)).max() < 1e-8
    assert np.abs(state.velocity - np.stack((-2 * np.sin(t), 2 * np.cos(t), zero), -1)).max() < 1e-6
    assert np.abs(state.acceleration - np.stack((-2 * np.cos(t), -2 * np.sin(t), zero), -1)).max() < 1e-4
    assert np.abs(state.rate - (0, 0, 1)).max() < 1e-6
    assert np.isnan(motion.at([-0.1, 6.1]).velocity).all() and motion.at(3.0).pose.shape == ()
    # what turns with it feels gravity, and 2 m/s^2 towards the middle
    made = motion.inertial(100, (0, 0, -9.81))
    assert made.stamps.shape == (601,) and np.abs(made.stamps - np.arange(601) / 100).max() < 1e-12
    inner = slice(50, 550)
    assert np.abs(made.acceleration[inner] - (-2, 0, 9.81)).max() < 1e-4
    assert np.abs(made.rate[inner] - (0, 0, 1)).max() < 1e-6


def test_noise_of_sensors():
    motion = cubemap.Motion(circle())
    clean = motion.inertial(100, (0, 0, 0))
    biased = motion.inertial(100, (0, 0, 0), latency=0.02, gyroscope=cubemap.InertialNoise(bias=(0.1, 0.2, 0.3)))
    assert np.abs(biased.rate - clean.rate - (0.1, 0.2, 0.3)).max() < 1e-12
    assert np.array_equal(biased.acceleration, clean.acceleration)
    assert np.abs(biased.stamps - clean.stamps - 0.02).max() < 1e-12
    noisy = motion.inertial(100, (0, 0, 0), accelerometer=cubemap.InertialNoise(density=0.05), seed=7)
    off = noisy.acceleration - clean.acceleration
    # density times root of the rate
    assert off.std() == pytest.approx(0.5, rel=0.05) and np.array_equal(noisy.rate, clean.rate)
    again = motion.inertial(100, (0, 0, 0), accelerometer=cubemap.InertialNoise(density=0.05), seed=7)
    assert np.array_equal(again.acceleration, noisy.acceleration)
    other = motion.inertial(100, (0, 0, 0), accelerometer=cubemap.InertialNoise(density=0.05), seed=8)
    assert not np.array_equal(other.acceleration, noisy.acceleration)
    for wrong in ({"rate": 0.0}, {"rate": 1e12}, {"gravity": (0, 0, np.nan)}, {"latency": np.inf},
                  {"gyroscope": cubemap.InertialNoise(density=-1.0)}):
        with pytest.raises(cubemap.Error):
            motion.inertial(**{"rate": 100.0, "gravity": (0, 0, 0), **wrong})
    with pytest.raises(ValueError):
        motion.inertial(100, (0, 0))
