# SPDX-License-Identifier: MIT
"""Mappings as ufuncs: vectors of high precision, strides, types, single numbers, bad input, life."""

import copy
import gc
import pickle
import threading
import weakref

import cubemap
import numpy as np
import pytest
from cubemap import _core
from hypothesis import given
from hypothesis import strategies as st

EPS = 2.0**-53
CUBES = [info.identifier for info in cubemap.catalogue() if info.kind == "cube"]


def vector_files(root):
    return sorted(root.glob("tests/vectors/*.txt"))


def read_vectors(path):
    head, rows = {}, {"F": [], "I": [], "D": [], "R": []}
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["#"] and words[1] in ("specification", "frame"):
            head[words[1]] = words[2]
        elif words and words[0] in rows and words[-1] != "tie":
            rows[words[0]].append([float(word) for word in words[1:]])
    return head, {kind: np.array(lines).T for kind, lines in rows.items() if lines}


def test_vectors(root):
    worst, files = 0.0, vector_files(root)
    for path in files:
        head, rows = read_vectors(path)
        m = cubemap.Mapping(head["specification"], head["frame"])
        if "D" in rows:
            x, y, z, face, u, v = rows["D"]
            got = m.forward(x, y, z)
            assert np.array_equal(got[0], face), path.name
            worst = max(worst, np.abs(got[1] - u).max(), np.abs(got[2] - v).max())
        if "R" in rows:
            face, u, v, *expected = rows["R"]
            worst = max(worst, *(np.abs(one - other).max() for one, other in
                                 zip(m.inverse(face.astype(np.uint8), u, v), expected, strict=True)))
        if "F" in rows and m.info.family != "hybrid":
            p, q, u, v = rows["F"]
            got = m.warp(p, q)
            worst = max(worst, np.abs(got[0] - u).max(), np.abs(got[1] - v).max())
    assert len(files) > 40
    assert 0 < worst <= 8 * 2 * EPS  # design: each coordinate within 8 eps


@pytest.mark.parametrize("specification", CUBES)
def test_round_trip(specification, points):
    m = cubemap.Mapping(specification)
    x, y, z = points
    face, u, v = m.forward(x, y, z)
    back = np.stack(m.inverse(face, u, v))
    length = np.sqrt((points / np.abs(points).max(axis=0)) ** 2).sum(axis=0) * 0 + np.linalg.norm(
        points / np.abs(points).max(axis=0), axis=0)
    assert np.abs(back - points / np.abs(points).max(axis=0) / length).max() < 5e-15
    assert face.dtype == np.uint8 and u.dtype == np.float64


def test_strides_and_shapes_give_the_same_bits(points):
    m = cubemap.Mapping()
    x, y, z = points
    face, u, v = m.forward(x, y, z)
    packed = np.ascontiguousarray(points.T)  # x, y, z side by side
    for got, expected in zip(m.forward(packed[:, 0], packed[:, 1], packed[:, 2]), (face, u, v), strict=True):
        assert np.array_equal(got, expected)
    for got, expected in zip(m.forward(x[::-3], y[::-3], z[::-3]), (face, u, v), strict=True):
        assert np.array_equal(got, expected[::-3])
    grid = [one.reshape(100, 1000).T for one in points]
    for got, expected in zip(m.forward(*grid), (face, u, v), strict=True):
        assert np.array_equal(got, expected.reshape(100, 1000).T)
    # broadcast, and with strides of nothing
    got = m.forward(x[:50, np.newaxis], y[np.newaxis, :60], 1.0)
    expected = m.forward(np.repeat(x[:50], 60), np.tile(y[:60], 50), np.ones(3000))
    for one, other in zip(got, expected, strict=True):
        assert one.shape == (50, 60) and np.array_equal(one.ravel(), other)
    jacobian = m.forward_jacobian(x[:999], y[:999], z[:999])
    out = np.zeros((999, 3, 2)).transpose(0, 2, 1)
    assert np.array_equal(m.forward_jacobian(x[:999], y[:999], z[:999], out=out), jacobian)


def test_out_and_where(points):
    m = cubemap.Mapping()
    x, y, z = points
    expected = m.forward(x, y, z)
    out = np.empty(len(x), np.uint8), np.empty(len(x)), np.empty(len(x))
    got = m.forward(x, y, z, out=out)
    assert all(one is other for one, other in zip(got, out, strict=True))
    assert all(np.array_equal(one, other) for one, other in zip(got, expected, strict=True))
    # in place
    u, v = x.copy(), y.copy()
    m.forward(u, v, z, out=(None, u, v))
    assert np.array_equal(u, expected[1]) and np.array_equal(v, expected[2])
    # outputs that overlap inputs, shifted
    row = np.concatenate((x, [0.0]))
    m.forward(row[:-1], y, z, out=(None, row[1:], None))
    assert np.array_equal(row[1:], expected[1])
    where = np.arange(len(x)) % 7 == 0
    marks = np.full(len(x), -5.0)
    m.forward(x, y, z, out=(None, marks, None), where=where)
    assert np.array_equal(marks, np.where(where, expected[1], -5.0))


def test_single_numbers_are_numbers_and_have_the_bits_of_arrays(points):
    for specification in ("coupled", "tangent", "qsc", "healpix", "s2"):
        m = cubemap.Mapping(specification)
        x, y, z = points[:, :300]
        face, u, v = m.forward(x, y, z)
        for k in range(300):
            got = m.forward(float(x[k]), float(y[k]), float(z[k]))
            assert got == (face[k], u[k], v[k]) and [type(one) for one in got] == [int, float, float]
            assert m.forward_lonlat(float(u[k]), float(v[k])) == tuple(one[0] for one in m.forward_lonlat(u[k:k + 1], v[k:k + 1]))
            assert m.inverse(*got) == tuple(one[0] for one in m.inverse(face[k:k + 1], u[k:k + 1], v[k:k + 1]))
    assert cubemap.Mapping().forward(1, 0, 0) == (0, 0.0, 0.0)
    with pytest.raises(TypeError):
        cubemap.Mapping().forward("1", 0, 0)
    with pytest.raises(TypeError):
        cubemap.Mapping().forward(1, 0)
    with pytest.raises(OverflowError):
        cubemap.Mapping().forward(10**400, 0, 0)


def test_single_numbers_of_derivatives_have_the_bits_of_arrays(points):
    """What a point has several of is an array of its own, by the short way, too: of the core's shape and writable."""
    for specification in ("coupled", "conformal", "healpix"):
        m = cubemap.Mapping(specification)
        x, y, z = points[:, :50]
        face, u, v = m.forward(x, y, z)
        for name, arrays in (("forward", (x, y, z)), ("inverse", (face, u, v))):
            many, tissot = getattr(m, name + "_jacobian")(*arrays), getattr(m, name + "_distortion")(*arrays)
            for k in range(50):
                numbers = [one[k].item() for one in arrays]
                alone = getattr(m, name + "_jacobian")(*numbers)
                assert alone.shape == many[k].shape and alone.flags.writeable and alone.flags.c_contiguous
                assert np.array_equal(alone, many[k])
                got = getattr(m, name + "_distortion")(*numbers)
                assert type(got) is cubemap.Distortion is type(tissot) and {type(one) for one in got} == {float}
                assert np.array_equal(got, [one[k] for one in tissot], equal_nan=True) and got.area == got[5]
    assert np.isnan(cubemap.Mapping().forward_jacobian(0, 0, 0.0)).all()
    kept = [cubemap.Mapping().forward_jacobian(1.0, 0.1 * k, 0.2) for k in range(3)]
    assert len({one.tobytes() for one in kept}) == 3  # not one array for all calls
    with pytest.raises(OverflowError):
        cubemap.Mapping().forward_jacobian(10**400, 0, 0)
    neighbours, count = cubemap.CellGrid().neighbours(cubemap.CellGrid().forward_lonlat(0.2, 0.9, 5))
    assert neighbours.dtype == np.uint64 and neighbours.shape == (8,) and count == 8


def test_float_loops_are_those_of_float(points):
    m = cubemap.Mapping()
    x, y, z = np.clip(points, -1e30, 1e30).astype(np.float32)
    face, u, v = m.forward(x, y, z)
    assert u.dtype == v.dtype == np.float32
    wide = m.forward(x.astype(np.float64), y.astype(np.float64), z.astype(np.float64))
    good = face == wide[0]
    assert 0 < np.nanmax(np.abs(u - wide[1])[good]) < 1e-6
    assert m.inverse(face, u, v)[0].dtype == np.float32
    assert m.forward_distortion(x, y, z).area.dtype == np.float32


@pytest.mark.parametrize("face", [256, -1, 2**40, -2**63, 6, 255])
def test_faces_that_do_not_fit_are_refused_not_wrapped(face):
    m = cubemap.Mapping()
    assert np.isnan(m.inverse(face, 0.0, 0.0)).all()
    assert np.isnan(np.array(m.inverse(np.int64(face), np.zeros(3), 0.0))).all()
    mixed = m.inverse(np.array([face, 2], np.int64), 0.0, 0.0)
    assert np.isnan(mixed[0][0]) and mixed[0][1] == -1.0


def test_faces_of_reals_are_refused():
    with pytest.raises(TypeError):
        cubemap.Mapping().inverse(np.array([0.0]), 0.0, 0.0)


def test_bad_input_gives_no_face_and_no_warning():
    m = cubemap.Mapping()
    with np.errstate(all="raise"):
        face, u, v = m.forward([0.0, np.nan, np.inf, 5e-324, 1e308], 0.0, 0.0)
    assert face.tolist() == [255, 255, 255, 0, 0] and np.isnan(u[:3]).all() and u[3:].tolist() == [0, 0]
    assert m.forward(0.0, 0.0, 0.0)[0] == 255
    assert m.forward(np.empty(0), np.empty(0), np.empty(0))[0].shape == (0,)


@given(st.tuples(*[st.floats(width=64)] * 3))
def test_any_numbers(numbers):
    m = cubemap.Mapping()
    face, u, v = m.forward(*numbers)
    good = np.isfinite(numbers).all() and any(numbers)
    assert (face < 6) == good
    if good:
        assert -1 <= u <= 1 and -1 <= v <= 1
        assert abs(np.linalg.norm(m.inverse(face, u, v)) - 1) < 1e-15


def test_threads_change_no_bit(random):
    x, y, z = random.normal(size=(3, 400_000))
    one, many = cubemap.Mapping("coupled"), cubemap.Mapping("coupled", threads=4)
    assert one == many and pickle.loads(pickle.dumps(many))._threads == 4
    for first, second in zip(one.forward(x, y, z), many.forward(x, y, z), strict=True):
        assert np.array_equal(first, second)
    assert np.array_equal(one.forward_jacobian(x, y, z), many.forward_jacobian(x, y, z))


def test_python_threads_work_at_once(points):
    m = cubemap.Mapping()
    expected = m.forward(*points)
    wrong = []

    def work():
        for _ in range(20):
            wrong.extend(k for k, (one, other) in enumerate(zip(m.forward(*points), expected, strict=True))
                         if not np.array_equal(one, other))

    workers = [threading.Thread(target=work) for _ in range(4)]
    [worker.start() for worker in workers]
    [worker.join() for worker in workers]
    assert not wrong


def test_a_function_keeps_its_mapping_alive(points):
    forward = cubemap.Mapping("tangent:c=1.1823").forward
    ufunc = cubemap.Mapping("arvo").forward.ufunc
    gc.collect()
    expected = cubemap.Mapping("tangent:c=1.1823").forward(*points)
    assert all(np.array_equal(one, other) for one, other in zip(forward(*points), expected, strict=True))
    assert np.array_equal(ufunc(*points)[1], cubemap.Mapping("arvo").forward(*points)[1])


def test_nothing_is_left_behind():
    def made():
        m = cubemap.Mapping()
        m.forward(1.0, 0.0, 0.0), m.forward([1.0], 0.0, 0.0), m.forward_distortion(1.0, 0.0, 0.0)

    for _ in range(50):
        made()
    gc.collect()
    before = sum(isinstance(one, _core.Function) for one in gc.get_objects())
    for _ in range(200):
        made()
    gc.collect()
    assert sum(isinstance(one, _core.Function) for one in gc.get_objects()) <= before


def test_derivatives_are_those_of_differences(random):
    m = cubemap.Mapping("coupled")
    x, y, z = random.normal(size=(3, 1000)) + [[3.0], [0.0], [0.0]]
    length = np.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    good = m.forward(x, y, z)[0] == 0
    x, y, z = x[good], y[good], z[good]
    jacobian, step = m.forward_jacobian(x, y, z), 1e-6
    for axis in range(3):
        ahead = m.forward(x + step * (axis == 0), y + step * (axis == 1), z + step * (axis == 2))
        behind = m.forward(x - step * (axis == 0), y - step * (axis == 1), z - step * (axis == 2))
        same = (ahead[0] == 0) & (behind[0] == 0)
        difference = np.stack([(a - b) / 2 / step for a, b in zip(ahead[1:], behind[1:], strict=True)], axis=-1)
        assert same.sum() > 500 and np.abs(jacobian[..., axis] - difference)[same].max() < 1e-8
    u, v = m.forward(x, y, z)[1:]
    product = m.forward_jacobian(x, y, z) @ m.inverse_jacobian(np.uint8(0), u, v)
    assert np.abs(product - np.eye(2)).max() < 1e-13
    tissot = m.forward_distortion(x, y, z)
    singular = np.linalg.svd(jacobian)[1]
    assert np.abs(tissot.major - singular[:, 0]).max() < 1e-13 and np.abs(tissot.minor - singular[:, 1]).max() < 1e-13


def test_what_a_mapping_has_not_is_said():
    with pytest.raises(cubemap.Error, match="no such operation"):
        cubemap.Mapping("healpix").warp(0.0, 0.0)
    with pytest.raises(cubemap.Error, match="copled"):
        cubemap.Mapping("copled")
    with pytest.raises(cubemap.Error, match="must be in"):
        cubemap.Mapping("tangent:c=-3")
    with pytest.raises(cubemap.Error, match="no frame"):
        cubemap.Mapping("tangent", "up")
    with pytest.raises(cubemap.Error) as caught:
        cubemap.Mapping("tangent", instructions="mmx")
    assert caught.value.status == 9 and pickle.loads(pickle.dumps(caught.value)).status == 9
    with pytest.raises(ValueError):
        cubemap.Mapping("coupled\0")
    with pytest.raises(ValueError):
        cubemap.Mapping(threads=-1)


def test_mappings_are_values():
    for info in cubemap.catalogue():
        m = cubemap.Mapping(info.identifier)
        again = pickle.loads(pickle.dumps(m))
        assert again == m and hash(again) == hash(m) and eval(repr(m)) == m and m.info == info
        assert pickle.loads(pickle.dumps(info)) == info and hash(m.info) == hash(info)
    assert cubemap.Mapping("tangent:c=1.1823") != cubemap.Mapping("tangent")
    assert cubemap.Mapping("coupled", "gl") != cubemap.Mapping("coupled")
    assert cubemap.Mapping("COUPLED") == cubemap.Mapping()
    assert cubemap.Mapping("asc:c=1" if cubemap.find_mapping("asc") is None else "tangent").info.identifier == "tangent"
    assert cubemap.find_mapping("nothing") is None


class Named(cubemap.Mapping):
    """As users make their own: with another constructor, and with more in it."""

    def __init__(self, name, mapping="qsc"):
        super().__init__(mapping)
        self.name, self._seen = name, [1, 2]


class Turned(cubemap.Pose):
    pass


class Disc(cubemap.Region):
    def __init__(self, *given):
        super().__init__("cap", *given)


class Views(cubemap.Plan):
    pass


def test_classes_made_of_them_are_values():
    named = Named("mine")
    named.forward(1.0, 0.5, 0.0)
    for again in (pickle.loads(pickle.dumps(named)), copy.copy(named), copy.deepcopy(named)):
        assert type(again) is Named and again == named and again.name == "mine" and again._seen == [1, 2]
        assert again.forward(1.0, 0.5, 0.0) == cubemap.Mapping("qsc").forward(1.0, 0.5, 0.0)
    assert pickle.loads(pickle.dumps(named.forward))(1.0, 0.5, 0.0) == named.forward(1.0, 0.5, 0.0)
    for one in (Turned(), Disc(0.1, 0.2, 0.3), Views("equirect;size=8", "cube:coupled;size=4")):
        one.name = "mine"
        for again in (pickle.loads(pickle.dumps(one)), copy.copy(one)):
            assert type(again) is type(one) and again == one and again.name == "mine"


def test_what_things_are_put_into_is_no_value():
    """A copy would be the same under another name: what is put into the one were in the other."""
    store = cubemap.Store()
    store[b"key"] = b"kept"
    depth = np.ones((6, 8), np.float32)
    held = [store, cubemap.Octree(0.1), cubemap.Raster(cubemap.Camera(8, 6, 10, 10, 3.5, 2.5)), cubemap.DepthPyramid(depth),
            cubemap.Environment("coupled", np.ones((6, 4, 4), np.float32)), cubemap.Errors(1), cubemap.advise([("coupled",)])]
    for one in held:
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match=rf"a cubemap.{type(one).__name__} cannot be copied or pickled"):
                copied(one)
        assert repr(one).startswith(f"<cubemap.{type(one).__name__} of ") and " at 0x" not in repr(one)


def test_frames():
    geo = cubemap.Frame.named("geo")
    assert cubemap.frames() == ("geo", "gl", "fits", "s2") and [face.name for face in geo.faces][:2] == ["front", "right"]
    turned = cubemap.Frame("mine", geo.faces[1:] + geo.faces[:1])
    m = cubemap.Mapping("coupled", turned)
    assert m.forward(1.0, 0.0, 0.0)[0] == 5 and m.frame is turned and pickle.loads(pickle.dumps(m)) == m
    with pytest.raises(cubemap.Error):
        cubemap.Mapping("coupled", cubemap.Frame("bad", (geo.faces[0],) * 6))


def test_instruction_sets_agree(points):
    x, y, z = points
    found = [cubemap.Mapping("coupled", instructions=name).forward(x, y, z) for name in cubemap.instruction_sets()]
    for face, u, v in found[1:]:
        assert np.array_equal(face, found[0][0]) and np.abs(u - found[0][1]).max() < 4 * EPS
    fast = cubemap.Mapping("tangent", tier="fast")
    assert fast.tier in ("fast", "exact")


def test_a_named_result_has_as_many_names_as_outputs():
    """Of another named tuple parts would be no objects, or be written behind its end."""
    m = cubemap.Mapping()
    for named in (cubemap.Distortion, cubemap.mapping.Face):
        with pytest.raises(TypeError, match=f"has {len(named._fields)} fields, cm_forward_array 3 outputs"):
            _core.Function("cm_forward_array", m._handle, (), 1, named)
    with pytest.raises(AttributeError, match="_fields"):
        _core.Function("cm_forward_array", m._handle, (), 1, tuple)


@pytest.mark.skipif(not cubemap._library.HAS_SIM, reason="no library cubemap-sim")
def test_numbers_for_functions_of_float_alone():
    """Whole ones, too, are read as the numbers that they are."""
    error = cubemap._methods.depth_error_local
    assert error(2, 0.5) == error(2.5, 1) == 1.5 and error(2**24 + 1, 1) == 2.0**24 - 1
    with pytest.raises(OverflowError):
        error(10**400, 1)


@pytest.mark.skipif(not cubemap._library.HAS_SIM, reason="no library cubemap-sim")
def test_arrays_for_functions_of_float_alone():
    """They take what functions with loops of both take, and round it: the result is that of the rounded numbers."""
    error, slope = cubemap._methods.depth_error_local, cubemap._methods.depth_error_slope
    depth, truth = np.array([[1.1, 2.2, 3.3], [16777217, 0.7, 1e-3]]), np.array([[0.3, 2.0, 4.0], [16777215, 0.1, 2e-3]])
    expected = error(depth.astype(np.float32), truth.astype(np.float32))
    assert expected.dtype == np.float32 and expected[1, 0] == 1
    for given in ((depth, truth), (depth.tolist(), truth.tolist()), (depth.astype(">f8"), truth.astype("<f4")),
                  (np.asfortranarray(depth), truth[:, ::-1][:, ::-1]), (depth.astype(np.float32), truth)):
        found = error(*given)
        assert found.dtype == np.float32 and np.array_equal(found, expected)
    for kind in (np.float16, np.int8, np.uint16, np.int32, np.uint64):
        assert error([3, 5], np.array([1, 2], kind)).tolist() == [2, 3]
    assert error(True, 0.5) == error(np.bool_(True), np.float64(0.5)) == 0.5
    assert error(np.array([True, True]), [0.25, 0.5]).tolist() == [0.75, 0.5]
    assert error(np.empty((0, 3)), [1.0, 2.0, 3.0]).shape == (0, 3)
    out = np.zeros(2)
    error([2.0, 4.0], 1.0, out=out, where=[True, False])
    assert out.tolist() == [1, 0]
    assert error(np.float64(1e300), 1.0) != error(1.0, 1.0)  # rounded to infinity, which is no depth
    assert slope([0, 0, 1], [[0, 1.0, 0], [0, 0, 2.0]]).tolist() == [pytest.approx(np.pi / 2), 0]
    assert slope(np.array([[0, 0, 1.0]]), np.array([0, 3, 3])).dtype == np.float32
    for refused in (1j, "1", None, np.array([1.0], object), np.longdouble(1.1)):
        with pytest.raises(TypeError):
            error([refused], 1.0)
    assert "rounded to float32" in error.__doc__ and "rounded to float32" not in cubemap.Mapping().forward.__doc__


def test_methods_and_functions_are_pickled():
    """For who sends them to other processes; they do not keep their object."""
    region, given = cubemap.Region.cap(0.2, 0.9, 0.01), (0.6, 0.3, 0.2)
    for function in (cubemap.Mapping("tangent:c=1.2", "gl", threads=2).forward, cubemap.Grid("seamless", ellipsoid="WGS84").forward,
                     cubemap.CellGrid().centre, cubemap.Healpix(8, "nested").pixel_from_direction, cubemap.Camera(8, 6, 10, 10, 3.5, 2.5).project,
                     cubemap.direction_from_lonlat, cubemap.cell_level, cubemap.pose_compose, region.contains):
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            again = pickle.loads(pickle.dumps(function, protocol))
            assert again.__name__ == function.__name__
        copies = again, copy.copy(function), copy.deepcopy(function)
        if hasattr(function, "ufunc") and function.ufunc.nin == 3:
            assert all(one(*given) == function(*given) and one.ufunc is not function.ufunc for one in copies)
    assert type(pickle.loads(pickle.dumps(cubemap.Mapping().forward_distortion))(*given)) is cubemap.Distortion
    m = cubemap.Mapping()
    forward, gone = m.forward, weakref.ref(m)
    del m
    assert gone() is None and forward(*given)[0] == 0
    for bound in (cubemap.Scene.named("room").cast, cubemap.Trajectory([0.0, 1.0], cubemap.Pose(position=[(0, 0, 0), (2, 0, 0)])).at):
        with pytest.raises(TypeError, match="cannot be pickled"):
            pickle.dumps(bound)
    with pytest.raises(TypeError, match="cannot be pickled"):
        pickle.dumps(_core.Function("cm_forward_array", cubemap.Mapping()._handle))


def test_levels_of_cells_are_whole_numbers():
    cells, place = cubemap.CellGrid(), (0.1, 0.2)
    assert cells.forward_lonlat(*place, np.array(3)) == cells.forward_lonlat(*place, np.int8(3)) == cells.forward_lonlat(*place, 3)
    for level in (3.0, "3", np.array([3]), None):
        with pytest.raises(TypeError, match="integer"):
            cells.forward_lonlat(*place, level)


def test_masks_of_points_with_several_numbers():
    """A masked point has all its numbers masked, whatever their shape; NumPy alone gives masks of other shapes, or none."""
    m, rotation = cubemap.Mapping("coupled"), cubemap.Rotation("10,20,30")
    x = np.ma.array([1.0, 2.0, 3.0, 4.0], mask=[False, True, False, False])
    y = np.ma.array([[0.5], [0.25]], mask=[[False], [True]])
    expected = np.ma.getmaskarray(x + y)
    bare = m.forward_jacobian(x.data, y.data, 0.5)
    jacobians = m.forward_jacobian(x, y, 0.5)
    assert np.array_equal(jacobians.data, bare)
    assert np.array_equal(jacobians.mask, np.broadcast_to(expected[..., np.newaxis, np.newaxis], bare.shape))

    directions = np.ma.array(np.arange(1.0, 13.0).reshape(4, 3), mask=np.eye(4, 3, -1))
    turned = rotation.apply(directions)
    assert np.array_equal(turned.data, rotation.apply(directions.data))
    assert np.array_equal(turned.mask, np.broadcast_to([[False], [True], [True], [True]], (4, 3)))
    across = rotation.apply(directions.T, axes=[(0, 1), 0, 0])
    assert np.array_equal(across.mask, turned.mask.T) and np.array_equal(across.data, turned.data.T)

    plain, masked = np.empty_like(bare), np.ma.zeros(bare.shape)
    assert m.forward_jacobian(x, y, 0.5, out=plain) is plain
    assert m.forward_jacobian(x, y, 0.5, masked) is masked
    assert np.array_equal(plain, bare) and np.array_equal(masked.mask, jacobians.mask)
    assert m.forward_jacobian(np.ma.masked, 1.0, 0.5).mask.all()
    assert not m.forward_jacobian(np.ma.array([1.0, 2.0]), 1.0, 0.5).mask.any()
    with pytest.raises(TypeError, match="out"):
        m.forward_jacobian(x, y, 0.5, masked, out=masked)
    with pytest.raises(TypeError):
        m.forward_jacobian(x, y)


BEYOND = 2**32


@pytest.mark.parametrize("refused", [
    lambda: cubemap.face_weights("coupled", 8, BEYOND + 1), lambda: cubemap.face_weights("coupled", 8, threads=-1),
    lambda: cubemap.Surface("equirect", BEYOND + 64, BEYOND + 32), lambda: cubemap.Octree(10.0, BEYOND + 8),
    lambda: cubemap.cell_token(2**64 + 5), lambda: cubemap.Healpix(16).ring_info(2**64 + 5),
    lambda: cubemap.sphere_points(-1)])
def test_whole_numbers_that_do_not_fit(refused):
    """ctypes cuts off the bits for which there is no room: face 2^32 + 1 was face 1, and a picture of 2^32 + 64 had 64."""
    with pytest.raises(cubemap.Error, match=r"^\w+: from -?\d+ to \d+, not -?\d+$"):
        refused()


def test_whole_numbers_as_they_are():
    cell = int(cubemap.CellGrid().forward(0.0, 0.0, -1.0, 10))
    assert cell >= 2**63 and cubemap.cell_token(cell - 2**64) == cubemap.cell_token(cell)  # the same 64 bits, as databases have them
    assert np.array_equal(cubemap.face_weights("coupled", np.int64(8), np.uint8(1)), cubemap.face_weights("coupled", 8, 1))
    for refused in (lambda: cubemap.Healpix(1.5), lambda: cubemap.cell_token(1.5), lambda: cubemap.Healpix(16).ring_info(5.5),
                    lambda: cubemap.Healpix(16).boundary(5.5), lambda: cubemap.normalise_cells([1.5])):
        with pytest.raises(TypeError, match="integer"):
            refused()
