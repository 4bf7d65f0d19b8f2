# SPDX-License-Identifier: MIT
"""Poses, one and arrays of them, against matrices of 4 x 4."""

import pickle

import cubemap
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

Pose = cubemap.Pose


def cross_of(twist):
    """The matrix of 4 x 4 whose exponential is the motion."""
    x, y, z = twist[3:]
    return np.array([[0, -z, y, twist[0]], [z, 0, -x, twist[1]], [-y, x, 0, twist[2]], [0, 0, 0, 0]])


def exponential(matrix):
    """By its series, of a matrix that was halved until it was short."""
    halvings = 8
    term = result = np.eye(4)
    for k in range(1, 20):
        term = term @ matrix / 2**halvings / k
        result = result + term
    return np.linalg.matrix_power(result, 2**halvings)


@pytest.fixture
def twists(random):
    return random.normal(size=(50, 6))


def test_exp_is_the_matrix_exponential(twists):
    poses = Pose.exp(twists)
    assert poses.shape == (50,) and len(poses) == 50
    assert np.abs(poses.matrix - [exponential(cross_of(twist)) for twist in twists]).max() < 1e-13
    short = twists * (3 / np.maximum(np.linalg.norm(twists[:, 3:], axis=1, keepdims=True), 3))
    assert np.abs(Pose.exp(short).log() - short).max() < 1e-13
    assert np.abs(poses.angle - np.linalg.norm(poses.log()[:, 3:], axis=1)).max() < 1e-14


def test_products(twists):
    a, b = Pose.exp(twists[:4])[:, np.newaxis], Pose.exp(twists[4:9])
    product = a @ b
    assert product.shape == (4, 5) and np.abs(product.matrix - a.matrix @ b.matrix).max() < 1e-14
    assert np.abs(a.inverse().matrix - np.linalg.inv(a.matrix)).max() < 1e-14
    assert np.abs(a.between(b).matrix - np.linalg.inv(a.matrix) @ b.matrix).max() < 1e-13
    assert (Pose() @ b[1]) == b[1] == b[1] @ Pose()
    far = Pose(np.eye(3), (1e12, 0, 0))
    assert far.between(Pose(np.eye(3), (1e12 + 1, 0, 0))).position.tolist() == [1, 0, 0]
    with pytest.raises(TypeError):
        a @ np.eye(4)
    with pytest.raises(TypeError):
        np.eye(4) @ a
    with pytest.raises(ValueError):
        Pose.exp(twists[:3]) @ Pose.exp(twists[:4])


def test_points(twists, random):
    poses, points = Pose.exp(twists), random.normal(size=(7, 1, 3))
    seen = poses.apply(points)
    assert seen.shape == (7, 50, 3) and np.abs(poses.apply_back(seen) - points).max() < 1e-14
    assert np.abs(seen - np.einsum("nij,knj->kni", poses.rotation, points - poses.position)).max() < 1e-14
    out = np.empty((7, 50, 3))
    assert poses.apply(points, out=out) is out and np.array_equal(out, seen)
    strided = np.zeros((7, 1, 6))[..., ::2]
    strided[:] = points
    assert np.array_equal(poses.apply(strided), seen)
    for wrong in (np.zeros(4), np.zeros((3, 3))[:, :2]):
        with pytest.raises(ValueError):
            poses.apply(wrong)


def test_screws(twists):
    a, b = Pose.exp(twists[0]), Pose.exp(twists[1])
    path = a.interpolate(b, [0.0, 0.25, 0.5, 1.0])
    assert path.shape == (4,) and path[0] == a and path[3] == b
    # a screw is half of a half, too
    assert np.abs(path[1].matrix - a.interpolate(path[2], 0.5).matrix).max() < 1e-14
    assert np.abs(path[2].matrix - (a @ Pose.exp(0.5 * a.between(b).log())).matrix).max() < 1e-14


def test_small_twists_and_covariances(twists, random):
    pose = Pose.exp(twists[:3])
    small = 1e-6 * twists[3]
    moved = (pose @ Pose.exp(small)).matrix
    assert np.abs(moved - (Pose.exp(pose.adjoint() @ small) @ pose).matrix).max() < 1e-15
    root = random.normal(size=(6, 6))
    covariance = root @ root.T
    transported = pose.transport(covariance)
    assert np.abs(transported - pose.adjoint() @ covariance @ np.swapaxes(pose.adjoint(), -1, -2)).max() < 1e-12
    assert np.array_equal(transported, np.swapaxes(transported, -1, -2))
    assert np.abs(pose.inverse().transport(transported) - covariance).max() < 1e-11
    with pytest.raises(ValueError):
        pose.transport(np.eye(5))


def test_quaternions_and_matrices(twists):
    poses = Pose.exp(twists)
    q = poses.quaternion
    assert q.shape == (50, 4) and np.abs(np.linalg.norm(q, axis=-1) - 1).max() < 1e-15 and (q[:, 3] >= 0).all()
    again = Pose.from_quaternion(poses.position, q)
    assert np.abs(again.matrix - poses.matrix).max() < 1e-15
    assert Pose.from_matrix(poses.matrix) == poses
    # a quarter turn about z takes the camera's x to the world's y
    quarter = Pose.from_quaternion((1, 2, 3), (0, 0, np.sqrt(0.5), np.sqrt(0.5)))
    assert np.abs(quarter.apply_back((1, 0, 0)) - (1, 3, 3)).max() < 1e-15
    assert Pose.from_quaternion((0, 0, 0), (0, 0, 0, 1.0005)).rotation.tolist() == np.eye(3).tolist()
    for wrong in ((0, 0, 0, 1.01), (0, 0, 0, 0), (np.nan, 0, 0, 1)):
        with pytest.raises(cubemap.Error) as caught:
            Pose.from_quaternion((0, 0, 0), wrong)
        assert caught.value.status == 17
    for wrong in (np.ones((4, 4)), np.eye(3), np.diag([1, 1, -1, 1])):
        with pytest.raises(ValueError):
            Pose.from_matrix(wrong)


def test_poses_are_values(twists):
    for pose in (Pose(), Pose.exp(twists[0]), Pose.exp(twists[:6].reshape(2, 3, 6)),
                 Pose(cubemap.Rotation("10,20,30"), (1, 2, 3))):
        again = pickle.loads(pickle.dumps(pose))
        assert again == pose and hash(again) == hash(pose) and eval(repr(pose)) == pose
    poses = Pose.exp(twists[:6].reshape(2, 3, 6))
    assert poses[1, 2] == poses[1][2] != poses[0, 2] and poses[:, 1].shape == (2,)
    assert poses[..., np.newaxis].shape == (2, 3, 1)
    assert [one.shape for one in poses] == [(3,), (3,)]
    assert Pose(position=(-0.0, 0, 0)) == Pose()
    with pytest.raises(ValueError):
        poses.position[0, 0] = 1
    with pytest.raises(TypeError):
        len(Pose())
    with pytest.raises(IndexError):
        poses[2]


def test_refused_poses():
    turned_over, nothing = np.diag([1.0, 1.0, -1.0]), np.full((3, 3), np.nan)
    for rotation, position in ((turned_over, (0, 0, 0)), (nothing, (0, 0, 0)), (np.eye(3), (0, np.inf, 0)),
                               (1.001 * np.eye(3), (0, 0, 0)),
                               (np.stack((np.eye(3), turned_over)), (0, 0, 0))):
        with pytest.raises(cubemap.Error) as caught:
            Pose(rotation, position)
        assert caught.value.status == 17
    for rotation, position in ((np.eye(4), (0, 0, 0)), (np.eye(3), (0, 0)),
                               (np.stack([np.eye(3)] * 2), np.zeros((3, 3)))):
        with pytest.raises(ValueError):
            Pose(rotation, position)


def test_what_is_no_number_stays_none():
    pose = Pose.exp((0, 0, 0, np.nan, 0, 0))
    assert np.isnan(pose.rotation).any() and np.isnan((pose @ Pose()).rotation).any() and np.isnan(pose.log()).any()
    assert cubemap.pose_check(pose.rotation, pose.position) == 17 and cubemap.rotation_check(np.eye(3)) == 0
    assert cubemap.rotation_check(np.ones((5, 3, 3))).tolist() == [12] * 5


@given(st.tuples(*[st.floats(-1e6, 1e6)] * 3), st.tuples(*[st.floats(-1, 1)] * 3),
       st.sampled_from([0.0, 1e-300, 1e-9, 1e-3, 1.0, np.pi - 1e-9, np.pi]))
def test_log_is_the_inverse_of_exp(translation, axis, angle):
    length = np.linalg.norm(axis)
    axis = np.array(axis) / length if length > 1e-3 else np.array((0.0, 0.0, 1.0))
    twist = np.concatenate((translation, angle * axis))
    pose = Pose.exp(twist)
    again = Pose.exp(pose.log())
    assert np.abs(again.rotation - pose.rotation).max() < 4e-15
    assert np.abs(again.position - pose.position).max() <= 1e-14 * (1 + np.abs(translation).max())
    if angle < 3:
        assert np.abs(pose.log()[3:] - twist[3:]).max() < 4e-15
