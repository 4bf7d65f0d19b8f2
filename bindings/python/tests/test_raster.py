# SPDX-License-Identifier: MIT
"""What is drawn into cameras, against rays met with planes one by one."""

import concurrent.futures

import cubemap
import numpy as np
import pytest

LENS = cubemap.Camera(96, 64, 80, 82, 47.5, 31.0, distortion=(-0.1, 0.02, 1e-3, -5e-4))
AROUND = cubemap.Camera(mapping="coupled", size=32, pixel_centre=0.5)
TRIANGLE = np.array([(-0.6, -0.4, 2.0), (0.7, -0.3, 3.0), (0.1, 0.5, 2.5)])


def meet(camera, triangle):
    """Distances along rays to a triangle, NaN beside it, and the weights of its second and third vertex."""
    rays = np.stack(camera.ray(*camera.pixels()), axis=-1)
    # ray t = first + b (second - first) + c (third - first)
    system = np.stack(np.broadcast_arrays(rays, triangle[0] - triangle[1], triangle[0] - triangle[2]), axis=-1)
    solved = np.linalg.solve(system, np.broadcast_to(triangle[0][:, np.newaxis], (*rays.shape, 1)))
    t, b, c = np.moveaxis(solved[..., 0], -1, 0)
    seen = (t > 0) & (b > 0) & (c > 0) & (b + c < 1)
    return [np.where(seen, one, np.nan) for one in (t, b, c)]


@pytest.mark.parametrize(("camera", "triangle"),
                         [(LENS, TRIANGLE), (AROUND, 5 * np.array([(1.0, -0.9, 0.1), (0.2, 1, 0.4), (0.3, 0.2, -1)]))])
def test_a_triangle(camera, triangle):
    raster = cubemap.Raster(camera)
    raster.triangles(triangle, first_id=7)
    image, ids = raster.read()
    t, b, c = meet(camera, triangle)
    assert image.shape == ids.shape == camera.shape and image.dtype == np.float32 and ids.dtype == np.uint32
    assert np.array_equal(ids == 7, np.isfinite(t)) and np.array_equal(np.isfinite(image), np.isfinite(t))
    assert np.isfinite(t).sum() > 100
    assert (ids[np.isnan(t)] == cubemap.NO_ID).all() and np.nanmax(np.abs(image / t - 1)) < 1e-6
    second, third = raster.weights(triangle, first_id=7)
    assert np.nanmax(np.abs(second - b)) < 1e-5 and np.nanmax(np.abs(third - c)) < 1e-5
    assert np.array_equal(np.isnan(second), np.isnan(t)) and np.isnan(raster.weights(triangle, first_id=8)).all()
    if camera is AROUND:
        assert len(np.unique(np.nonzero(ids == 7)[0] // 32)) > 1  # of several faces


def test_poses_move_the_camera():
    pose = cubemap.Pose.exp((0.3, -0.2, 0.1, 0.1, 0.4, -0.2))
    raster, moved = cubemap.Raster(LENS), cubemap.Raster(LENS, threads=2)
    raster.triangles(pose.apply(TRIANGLE))
    moved.triangles(TRIANGLE, pose=pose)
    ours, theirs = raster.read(), moved.read()
    assert (ours[1] != theirs[1]).sum() == 0 and np.nanmax(np.abs(ours[0] - theirs[0])) < 1e-6
    assert np.nanmax(np.abs(np.subtract(raster.weights(pose.apply(TRIANGLE)),
                                        moved.weights(TRIANGLE, pose=pose)))) < 1e-5
    with pytest.raises(ValueError, match="one pose"):
        raster.triangles(TRIANGLE, pose=pose[np.newaxis])


def test_the_nearest_wins_in_any_order():
    wall = np.array([(-9, -9, 4.0), (9, -9, 4.0), (9, 9, 4.0), (-9, 9, 4.0)])
    index = np.array([(0, 1, 2), (0, 2, 3)])
    found = []
    for order in (0, 1):
        raster = cubemap.Raster(LENS)
        for step in (0, 1):
            if step == order:
                raster.triangles(wall, index, first_id=10)
            else:
                raster.triangles(TRIANGLE)
        found.append(raster.read())
    # no pixel between triangles is left
    assert np.array_equal(found[0], found[1]) and set(np.unique(found[0][1])) == {0, 10, 11}
    again = cubemap.Raster(LENS)
    again.triangles(wall[index.ravel()], first_id=10)
    assert np.array_equal(np.unique(again.read()[1]), (10, 11))
    again.clear()
    assert np.isnan(again.read()[0]).all() and (again.read()[1] == cubemap.NO_ID).all()
    near = cubemap.Raster(LENS, 2.4)
    near.triangles(TRIANGLE)
    assert np.nanmin(near.read()[0]) >= 2.4


def test_discs_and_points():
    raster = cubemap.Raster(LENS)
    raster.points([(0, 0, 2.0), LENS.ray(11.0, 13.0)], first_id=3)
    image, ids = raster.read()
    assert ids[31, 48] == 3 or ids[31, 47] == 3
    assert ids[13, 11] == 4 and image[13, 11] == 1 and (ids != cubemap.NO_ID).sum() == 2
    raster = cubemap.Raster(LENS)
    raster.discs(np.array([(0.1, -0.1, 2.0)]), [(0.0, 0.6, -0.8)], [0.3], first_id=2**32 - 2)
    image, ids = raster.read()
    rays = np.stack(LENS.ray(*LENS.pixels()), axis=-1)
    normal, centre = np.array((0, 0.6, -0.8)), np.array((0.1, -0.1, 2.0))
    depth = normal @ centre / (rays @ normal)
    distance = np.linalg.norm(rays * depth[..., np.newaxis] - centre, axis=-1)
    seen = ids == 2**32 - 2
    assert seen[distance < 0.2999].all() and not seen[distance > 0.3001].any()
    assert np.abs(image - depth)[seen].max() < 1e-5


def test_refused_drawings():
    raster = cubemap.Raster(LENS)
    for wrong in ({"index": [(0, 1, 3)]}, {"index": [(0, 1, -1)]}, {"index": [(0, 1, 2**32)]}, {"first_id": 2**32 - 1},
                  {"first_id": -1}, {"first_id": 2**32}):
        with pytest.raises(cubemap.Error):
            raster.triangles(TRIANGLE, **wrong)
    for wrong in (TRIANGLE[:2], TRIANGLE[:, :2], TRIANGLE[0]):
        with pytest.raises(ValueError):
            raster.triangles(wrong)
    for index in ([(0.0, 1.0, 2.0)], [("a", "b", "c")]):
        with pytest.raises(TypeError):
            raster.triangles(TRIANGLE, index)
    for discs in ((TRIANGLE, TRIANGLE[:2], np.ones(3)), (TRIANGLE, TRIANGLE, np.ones(2)), (TRIANGLE, TRIANGLE, 1.0)):
        with pytest.raises(ValueError):
            raster.discs(*discs)
    with pytest.raises(ValueError):
        raster.points(np.zeros((3, 2)))
    with pytest.raises(cubemap.Error):
        raster.points(np.zeros((1, 3)), first_id=2**32 - 1)
    for nearest in (-1.0, np.nan):
        with pytest.raises(cubemap.Error):
            cubemap.Raster(LENS, nearest)
    raster.triangles(np.full((3, 3), np.nan))
    raster.triangles(np.empty((0, 3)))
    raster.points(np.empty((0, 3)))
    raster.discs(np.empty((0, 3)), np.empty((0, 3)), np.empty(0))
    assert np.isnan(raster.read()[0]).all()


def test_threads_of_python_share_a_canvas(random):
    triangles = random.normal(size=(64, 3, 3)) + (0, 0, 4)
    alone, shared = cubemap.Raster(LENS), cubemap.Raster(LENS)
    alone.triangles(triangles.reshape(-1, 3))
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda k: shared.triangles(triangles[k], first_id=k), range(64)))
    assert np.array_equal(alone.read(), shared.read(), equal_nan=True)
    assert raster_keeps_its_camera().read()[0].shape == (8, 8)


def raster_keeps_its_camera():
    return cubemap.Raster(cubemap.Camera(8, 8, 4, 4, 3.5, 3.5))
