# SPDX-License-Identifier: MIT
"""Depth images of planes and of noise, with strides of all kinds; what is refused."""

import pickle

import cubemap
import numpy as np
import pytest

WIDTH, HEIGHT = 96, 64
LENS = cubemap.Camera(WIDTH, HEIGHT, 80, 82, 47.5, 31.0, distortion=(-0.1, 0.02, 1e-3, -5e-4))
AROUND = cubemap.Camera(mapping="coupled", size=16, pixel_centre=0.5)


def rays_of(camera):
    return np.stack(camera.ray(*camera.pixels()), axis=-1)


def plane(camera, normal, distance):
    """Depth, or range, of the plane normal x = distance."""
    return (distance / (rays_of(camera) @ normal)).astype(np.float32)


@pytest.fixture
def rough(random):
    """Depths with holes."""
    image = random.uniform(1, 3, (HEIGHT, WIDTH)).astype(np.float32)
    image[random.random(image.shape) < 0.2] = np.nan
    return image


def strided(image):
    wide = np.zeros((2 * image.shape[0], 3 * image.shape[1]), image.dtype)
    wide[::2, 1::3] = image
    return wide[::2, 1::3]


def test_cleaning():
    stored = np.array([[0, 1, 5000, 65535], [2500, 20000, 40000, 7]], np.uint16)
    depth, count = cubemap.clean_depth(stored, 1 / 5000, nearest=0.4, farthest=8.0)
    expected = np.where((stored < 2000) | (stored > 40000), np.nan, stored / 5000).astype(np.float32)
    assert np.array_equal(depth, expected, equal_nan=True) and depth.dtype == np.float32
    assert count == (4, 1, 0, 0, 0, 2, 1) and sum(count) == stored.size
    reals = np.array([[np.nan, np.inf, -1, 2.0, 1e30, 0]], np.float32)
    depth, count = cubemap.clean_depth(reals, 1.0)
    assert np.array_equal(depth, np.array([[np.nan, np.nan, np.nan, 2, 1e30, np.nan]], np.float32), equal_nan=True)
    assert count._asdict() == {"valid": 2, "zero": 1, "nan": 1, "infinite": 1, "negative": 1, "near": 0, "far": 0}
    for order in (strided(stored), stored[::-1][::-1], np.asfortranarray(stored)):
        again = cubemap.clean_depth(order, 1 / 5000, nearest=0.4, farthest=8.0, threads=2)
        assert np.array_equal(again[0], expected, equal_nan=True)
    assert cubemap.clean_depth(reals, 1.0, out=reals)[0] is reals and np.isnan(reals[0, 2])
    for wrong in ({"unit": 0.0}, {"unit": np.nan}, {"unit": 1.0, "nearest": -1}, {"unit": 1.0, "farthest": np.nan}):
        with pytest.raises(cubemap.Error):
            cubemap.clean_depth(stored, **wrong)
    for wrong in (stored.astype(np.float64), stored.astype(np.int32), stored[0], np.zeros((2, 2, 3), np.float32)):
        with pytest.raises((TypeError, ValueError)):
            cubemap.clean_depth(wrong, 1.0)
    with pytest.raises(cubemap.Error):
        cubemap.clean_depth(stored.astype(np.uint8), 1.0)


@pytest.mark.parametrize("instructions", [None, "scalar"])
def test_depth_and_range(rough, instructions):
    rays = cubemap.Rays(LENS, instructions=instructions)
    length = np.linalg.norm(rays_of(LENS), axis=-1)
    found = rays.to_range(rough)
    assert np.nanmax(np.abs(found / (rough * length) - 1)) < 3e-7 and np.array_equal(np.isnan(found), np.isnan(rough))
    assert np.nanmax(np.abs(rays.from_range(found) / rough - 1)) < 3e-7
    assert np.array_equal(rays.to_range(strided(rough)), found, equal_nan=True)
    assert np.array_equal(rays.to_range(rough.astype(np.float64)), found, equal_nan=True)
    out = strided(np.zeros_like(rough))
    assert rays.to_range(rough, out=out) is out and np.array_equal(out, found, equal_nan=True)
    both = np.concatenate((rough, rough[:1]))  # an output a row below its input
    assert np.array_equal(rays.to_range(both[:-1], out=both[1:]), found, equal_nan=True)
    assert rays.to_range(rough, out=rough) is rough and np.array_equal(rough, found, equal_nan=True)
    with pytest.raises(cubemap.Error) as caught:
        cubemap.Rays(AROUND).to_range(np.ones(AROUND.shape, np.float32))
    assert caught.value.status == 7


def test_maps_of_planes():
    normal = np.array((0.2, -0.3, -0.93))
    normal /= np.linalg.norm(normal)
    rays = cubemap.Rays(LENS)
    depth = plane(LENS, normal, -2.0)
    maps = rays.maps(depth, "depth", radii=True)
    assert maps.vertex.shape == maps.normal.shape == (HEIGHT, WIDTH, 3)
    assert np.abs(maps.vertex - rays_of(LENS) * depth[..., np.newaxis]).max() < 1e-6
    assert np.abs(maps.normal - normal).max() < 1e-4
    # depth sqrt(2) / (f |n_z|)
    assert np.abs(maps.radius / (depth * np.sqrt(2) / (81 * -normal[2])) - 1).max() < 1e-4
    ranged = rays.maps(rays.to_range(depth), "range", radii=True)
    assert np.abs(ranged.vertex - maps.vertex).max() < 2e-6 and np.abs(ranged.normal - normal).max() < 1e-4
    alone = rays.maps(depth, "depth", normals=False)
    assert alone.normal is None and alone.radius is None and np.array_equal(alone.vertex, maps.vertex)
    # all around: a sphere about the camera, whose normals point back
    inside = cubemap.Rays(AROUND).maps(np.full(AROUND.shape, 2, np.float32), "range")
    assert np.abs(np.linalg.norm(inside.vertex, axis=-1) - 2).max() < 1e-6
    assert np.abs(inside.normal + inside.vertex / 2).max() < 0.2
    assert np.abs(np.linalg.norm(inside.normal, axis=-1) - 1).max() < 1e-6
    # an edge of more than the gap has normals of one side
    step = np.where(np.arange(WIDTH) < 40, np.float32(1), np.float32(2)) * np.ones((HEIGHT, 1), np.float32)
    assert np.abs(rays.maps(step, "depth").normal - (0, 0, -1)).max() < 1e-4
    assert np.abs(rays.maps(step, "depth", gap=2.0).normal - (0, 0, -1)).max() > 0.5


def test_refused_maps(rough):
    rays = cubemap.Rays(LENS)
    for wrong in ((rough, "deep"), (rough[:-1], "depth"), (rough[..., np.newaxis], "depth")):
        with pytest.raises(ValueError):
            rays.maps(*wrong)
    with pytest.raises(ValueError, match="omnidirectional"):
        cubemap.Rays(AROUND).maps(np.ones(AROUND.shape, np.float32), "depth")
    with pytest.raises(TypeError, match="clean_depth"):
        rays.maps(np.ones((HEIGHT, WIDTH), np.uint16), "depth")
    with pytest.raises(TypeError):
        rays.maps(rough)  # what the image holds is to be said
    for wrong in ({"gap": -1.0}, {"gap": np.nan}, {"normals": False, "radii": True}):
        with pytest.raises(cubemap.Error):
            rays.maps(rough, "depth", **wrong)
    with pytest.raises(cubemap.Error):
        cubemap.Rays(LENS, instructions="mmx")


def bilateral(image, pixels, metres):
    """As depth.h has it, pixel by pixel."""
    wide = np.pad(image.astype(float), 3, constant_values=np.nan)
    windows = np.lib.stride_tricks.sliding_window_view(wide, (7, 7))
    row, column = np.mgrid[-3:4, -3:4]
    difference = windows - image[..., np.newaxis, np.newaxis]
    weight = np.exp(-(row**2 + column**2) / (2 * pixels**2) - difference**2 / (2 * metres**2))
    weight = np.where(np.isnan(windows), 0, weight)
    smooth = (weight * np.nan_to_num(windows)).sum((2, 3)) / weight.sum((2, 3))
    return np.where(np.isnan(image), np.nan, smooth)


def test_smoothing(rough):
    rays = cubemap.Rays(LENS)
    found = rays.smooth(rough, 2.0, 0.3)
    assert np.nanmax(np.abs(found - bilateral(rough, 2.0, 0.3))) < 1e-3
    assert np.array_equal(np.isnan(found), np.isnan(rough))
    before = rough.copy()
    # through a copy
    assert rays.smooth(rough, 2.0, 0.3, out=rough) is rough and np.array_equal(rough, found, equal_nan=True)
    assert np.array_equal(cubemap.Rays(LENS, threads=2).smooth(strided(before), 2.0, 0.3), found, equal_nan=True)
    for wrong in ((0.0, 1.0), (1.0, np.nan), (1e7, 1.0)):
        with pytest.raises(cubemap.Error):
            rays.smooth(rough, *wrong)
    fixed = np.empty_like(rough)
    fixed.flags.writeable = False
    for out in (np.empty((HEIGHT, WIDTH)), np.empty((HEIGHT, WIDTH + 1), np.float32), fixed):
        with pytest.raises(ValueError):
            rays.smooth(rough, 2.0, 0.3, out=out)


def test_halves(rough):
    rays = cubemap.Rays(LENS)
    quads = rough.reshape(HEIGHT // 2, 2, WIDTH // 2, 2)
    with np.errstate(all="ignore"):
        nearest = np.fmin.reduce(quads, axis=(1, 3))
        near = np.where(quads <= nearest[:, np.newaxis, :, np.newaxis] * 1.1, quads, np.nan)
        expected = np.nansum(near, axis=(1, 3)) / np.isfinite(near).sum(axis=(1, 3))
    half = rays.halve(rough, 0.1)
    assert half.shape == LENS.halved().shape and np.array_equal(np.isnan(half), np.isnan(expected))
    assert np.nanmax(np.abs(half - expected)) < 1e-6
    # end to end: the half of a plane's image is the plane's image of the halved camera
    normal = np.array((0.1, 0.05, 1.0))
    assert np.abs(rays.halve(plane(LENS, normal, 2.0), 1.0) - plane(LENS.halved(), normal, 2.0)).max() < 1e-3
    with pytest.raises(cubemap.Error):
        rays.halve(rough, -0.1)


def test_pyramids(rough):
    pyramid = cubemap.DepthPyramid(rough)
    assert pyramid.shape == rough.shape
    levels = pyramid.levels
    assert [least.shape for least, _ in levels] == [(32, 48), (16, 24), (8, 12), (4, 6)]
    quads = rough.reshape(8, 8, 12, 8)
    least, most = levels[2]
    assert np.array_equal(np.abs(least), np.nanmin(quads, axis=(1, 3)))
    assert np.array_equal(most, np.nanmax(quads, axis=(1, 3)))
    assert np.array_equal(least < 0, np.isnan(quads).any(axis=(1, 3)))
    found = pyramid.bounds(10, 20, 10, 20)
    column, row = np.arange(0, 90, 3), np.arange(0, 60)[:, np.newaxis]
    found = pyramid.bounds(column, row, column + 5, row + 3)
    assert found.least.shape == (60, 30) and found.least.dtype == np.float32
    for k in ((0, 0), (31, 11), (59, 29)):
        box = rough[row[k[0], 0]:row[k[0], 0] + 4, column[k[1]]:column[k[1]] + 6]
        assert found.least[k] <= np.nanmin(box) and found.most[k] >= np.nanmax(box)
        assert found.has_unmeasured[k] >= np.isnan(box).any()
    whole = pyramid.bounds(0, 0, WIDTH - 1, HEIGHT - 1)
    assert (whole.least, whole.most, whole.has_unmeasured) == (np.nanmin(rough), np.nanmax(rough), 1)
    assert type(whole.least) is float
    for box in ((5, 5, 4, 5), (0, 0, WIDTH, 0), (-1, 0, 3, 3), (0, 0, 2**40, 0)):
        assert np.isnan(pyramid.bounds(*box)[:2]).all() and pyramid.bounds(*box).has_unmeasured == -1
    pyramid.fill(strided(np.full_like(rough, 7)))
    assert pyramid.bounds(1, 1, 2, 2) == (7, 7, 0)
    with pytest.raises(ValueError):
        pyramid.fill(rough[:-1])
    for wrong in (np.empty((0, 4), np.float32), np.zeros(4, np.float32)):
        with pytest.raises(ValueError):
            cubemap.DepthPyramid(wrong)


def test_rays_are_values():
    rays = cubemap.Rays(LENS, threads=2)
    assert pickle.loads(pickle.dumps(rays)) == rays == cubemap.Rays(LENS) != cubemap.Rays(AROUND)
    assert eval(repr(rays)) == rays
    assert rays.camera == LENS
