# SPDX-License-Identifier: MIT
"""Random numbers, worlds, budgets and stores."""

import concurrent.futures
import json
import pickle

import cubemap
import numpy as np
import pytest
from cubemap import Primitive
from hypothesis import given
from hypothesis import strategies as st


def fold(values):
    """FNV-1a of 64 bits, as tests/scene/test_random.c has it."""
    found = 0xCBF29CE484222325
    for byte in np.ascontiguousarray(values, "<f8").tobytes():
        found = (found ^ byte) * 0x100000001B3 % 2**64
    return found


def test_random_numbers_are_those_of_c():
    i = np.arange(20000)
    mean = i * 0.37 * np.where(i % 3 == 0, 1e4, 0.01)
    assert fold(cubemap.random_uniform(20, i % 7, i, i % 5)) == 0x0045BD6FA2B5AB31
    assert fold(cubemap.random_normal(20, i % 7, i, i % 5)) == 0xFD42AE5FF27190BB
    assert fold(cubemap.random_poisson(20, i % 7, i, i % 5, mean)) == 0x115ABFCA05157B43


def test_blocks_of_the_generator():
    # the known answers of Random123: counter pixel, sample, view, block; the key is the seed, least half first
    seed, view, pixel, sample, block = np.array([(0,) * 5, (2**64 - 1, *(2**32 - 1,) * 4),
                                                 (0x299F31D0A4093822, 0x13198A2E, 0x243F6A88, 0x85A308D3, 0x03707344)],
                                                np.uint64).T
    words = cubemap.random_block(seed, view, pixel, sample, block)
    assert words.dtype == np.uint32 and [[f"{word:08x}" for word in row] for row in words] == [
        ["6627e8d5", "e169c58d", "bc57ac4c", "9b00dbd8"], ["408f276d", "41c83b0e", "a20bc7c6", "6d5451fd"],
        ["d16cfe09", "94fdcceb", "5001e420", "24126ea1"]]


def test_random_numbers_broadcast():
    view, pixel, sample = np.arange(2)[:, np.newaxis, np.newaxis], np.arange(300)[:, np.newaxis], np.arange(40)
    for function, more in ((cubemap.random_uniform, ()), (cubemap.random_normal, ()), (cubemap.random_poisson, (3.5,))):
        values = function(9, view, pixel, sample, *more)
        assert values.shape == (2, 300, 40) and values[1, 7, 11] == function(9, 1, 7, 11, *more)
        assert type(function(9, 1, 7, 11, *more)) is float
        out = np.empty((2, 300, 40))
        assert function(9, view, pixel, sample, *more, out=out) is out and np.array_equal(out, values)
        assert np.array_equal(function(9, view.astype(np.uint8), pixel.astype(np.uint32), sample, *more), values)
        assert np.isnan(function(9, 0, [-1, 2**32, 2**40], 0, *more)).all() and np.isnan(function(9, -1, 0, 0, *more))
        assert function(-1, 0, 0, 0, *more) == function(2**64 - 1, 0, 0, 0, *more)
        with pytest.raises(TypeError):
            function(9, 0, 0.5, 0, *more)
        with pytest.raises(ValueError):
            function(9, np.zeros(3, int), np.zeros(4, int), 0, *more)
        with pytest.raises(OverflowError):
            function(2**64, 0, 0, 0, *more)
    uniform, normal = cubemap.random_uniform(9, view, pixel, sample), cubemap.random_normal(9, view, pixel, sample)
    assert abs(uniform.mean() - 0.5) < 0.01 and (uniform > 0).all() and (uniform < 1).all()
    assert abs(normal.mean()) < 0.03 and abs(normal.std() - 1) < 0.02
    counts = cubemap.random_poisson(9, 0, np.arange(20000), 0, 100.0)
    assert abs(counts.mean() - 100) < 0.4 and abs(counts.var() / 100 - 1) < 0.06
    assert np.isnan(cubemap.random_poisson(1, 2, 3, 4, [-1.0, np.nan, np.inf])).all()
    assert cubemap.random_poisson(1, 2, 3, 4, 0.0) == 0


RED = cubemap.Material((0.8, 0.2, 0.1), 0.5)
TETRAHEDRON = cubemap.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)],
                           color=np.full((4, 3), 0.5), material=RED)


@given(st.tuples(*[st.floats(-2, 2)] * 3), st.floats(0.1, 0.9))
def test_spheres_in_closed_form(direction, radius):
    scene = cubemap.Scene([Primitive.sphere((3, 0, 0), radius, RED)])
    origin, direction = np.array((0, 0.01, 0.02)), np.array((3, *direction[1:]))
    hit = scene.cast(*origin, *direction)
    # |origin + t direction - centre| = radius
    away = origin - (3, 0, 0)
    a, b, c = direction @ direction, direction @ away, away @ away - radius**2
    inside = b * b - a * c
    if abs(inside) < 1e-9:
        return
    if inside < 0:
        assert hit.distance == np.inf and hit.id == cubemap.NO_ID and np.isnan(hit.normal).all()
        assert hit.reflectance == 0
    else:
        t = (-b - np.sqrt(inside)) / a
        assert hit.distance == pytest.approx(t, rel=1e-9) and hit.id == 0 and tuple(hit.color) == RED.color
        assert hit.reflectance == 0.5
        assert np.abs(hit.normal - (origin + t * direction - (3, 0, 0)) / radius).max() < 1e-7


def test_each_primitive_is_met():
    scene = cubemap.Scene([Primitive.plane((0, 0, -5), (0, 0, 2)), Primitive.box((3, -1, -1), (5, 1, 1), RED),
                           Primitive.cylinder((-3, 0, -1), (-3, 0, 1), 0.5),
                           Primitive.mesh(TETRAHEDRON, cubemap.Pose(position=(-0.2, 4, -0.2)), RED)])
    x, y, z = np.array([(0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0), (np.nan, 0, 0)]).T
    hit = scene.cast(0, 0, 0, x, y, z)
    assert np.allclose(hit.distance, [5, 3, 2.5, 4, np.inf, np.nan, np.nan], rtol=1e-15, atol=0, equal_nan=True)
    assert hit.id.dtype == np.uint32
    assert hit.id[:4].tolist() == [0, 1, 2, 3] and (hit.id[4:] == cubemap.NO_ID).all() and hit.triangle[3] == 1
    assert np.array_equal(hit.normal[:4], [(0, 0, 1), (-1, 0, 0), (1, 0, 0), (0, -1, 0)])
    assert np.allclose(hit.color[3], 0.5 * np.square(RED.color)) and hit.reflectance[3] == 0.25
    # distances are in lengths of the direction; strides, broadcasting, out
    wide = np.zeros((7, 5))
    wide[:, 3] = x
    half = scene.cast(0.0, 0.0, 0.0, 2 * wide[:, 3], 2 * y, 2 * z)
    assert np.array_equal(half.distance, hit.distance / 2, equal_nan=True)
    grid = scene.cast(0, np.zeros((3, 1)), 0, x, y, z)
    assert grid.distance.shape == (3, 7) and grid.normal.shape == (3, 7, 3)
    assert np.array_equal(grid.normal[2], hit.normal, equal_nan=True)
    out = [np.empty_like(one) for one in hit]
    for one, expected in zip(scene.cast(0, 0, 0, x, y, z, out=tuple(out)), hit, strict=True):
        assert np.array_equal(one, expected, equal_nan=True)
    assert cubemap.Scene().cast(0, 0, 0, 1, 0, 0).distance == np.inf
    with pytest.raises(ValueError):
        scene.cast(0, 0, 0, np.zeros(3), np.zeros(4), 0)


@pytest.mark.parametrize("camera",
                         [cubemap.Camera(64, 48, 50, 50, 31.5, 23.5, distortion=(-0.1, 0.01)),
                          cubemap.Camera(mapping="coupled", size=16)])
def test_rooms_are_rendered(camera):
    """A box is seen from inside: the points of all pixels are on it."""
    scene = cubemap.Scene([Primitive.box((-2, -3, -1), (2, 3, 1.5))])
    pose = cubemap.Pose.exp((0.5, 0.2, 0.1, 0.2, 1.3, 0.4))
    hit = scene.render(camera, pose)
    assert hit.distance.shape == camera.shape
    rays = np.stack(camera.ray(*camera.pixels()), axis=-1)
    points = pose.apply_back(rays * hit.distance[..., np.newaxis])
    off = np.abs(np.stack((np.abs(points[..., 0]) - 2, np.abs(points[..., 1]) - 3,
                           np.abs(points[..., 2] - 0.25) - 1.25))).min(axis=0)
    assert off.max() < 1e-14
    # the same triangles as a mesh and through the raster
    corners = np.array([(x, y, z) for x in (-2, 2) for y in (-3, 3) for z in (-1, 1.5)])
    index = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6),
             (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    mesh = cubemap.Scene([Primitive.mesh(cubemap.Mesh(corners, index))], threads=2).render(camera, pose)
    raster = cubemap.Raster(camera)
    raster.triangles(corners, index, pose=pose)
    image, ids = raster.read()
    assert np.abs(mesh.distance / hit.distance - 1).max() < 1e-13 and np.abs(image / hit.distance - 1).max() < 1e-6
    assert (ids == mesh.triangle).mean() > 0.99  # but on the edges


def test_named_worlds():
    assert cubemap.SCENES == ("room", "corridor", "spheres")
    for name in cubemap.SCENES:
        scene = cubemap.Scene.named(name)
        again = pickle.loads(pickle.dumps(scene))
        assert again == scene == cubemap.Scene(scene.primitives) and hash(again) == hash(scene)
        rays = np.random.default_rng(3).normal(size=(3, 500))
        assert np.array_equal(scene.cast(0, 0, 1, *rays).distance, again.cast(0, 0, 1, *rays).distance)
    assert len({cubemap.Scene.named(name) for name in cubemap.SCENES}) == 3
    with pytest.raises(cubemap.Error, match="there are room"):
        cubemap.Scene.named("attic")


def test_meshes_and_worlds_are_values():
    again = pickle.loads(pickle.dumps(TETRAHEDRON))
    assert again == TETRAHEDRON and hash(again) == hash(TETRAHEDRON) and "4 vertices and 4 triangles" in repr(again)
    assert np.array_equal(again.index[3], (1, 2, 3)) and np.array_equal(again.position[3], (0, 0, 1))
    assert np.array_equal(np.array(again.bounds), [(0,) * 3, (1,) * 3])
    assert np.isnan(cubemap.Mesh(np.zeros((3, 3)), np.empty((0, 3), int)).bounds).all()
    scene = cubemap.Scene([Primitive.mesh(TETRAHEDRON), Primitive.sphere((0, 0, 0), 1)])
    assert pickle.loads(pickle.dumps(scene)) == scene and scene.primitives[0].of is TETRAHEDRON
    ball, names = cubemap.Scene(scene.primitives[1:]), {"Primitive": Primitive, "Material": cubemap.Material}
    assert eval(repr(ball), {"cubemap": cubemap, **names}) == ball
    cast = cubemap.Scene([Primitive.mesh(cubemap.Mesh([(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(0, 1, 2)]))]).cast
    assert cast(0.1, 0.1, 0, 0, 0, 1).distance == 1  # world and mesh live as long as it


def test_refused_worlds():
    for wrong in (Primitive.plane((0, 0, 0), (0, 0, 0)), Primitive.box((1, 1, 1), (0, 0, 0)),
                  Primitive.sphere((0, 0, 0), -1), Primitive("mesh"),
                  Primitive.cylinder((0, 0, 0), (0, 0, 0), 1), Primitive.sphere((np.nan, 0, 0), 1),
                  Primitive.sphere((0, 0, 0), 1, cubemap.Material((2, 0, 0), 1))):
        with pytest.raises(cubemap.Error, match=r"primitives\[1\]"):
            cubemap.Scene([Primitive.sphere((0, 0, 0), 1), wrong])
    for wrong in ((np.zeros((3, 3)), [(0, 1, 3)]), (np.full((3, 3), np.nan), [(0, 1, 2)])):
        with pytest.raises(cubemap.Error):
            cubemap.Mesh(*wrong)
    for wrong in ({"normal": np.ones((2, 3))}, {"uv": np.ones((3, 3))}, {"color": np.ones(3)}):
        with pytest.raises(ValueError):
            cubemap.Mesh(np.eye(3), [(0, 1, 2)], **wrong)
    with pytest.raises(ValueError):
        cubemap.Scene([Primitive.mesh(TETRAHEDRON, cubemap.Pose(position=np.zeros((2, 3))))])
    with pytest.raises(ValueError):
        cubemap.Scene([Primitive.sphere((0, 0), 1)])
    ball, other = Primitive.sphere((0, 0, 0), 1), cubemap.Healpix(8)
    for wrong, words in ((Primitive.mesh(other), "mesh: a Mesh, not Healpix"),
                         (ball._replace(motion=other), "motion: a Trajectory, not Healpix"),
                         (ball._replace(brdf=other), "brdf: a Brdf, not Healpix")):
        with pytest.raises(TypeError, match=words):
            cubemap.Scene([wrong])


def test_budgets():
    entries = [cubemap.BudgetEntry("distortion", 0.004, 2.1), cubemap.BudgetEntry("multipath", 0.001, 46.0),
               cubemap.BudgetEntry("noise", 0.0005, 1.0, is_required=True)]
    budget = cubemap.Budget(entries, "depth camera", "m", "ms")
    kept = budget.limit_error(0.002)
    assert [one.is_kept for one in kept.entries] == [True, False, True] and (kept.error, kept.cost) == (0.001, 3.1)
    assert all(one.reason for one in kept.entries)
    assert not any(one.is_kept for one in budget.entries) and budget.limit_cost(100).error == 0
    assert [one.name for one in budget.limit_cost(1.5).entries if one.is_kept] == ["noise"]
    assert budget.sum().error == pytest.approx(0.0055) and budget.sum().cost == 0
    read = json.loads(kept.to_json())
    assert read["subject"] == "depth camera" and read["error"] == kept.error
    assert [one["kept"] for one in read["entries"]] == [True, False, True]
    assert read["entries"][0]["reason"] == kept.entries[0].reason and pickle.loads(pickle.dumps(kept)) == kept
    assert json.loads(cubemap.Budget(()).to_json())["subject"] is None
    assert cubemap.Budget((("a", 1.0, 1.0),)).limit_error(0.0).entries[0].is_kept
    with pytest.raises(cubemap.Error) as caught:
        budget.limit_cost(0.5)
    assert caught.value.status == 15
    for limit in (-1.0, np.nan):
        with pytest.raises(cubemap.Error):
            budget.limit_error(limit)
    with pytest.raises(cubemap.Error) as caught:
        budget._replace(entries=(entries[0]._replace(unit="s"),)).sum()
    assert caught.value.status == 7
    with pytest.raises(TypeError):
        budget._replace(unit=3).sum()
    with pytest.raises(ValueError):
        budget._replace(subject="a\0b").to_json()


def test_stores_are_dictionaries_with_steps():
    store = cubemap.Store(kind=3, version=2)
    with store:
        store[b"b"], store[b"a"], store[b"\0"] = b"two", b"", bytes(range(256)) * 1000
    assert list(store) == [b"\0", b"a", b"b"] and len(store) == 3 and b"a" in store and b"c" not in store
    assert dict(store)[b"b"] == b"two" and store[b"a"] == b"" and len(store[b"\0"]) == 256000
    with pytest.raises(ZeroDivisionError), store:
        del store[b"a"]
        store[b"b"] = b"three"
        assert b"a" not in store and store[b"b"] == b"three"
        1 / 0
    assert store[b"a"] == b"" and store[b"b"] == b"two"
    store.update({b"c": bytearray(b"x")})
    assert store.pop(b"c") == b"x" and store.get(b"c") is None
    store.put_blob(b"other", cubemap.Blob(b"data", 4, 9))
    assert store.get_blob(b"other", 4) == cubemap.Blob(b"data", 4, 9) and store.get_blob(b"none", 4) is None
    assert b"other" in store
    for call, status in ((lambda: store[b"other"], 20), (lambda: store.get_blob(b"other", 4, 8), 21),
                         (lambda: store[b""], 1), (lambda: store[b"x" * 256], 1)):
        with pytest.raises(cubemap.Error) as caught:
            call()
        assert caught.value.status == status
    for wrong in (lambda: store["a"], lambda: store[3], lambda: store.__setitem__(b"a", "text"),
                  lambda: store.put_blob(b"a", cubemap.Blob(5, 0, 0))):
        with pytest.raises(TypeError):
            wrong()
    for wrong in (lambda: store[b"none"], lambda: store.__delitem__(b"none")):
        with pytest.raises(KeyError):
            wrong()
    with pytest.raises(cubemap.Error):
        cubemap.Store(kind=-1)


def test_threads_of_python_share_a_store():
    store = cubemap.Store()
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda k: store.__setitem__(b"%03d" % k, bytes([k])), range(200)))
    store.commit()
    assert [data[0] for data in store.values()] == list(range(200))


@given(st.lists(st.tuples(st.binary(min_size=1, max_size=4), st.one_of(st.none(), st.binary(max_size=9)),
                          st.sampled_from(["", "commit", "rollback"])), max_size=30))
def test_a_store_does_what_a_dictionary_does(steps):
    store, now, committed = cubemap.Store(), {}, {}
    for key, data, then in steps:
        if data is not None:
            store[key] = now[key] = data
        elif key in store:
            del store[key], now[key]
        if then == "commit":
            store.commit()
            committed = dict(now)
        elif then == "rollback":
            store.rollback()
            now = dict(committed)
        assert dict(store) == now and list(store) == sorted(now)
