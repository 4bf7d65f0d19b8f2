# SPDX-License-Identifier: MIT
"""Objects of other classes, and values of other kinds, where one is wanted: TypeError, which names the argument."""

import cubemap
import numpy as np
import pytest
from cubemap import sim

CAMERA = cubemap.Camera(8, 6, 8, 8, 3.5, 2.5)
STAMPS = np.arange(4.0)
PATH = cubemap.Trajectory(STAMPS, cubemap.Pose(position=np.multiply.outer(STAMPS, (1.0, 0.0, 0.0))))
SURFACE = cubemap.Surface("equirect", 8, 4)
SCENE = cubemap.Scene.named("room")
OCTREE = cubemap.Octree(0.05, 8)
PICTURE = np.ones((4, 8))
OTHERS = [cubemap.Mapping("coupled"), cubemap.Grid(), cubemap.Healpix(4), SURFACE, PATH, OCTREE, cubemap.Pose(), cubemap.Frame.named("gl"),
          cubemap.Budget([cubemap.BudgetEntry("noise", 1.0, 2.0)]), cubemap.Primitive.sphere((0, 0, 0), 1), SCENE, CAMERA, None, "coupled", 5]

# (argument, its class, what takes it): each would give the library another object's address, or fail in words of its own
TAKERS = [
    ("camera", cubemap.Camera, cubemap.Rays),
    ("camera", cubemap.Camera, cubemap.Raster),
    ("camera", cubemap.Camera, SCENE.render),
    ("pose", cubemap.Pose, lambda one: SCENE.render(CAMERA, one)),
    ("trajectory", cubemap.Trajectory, cubemap.Motion),
    ("estimate", cubemap.Trajectory, PATH.evaluate),
    ("other", cubemap.Trajectory, PATH.associate),
    ("poses", cubemap.Pose, lambda one: cubemap.Trajectory(STAMPS, one)),
    ("region", cubemap.Region, lambda one: cubemap.CellGrid().cover(one, 0, 5)),
    ("surface", cubemap.Surface, cubemap.Panorama.of_surface),
    ("surface", cubemap.Surface, lambda one: cubemap.mips(one, PICTURE)),
    ("surface", cubemap.Surface, lambda one: cubemap.border(one, PICTURE, 1)),
    ("store", cubemap.Store, OCTREE.save),
    ("store", cubemap.Store, cubemap.Octree.load),
    ("to", cubemap.Pose, cubemap.Pose().between),
    ("to", cubemap.Pose, lambda one: cubemap.Pose().interpolate(one, 0.5)),
    ("primitives", cubemap.Primitive, lambda one: cubemap.Scene([one])),
    ("blob", cubemap.Blob, lambda one: cubemap.Store().put_blob(b"a", one)),
    ("base", cubemap.Pose, lambda one: sim.texel_matrix(one, cubemap.Pose())),
    ("scan", cubemap.Pose, lambda one: sim.texel_matrix(cubemap.Pose(), one)),
    ("options", sim.TexelOptions, sim.texel_complete),
    ("camera", cubemap.Camera, lambda one: sim.TofScene(SCENE).find_truth(one)),
]


@pytest.mark.parametrize("name, kind, take", TAKERS, ids=lambda one: one if isinstance(one, str) else None)
def test_objects_of_other_classes_are_refused(name, kind, take):
    for other in OTHERS:
        if not isinstance(other, kind):
            with pytest.raises(TypeError, match=f"^{name}: a {kind.__name__}, not {type(other).__name__}$"):
                take(other)


def test_other_numbers_are_refused_by_name():
    for name, take in [("lon", lambda: cubemap.Rotation.from_angles("0.1", 0.2)), ("limit", lambda: cubemap.Budget([]).limit_error("0.1")),
                       ("level", lambda: OCTREE.extract("3"))]:
        with pytest.raises(TypeError, match=f"^{name}: cannot be a (str|list)$"):
            take()
    with pytest.raises(TypeError, match="text: a text or bytes, not a number"):
        cubemap.Panorama.read(2**20)  # not so many zero bytes
    with pytest.raises(ValueError, match=r"pictures: of rows and columns, not \(3,\)"):
        cubemap.resample(np.zeros(3), "equirect", "cube:coupled;size=4")


def test_masked_numbers_are_refused_or_not_measured():
    """What is under a mask is no data: no function takes it for some."""
    three = np.ma.masked_equal(np.arange(9.0).reshape(3, 3), 4)
    picture = np.ma.masked_less(np.arange(48, dtype=np.float32).reshape(6, 8), 5)
    sensor = sim.Sensor(CAMERA, 12e-6, 1.0, 850e-9, 0.4, 1e-3, 20e6, 0.5, 0.8)
    for take in [lambda: cubemap.Raster(CAMERA).points(three), lambda: cubemap.Mesh(three, [(0, 1, 2)]),
                 lambda: cubemap.Mesh(np.eye(3), np.ma.masked_equal([(0, 1, 2)], 1)), lambda: cubemap.Pose(position=three[1]),
                 lambda: cubemap.Pose(three), lambda: cubemap.align(three, three.data), lambda: cubemap.Region.polygon(three[:, :2]),
                 lambda: cubemap.Trajectory(three[1], cubemap.Pose(position=np.eye(3))), lambda: OCTREE.update_points((0, 0, 0), three),
                 lambda: sim.channel_census(picture), lambda: sim.flow_warp(picture, np.zeros((6, 8, 2))),
                 lambda: sim.depth_error_plane(three), lambda: sim.LensMap(CAMERA).color(np.ma.masked_all((6, 8, 3), np.float32)),
                 lambda: sensor.reconstruct(np.ma.masked_all((4, 6, 8), np.float32), np.zeros((4, 6, 8)))]:
        with pytest.raises(TypeError, match="an array without masked numbers"):
            take()
    for one, other in [(picture, picture.data), (picture.data, picture), (picture.astype(int), picture.data)]:
        assert sim.depth_error(one, other).count == 43
        assert np.isnan(sim.depth_error_local(one, other)).sum() == 5
    assert np.isnan(sim.depth_error_temporal(np.ma.stack([picture, picture]))[0]).sum() == 5


def test_outputs_that_are_no_arrays_are_refused_by_name():
    for take in [lambda: cubemap.resample(np.ones((4, 8), np.float32), "equirect", "cube:coupled;size=4", out=[1.0]),
                 lambda: cubemap.Rays(CAMERA).smooth(np.ones((6, 8), np.float32), 1.0, 0.1, out=[1.0])]:
        with pytest.raises(TypeError, match="^out: a ndarray, not list$"):
            take()


def test_texts_are_texts():
    frame = cubemap.Frame.named("gl")
    for wrong, kind in [(5, TypeError), (b"sse2", TypeError), ("sse2\0", ValueError)]:
        for name, take in [("instructions", lambda one: cubemap.Mapping(instructions=one)),
                           ("instructions", lambda one: cubemap.Surface("equirect;size=8", instructions=one)),
                           ("instructions", lambda one: cubemap.Plan("equirect;size=8", "cube;size=4", instructions=one)),
                           ("specification", lambda one: cubemap.advise([(one,)])),
                           ("identifier", lambda one: cubemap.Mapping("coupled", cubemap.Frame(one, frame.faces))),
                           ("name", lambda one: cubemap.Mapping("coupled", cubemap.Frame("mine", frame.faces, name=one)))]:
            with pytest.raises(kind, match=f"^{name}: a (text, not|zero byte in)"):
                take(wrong)


def test_errors_of_single_pixels_and_points():
    mean, deviation = sim.depth_error_temporal([1.0, 2.0, 3.0])
    assert mean.shape == deviation.shape == () and mean == 2.0 and deviation == pytest.approx(np.std([1, 2, 3]), abs=0.2)
    many = sim.depth_error_temporal(np.array([[1.0], [2.0], [3.0]]))
    assert mean == many[0][0] and deviation == many[1][0]
    with pytest.raises(cubemap.Error):
        sim.depth_error_plane([1.0, 2.0, 3.0])  # one point has no plane
    with pytest.raises(cubemap.Error):
        sim.depth_error_plane([[1.0, 2.0, 3.0]])
