# SPDX-License-Identifier: MIT
"""Cameras: points to pixels and back, in every shape; what is refused."""

import ctypes
import json
import pickle

import cubemap
import numpy as np
import pytest
from cubemap import _library as library
from hypothesis import given
from hypothesis import strategies as st

TUM = (640, 480, 525.0, 525.0, 319.5, 239.5)
LENS = (-0.28, 0.07, 1e-3, -5e-4, 0.01, 0.02, -0.01, 1e-3, 1e-4, -1e-4, 2e-4, 1e-4, 0.01, -0.02)


def by_c(function, handle, inputs, outputs):
    """What the function of C makes of dense arrays."""
    inputs = [np.ascontiguousarray(one, np.float64) for one in inputs]
    made = [np.empty(inputs[0].size) for _ in range(outputs)]
    function(handle, inputs[0].size, *(one.ctypes.data for one in inputs + made))
    return made


@pytest.mark.parametrize("centre", [0.0, 0.5])
@pytest.mark.parametrize("distortion", [(), LENS[:5], LENS])
def test_pixels_come_back(distortion, centre):
    c = cubemap.Camera(*TUM, pixel_centre=centre, distortion=distortion)
    column, row = c.pixels()
    x, y, z = c.ray(column, row)
    assert x.shape == c.shape == (480, 640) and (z == 1).all()
    back = c.project(x, y, z)
    assert np.abs(back[0] - column).max() < 1e-9 and np.abs(back[1] - row).max() < 1e-9


def test_no_distortion_is_the_pinhole(random):
    c = cubemap.Camera(*TUM)
    x, y, z = random.uniform(-1, 1, 100), random.uniform(-1, 1, 100), random.uniform(1, 2, 100)
    column, row = c.project(x, y, z)
    assert np.abs(column - (525 * x / z + 319.5)).max() < 1e-11 and np.abs(row - (525 * y / z + 239.5)).max() < 1e-11
    assert np.isnan(c.project(0.0, 0.0, -1.0)).all()
    assert c.solid_angle(319.5, 239.5) == pytest.approx(1 / 525**2, rel=1e-12)
    # the whole picture, as the solid angle of a rectangle: four times atan(a b / sqrt(1 + a^2 + b^2))
    a, b = 320 / 525, 240 / 525
    assert c.solid_angle(*c.pixels()).sum() == pytest.approx(4 * np.arctan(a * b / np.sqrt(1 + a * a + b * b)),
                                                             rel=1e-5)
    assert c.border([0.0, 1.0]).tolist() == [np.inf, np.inf]


@pytest.mark.parametrize(("specification", "whole"),
                         [("coupled", 4 * np.pi), ("tangent:c=1.1823", 4 * np.pi), ("healpix", 4 * np.pi),
                                                      ("octahedral", 4 * np.pi), ("azimuthal:lambert", 2 * np.pi)])
def test_mappings_see_all_around(specification, whole):
    c = cubemap.Camera(mapping=specification, size=24, pixel_centre=0.5)
    six = c.mapping.face_count
    assert c.shape == (24 * six, 24) and c.kind == "range" and not c.distortion[0] and np.isnan(c.border(0.0))
    column, row = c.pixels()
    x, y, z = c.ray(column, row)
    seen = np.broadcast_to(c.has_ray(column, row) != 0, c.shape)
    assert np.array_equal(np.isfinite(x), seen) and np.abs(x * x + y * y + z * z - 1)[seen].max() < 1e-14
    back = c.project(x, y, z)
    assert np.abs(back[0] - column)[seen].max() < 1e-9 and np.abs(back[1] - row)[seen].max() < 1e-9
    face, u, v = c.mapping.forward(x[seen], y[seen], z[seen])
    assert np.array_equal(face, (np.broadcast_to(row, c.shape)[seen] // 24) if six == 6 else np.zeros(face.shape))
    assert np.nansum(c.solid_angle(column, row)) == pytest.approx(whole, rel=0.02)


def test_what_folds_is_not_seen():
    c = cubemap.Camera(*TUM, distortion=(-0.5,))
    # r (1 - r^2 / 2) turns at r = sqrt(2 / 3)
    assert np.abs(c.border(np.linspace(-3, 3, 7)) - np.sqrt(2 / 3)).max() < 1e-9
    column, row = c.project([0.8, 0.83], 0.0, 1.0)
    assert np.isfinite(column[0]) and np.isnan([column[1], row[1]]).all()
    assert c.has_ray([319.5, 5000.0], 239.5).tolist() == [1, 0]
    assert np.isnan(c.solid_angle(5000.0, 0.0)) and np.isnan(c.ray(5000.0, 0.0)).all()
    assert np.isnan(c.jacobian((0.9, 0.0, 1.0))).all()


def test_jacobians_are_differences(random):
    c = cubemap.Camera(*TUM, distortion=LENS)
    point = random.uniform((-0.4, -0.4, 1.5), (0.4, 0.4, 2), (4, 5, 3))
    jacobian = c.jacobian(point)
    assert jacobian.shape == (4, 5, 2, 3)
    for axis in range(3):
        step = 1e-5 * np.eye(3)[axis]
        ahead, behind = (np.stack(c.project(*np.moveaxis(point + sign * step, -1, 0)), axis=-1) for sign in (1, -1))
        assert np.abs((ahead - behind) / 2e-5 - jacobian[..., axis]).max() < 1e-5


@pytest.mark.parametrize("camera", [cubemap.Camera(*TUM, distortion=LENS), cubemap.Camera(mapping="coupled", size=64)])
def test_arrays_are_those_of_c(camera, random):
    x, y, z = random.normal(size=(3, 1000)) + [[0], [0], [2]]
    expected = by_c(library.cm_camera_project_array, camera._handle, (x, y, z), 2)
    assert np.array_equal(camera.project(x, y, z), expected, equal_nan=True)
    column, row = random.uniform(0, 60, (2, 1000))
    rays = by_c(library.cm_camera_ray_array, camera._handle, (column, row), 3)
    assert np.array_equal(camera.ray(column, row), rays, equal_nan=True)
    # strides, broadcasting, out, single numbers, float32
    wide = np.zeros((1000, 2, 3))
    wide[:, 1] = np.stack((x, y, z), axis=-1)
    assert np.array_equal(camera.project(*wide[:, 1].T), expected, equal_nan=True)
    assert np.array_equal(camera.project(x[::-1], y[::-1], z[::-1]), np.array(expected)[:, ::-1], equal_nan=True)
    grid = camera.project(x[:, np.newaxis], 0.25, z[:7])
    assert grid[0].shape == (1000, 7)
    assert np.array_equal(grid[0][3, 4], camera.project(x[3], 0.25, z[4])[0], equal_nan=True)
    out = np.empty((2, 1000))
    assert camera.project(x, y, z, out=tuple(out))[0].base is out and np.array_equal(out, expected, equal_nan=True)
    assert np.array_equal(camera.ray(column, row, out=(column, row, np.empty(1000)))[:2], rays[:2], equal_nan=True)
    numbers = camera.project(0.1, 0.2, 1.5)
    assert all(type(one) is float for one in numbers)
    assert np.array_equal(numbers, [one[()] for one in camera.project(np.array(0.1), 0.2, 1.5)])
    assert camera.project(np.float32(x), y, z)[0].dtype == np.float64
    for name, count in (("project", 3), ("ray", 2), ("solid_angle", 2), ("has_ray", 2)):
        with pytest.raises(ValueError):
            getattr(camera, name)(*([np.zeros(3), np.zeros(4), np.zeros(3)][:count]))
        with pytest.raises(TypeError):
            getattr(camera, name)(0.0)
        assert np.shape(getattr(camera, name)(*([np.empty(0)] * count)))[-1] == 0
    with pytest.raises(ValueError):
        camera.jacobian(np.zeros(4))
    with pytest.raises(TypeError):
        camera.ray(1j, 0.0)


def test_threads_change_no_bit(random):
    column, row = random.uniform(0, 480, (2, 200_000))
    one, many = cubemap.Camera(*TUM, distortion=LENS), cubemap.Camera(*TUM, distortion=LENS, threads=3)
    assert one == many and np.array_equal(one.ray(column, row), many.ray(column, row))


def test_cameras_are_values():
    cameras = [cubemap.Camera(*TUM), cubemap.Camera(*TUM, 0.5), cubemap.Camera(*TUM, distortion=LENS[:4]),
               cubemap.Camera(mapping="coupled", size=8),
               cubemap.Camera(mapping=cubemap.Mapping("coupled", "gl"), size=8),
               cubemap.Camera(8, 48, mapping="tangent")]
    for place, c in enumerate(cameras):
        again = pickle.loads(pickle.dumps(c))
        assert again == c and hash(again) == hash(c) and eval(repr(c)) == c
        assert [other == c for other in cameras] == [k == place for k in range(len(cameras))]
    assert repr(cameras[0]) == "cubemap.Camera(640, height=480, fx=525.0, fy=525.0, cx=319.5, cy=239.5)"
    c = cameras[2]
    assert (c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.pixel_centre, c.mapping) == (*TUM, 0, None)
    assert c.distortion == (*LENS[:4], *[0] * 10)
    # the names are those of CAMERA.json
    read = json.loads('{"width":640,"height":480,"fx":525,"fy":525,"cx":319.5,"cy":239.5,"pixel_centre":0,'
                      '"distortion":[0.1],"depth_scale":5000}')
    assert read.pop("depth_scale") == 5000 and cubemap.Camera(**read).distortion[0] == 0.1
    assert cubemap.Camera(**json.loads('{"mapping":"coupled","frame":"gl","size":8}')) == cameras[4]


def test_a_halved_camera_sees_the_same():
    for c in (cubemap.Camera(*TUM, distortion=LENS), cubemap.Camera(mapping="coupled", size=32)):
        half = c.halved()
        assert half.shape == (c.height // 2, c.width // 2)
        # between the centres of four pixels
        column, row = (one + half.pixel_centre for one in (3, 5))
        between = 2 * 3 + 0.5 + c.pixel_centre, 2 * 5 + 0.5 + c.pixel_centre
        assert np.abs(np.array(half.ray(column, row)) - c.ray(*between)).max() < 1e-12
    with pytest.raises(cubemap.Error):
        cubemap.Camera(mapping="coupled", size=9).halved()


def test_a_camera_outlives_what_it_was_made_of():
    mine = cubemap.Frame("mine", cubemap.Frame.named("geo").faces)
    project = cubemap.Camera(mapping=cubemap.Mapping("coupled", mine), size=8).project
    assert np.isfinite(project(1.0, 0.2, 0.1)).all()


@pytest.mark.parametrize("arguments", [
    {}, {"width": 640, "height": 480}, {"width": 640, "height": 480, "fx": 0.0, "fy": 1.0},
    {"width": 2**31, "height": 2, "fx": 1.0, "fy": 1.0},
    {"width": 2**32 + 640, "height": 480, "fx": 1.0, "fy": 1.0}, {"width": -640, "height": 480, "fx": 1.0, "fy": 1.0},
    {"width": 640, "height": 480, "fx": np.nan, "fy": 1.0},
    {"width": 640, "height": 480, "fx": 1.0, "fy": 1.0, "distortion": [np.inf]},
    {"width": 640, "height": 480, "fx": 1.0, "fy": 1.0, "distortion": [0] * 12 + [2, 0]},
    {"width": 640, "height": 480, "mapping": "coupled"},
    {"width": 8, "height": 48, "mapping": "copled"}])
def test_refused_cameras(arguments):
    with pytest.raises(cubemap.Error):
        cubemap.Camera(**arguments)


def test_refused_words():
    for more in ({"distortion": [0] * 15}, {"distortion": 0.1}, {"frame": "gl"}, {"size": 8}, {"mapping": "coupled"},
                 {"threads": -1}):
        with pytest.raises(ValueError):
            cubemap.Camera(*TUM, **more)
    with pytest.raises(ValueError):
        cubemap.Camera(mapping=cubemap.Mapping(), frame="gl", size=8)
    for wrong in ({"width": 640.0}, {"mapping": 3}):
        with pytest.raises(TypeError):
            cubemap.Camera(**{**dict(width=640, height=480, fx=525.0, fy=525.0),
                              **({} if "width" in wrong else {"fx": 0.0, "fy": 0.0}), **wrong})


@given(st.floats(-0.3, 0.3), st.floats(-0.1, 0.1), st.floats(0, 639), st.floats(0, 479), st.sampled_from([0.0, 0.5]))
def test_any_pixel_comes_back(k1, p1, column, row, centre):
    c = cubemap.Camera(*TUM, centre, (k1, 0.0, p1))
    ray = c.ray(column, row)
    assert bool(c.has_ray(column, row)) == bool(np.isfinite(ray).all())
    if np.isfinite(ray).all():
        back = c.project(*ray)
        assert abs(back[0] - column) < 1e-9 and abs(back[1] - row) < 1e-9


@given(st.tuples(*[st.floats(width=64)] * 3))
def test_any_numbers(numbers):
    for c in (cubemap.Camera(*TUM, distortion=LENS), cubemap.Camera(mapping="coupled", size=8)):
        column, row = c.project(*numbers)
        assert np.isnan(column) == np.isnan(row) and (np.isnan(column) or not np.isnan(numbers).any())
        x, y, z = c.ray(*numbers[:2])
        assert np.isnan(x) == np.isnan(y) == np.isnan(z) == (not c.has_ray(*numbers[:2]))
    assert ctypes.sizeof(library.cm_camera_options) == cubemap._core.sizes["cm_camera_options"]
