# SPDX-License-Identifier: MIT
"""Objects as values whatever they were made of, faces of any whole numbers, and single points of functions for many."""

import pickle

import cubemap
import numpy as np
import pytest
from cubemap import healpy, large


def test_faces_of_unsigned_numbers_of_64_bits():
    """As other packages index with them: NumPy makes int64 of none."""
    m, grid = cubemap.Mapping("coupled"), cubemap.Grid("coupled")
    for function in (m.inverse, m.inverse_lonlat, m.inverse_jacobian, m.inverse_distortion, grid.inverse, grid.inverse_lonlat):
        for kind in (np.float64, np.float32):
            u, v = np.array([0.1, -0.3, 0.5, 0.7], kind), kind(0.2)
            wide, narrow = (function(np.arange(4, dtype=faces), u, v) for faces in (np.uint64, np.uint8))
            assert np.array_equal(wide, narrow) and wide[0].dtype == narrow[0].dtype
    wrong = np.array([256, 6, 2**63, 2**63 + 1, 2**64 - 1, 1], np.uint64)
    for faces in (wrong, wrong.astype(">u8"), wrong[::-1][::-1]):
        x, y, z = cubemap.Mapping("coupled").inverse(faces, 0.1, 0.2)
        assert np.isnan(x[:5]).all() and (x[5], y[5], z[5]) == cubemap.Mapping("coupled").inverse(1, 0.1, 0.2)
    assert np.isnan(cubemap.Mapping("coupled").inverse([2**64 - 1, 2**63], 0.1, 0.2)[0]).all()
    assert cubemap.Mapping("coupled").inverse(np.uint64(1), 0.1, 0.2) == cubemap.Mapping("coupled").inverse(1, 0.1, 0.2)
    with pytest.raises(TypeError):
        cubemap.Mapping("coupled").inverse(np.array([1.0]), 0.1, 0.2)


def test_faces_of_unsigned_numbers_of_dask():
    da = pytest.importorskip("dask.array")
    made = large.apply(cubemap.Mapping("coupled"), "inverse", da.arange(6, chunks=4, dtype=np.uint64), 0.1, 0.2)
    assert np.array_equal(made[0].compute(), cubemap.Mapping("coupled").inverse(np.arange(6), 0.1, 0.2)[0])
    with pytest.raises(TypeError, match="^name: a method that is a ufunc, not 'specification'$"):
        large.apply(cubemap.Mapping("coupled"), "specification", da.ones(3))


def test_cells_of_dask_and_of_xarray():
    """The level is no array."""
    da, xarray = pytest.importorskip("dask.array"), pytest.importorskip("xarray")
    cells, (lon, lat) = cubemap.CellGrid(), np.random.default_rng(3).uniform(-1, 1, (2, 50))
    expected = cells.forward_lonlat(lon, lat, 12)
    made = large.apply(cells, "forward_lonlat", da.from_array(lon, chunks=20), da.from_array(lat, chunks=20), level=12)
    assert made.dtype == np.uint64 and np.array_equal(made.compute(), expected)
    named = large.apply(cells, "forward_lonlat", xarray.DataArray(lon, dims="point"), lat, level=12)
    assert named.dims == ("point",) and np.array_equal(named.values, expected)
    made = large.apply(cells, "forward", da.from_array(lon, chunks=20), lat, 0.5, level=np.int8(30))
    assert np.array_equal(made.compute(), cells.forward(lon, lat, 0.5, 30))
    with pytest.raises(TypeError, match="level"):
        large.apply(cells, "forward_lonlat", da.from_array(lon), lat)
    with pytest.raises(cubemap.Error, match="level: 0 to 30, not 31"):
        large.apply(cells, "forward_lonlat", da.from_array(lon), lat, level=31)
    with pytest.raises(TypeError, match="^forward has no option level$"):
        large.apply(cubemap.Mapping(), "forward", da.from_array(lon), lat, 1.0, level=3)


def test_frames_are_values_whatever_their_rows_are():
    table = cubemap.Frame.named("gl").faces
    frames = [cubemap.Frame("mine", rows) for rows in (table, list(table), [list(row) for row in table], map(tuple, table))]
    for frame in frames:
        assert frame == frames[0] and hash(frame) == hash(frames[0]) and type(frame.faces[3]) is cubemap.Face
        m = cubemap.Mapping("coupled", frame)
        assert m == cubemap.Mapping("coupled", frames[0]) and hash(m) == hash(pickle.loads(pickle.dumps(m)))
        assert eval(repr(frame), vars(cubemap)) == frame
    for none in (5, [1, 2, 3, 4, 5, 6], [(1, 2)] * 6):
        with pytest.raises(cubemap.Error, match="faces: six of "):
            cubemap.Frame("mine", none)
    with pytest.raises(cubemap.Error, match="a frame has six faces, not 5"):
        cubemap.Mapping("coupled", cubemap.Frame("mine", table[:5]))


def test_budgets_are_values_whatever_holds_their_entries():
    entries = [cubemap.BudgetEntry("distortion", 0.004, 2.1), ("multipath", 0.001, 46.0)]
    one, other = cubemap.Budget(entries, unit="m"), cubemap.Budget(tuple(entries), unit="m")
    assert one == other and not one != other and hash(one) == hash(other) and len({one, other}) == 1
    assert one != cubemap.Budget(entries, unit="cm") and one != 5 and pickle.loads(pickle.dumps(one)) == one


def test_worlds_print_what_makes_them_again():
    """Poses of what is no mesh were zeros, which is none."""
    for name in cubemap.SCENES:
        world = cubemap.Scene.named(name)
        assert eval(repr(world), {"cubemap": cubemap, **vars(cubemap)}) == world
        assert all(one.pose == cubemap.Pose() for one in world.primitives if one.kind != "mesh")


def test_worlds_of_what_can_be_read_once():
    """They had all surfaces, and said that there were none."""
    spheres = [cubemap.Primitive.sphere((place, 0, 0), 0.1) for place in range(3)]
    world = cubemap.Scene(iter(spheres))
    assert world == cubemap.Scene(spheres) == pickle.loads(pickle.dumps(world)) and world.primitives == tuple(spheres)
    for take, words in ((lambda: cubemap.Primitive.sphere((0, 0), 1), r"^centre: three numbers, not \(2,\)$"),
                        (lambda: cubemap.Scene([cubemap.Primitive("sphere", first=(1, 2), radius=1.0)]), r"^first: three numbers, not \(2,\)$"),
                        (lambda: cubemap.Scene([spheres[0]._replace(material=cubemap.Material((1, 2), 0.5))]), r"^color: three numbers"),
                        (lambda: cubemap.Scene([cubemap.Primitive("cone")]), "^kind: 'cone' is none of plane, box, sphere, cylinder, mesh$")):
        with pytest.raises(ValueError, match=words):
            take()


def test_what_is_of_the_module_sim_says_so():
    sim = pytest.importorskip("cubemap.sim")
    for one in (sim.Brdf(), sim.Brdf("cook-torrance", diffuse=0.5, specular=0.4, roughness=0.2, eta=1.5)):
        assert repr(one).startswith("cubemap.sim.Brdf(") and eval(repr(one)) == one


def test_numbers_of_threads_that_do_not_fit():
    for make in (lambda n: cubemap.Mapping(threads=n), lambda n: cubemap.Surface("equirect;size=8", threads=n),
                 lambda n: cubemap.Healpix(8, threads=n)):
        for many in (2**32, 2**32 + 1, 2**70):  # of which the lowest bits were taken
            with pytest.raises(cubemap.Error, match=f"^threads: from 0 to 4294967295, not {many}$"):
                make(many)


def test_single_points_have_no_axis_of_points():
    surface, picture = cubemap.Surface("equirect;size=8"), np.arange(32, dtype=np.float32).reshape(4, 8)
    assert surface.sample(picture, 1.0, 0.2, 0.3).shape == (1,) and surface.sample(picture, [1.0], 0.2, 0.3).shape == (1, 1)
    assert np.array_equal(surface.sample(np.stack([picture] * 3, axis=-1), 1.0, 0.2, 0.3), surface.sample(picture, [1.0] * 3, 0.2, 0.3)[:, 0])
    masked = np.ma.masked_less(picture, 40)
    assert surface.sample(masked, 1.0, 0.2, 0.3).shape == (1,) and surface.sample(masked, 1.0, 0.2, 0.3).mask.all()
    value, doubt = cubemap.percentiles("coupled", "area", 50)
    assert np.ndim(value) == np.ndim(doubt) == 0 and value == cubemap.percentiles("coupled", "area", [50])[0][0]
    assert cubemap.percentiles("coupled", "area", [[10, 90]])[0].shape == (1, 2)


def test_poses_one_by_one():
    poses = cubemap.Pose(position=np.arange(12.0).reshape(4, 3))
    assert [one.position.tolist() for one in poses] == poses.position.tolist() and list(poses[:0]) == []
    assert [row.shape for row in cubemap.Pose(position=np.zeros((2, 5, 3)))] == [(5,), (5,)]
    with pytest.raises(TypeError, match="one pose has no length"):
        list(cubemap.Pose())


def test_lists_of_one_resolution():
    """As arrays of one: what takes one nside alone says so of others, in words of its own."""
    for nside in ([8], (8,), np.array([8])):
        assert np.array_equal(healpy.boundaries(nside, 5), healpy.boundaries(8, 5))
        assert np.array_equal(healpy.boundaries(nside, [5, 6]), healpy.boundaries(8, [5, 6]))
        assert np.array_equal(healpy.query_disc(nside, (1, 0, 0), 0.3), healpy.query_disc(8, (1, 0, 0), 0.3))
    for take in (lambda: healpy.boundaries([2, 8], 5), lambda: healpy.query_disc((2, 8), (1, 0, 0), 0.3)):
        with pytest.raises(ValueError, match="nside is one number here, not 2"):
            take()


def test_what_would_be_another_thing_is_refused():
    """All faces for none, and words of Python's own."""
    for take in (lambda: cubemap.statistics("coupled", "area", faces=[]), lambda: cubemap.percentiles("coupled", "area", 50, faces=())):
        with pytest.raises(cubemap.Error, match="^faces: there are none$"):
            take()
    surface, picture = cubemap.Surface("equirect;size=8"), np.ones((4, 8), np.float32)
    plan = cubemap.Plan(surface, "cube:coupled;size=4")
    for take in (lambda: cubemap.border(surface, picture, 1, dtype=float), lambda: plan.filter_of(picture, dtype="f8")):
        with pytest.raises(TypeError, match="^dtype: uint8, uint16, float16, float32, not float64$"):
            take()
    assert cubemap.border(surface, picture, 1, dtype="u1").dtype == np.uint8
    for nside in (0, -2):
        with pytest.raises(cubemap.Error, match=f"^nside: 1 to 2.29, not {nside}$"):
            cubemap.healpix_arrange(np.arange(48), nside)
    turned = cubemap.Rotation("10,20,30")
    assert cubemap.Rotation(turned) == turned
