# SPDX-License-Identifier: MIT
"""Dask and xarray; with a cluster whose worker is killed on the way."""

import importlib.util
import os
import subprocess
import sys
import time

import cubemap
import numpy as np
import pytest
from cubemap import large

da = pytest.importorskip("dask.array")
xarray = pytest.importorskip("xarray")


@pytest.fixture
def vectors(random):
    return random.normal(size=(3, 5000))


def test_arrays_of_dask(vectors):
    m = cubemap.Mapping()
    lazy = [da.from_array(one, chunks=700) for one in vectors]
    face, u, v = large.apply(m, "forward", *lazy)
    assert face.dtype == np.uint8 and u.dtype == np.float64
    expected = m.forward(*vectors)
    assert all(np.array_equal(one.compute(), other) for one, other in zip((face, u, v), expected, strict=True))
    back = large.apply(m, "inverse", face, u, v)
    assert np.array_equal(back[2].compute(), m.inverse(*expected)[2])
    narrow = large.apply(m, "forward", *(one.astype(np.float32) for one in lazy))
    assert narrow[1].dtype == np.float32 == narrow[1].compute().dtype
    jacobian = large.apply(m, "forward_jacobian", *lazy)
    assert jacobian.shape == (5000, 2, 3) and np.array_equal(jacobian.compute(), m.forward_jacobian(*vectors))
    pixel = large.apply(cubemap.Healpix(64), "pixel_from_direction", *lazy)
    assert np.array_equal(pixel.compute(), cubemap.Healpix(64).pixel_from_direction(*vectors))
    area = large.apply(m, "inverse_distortion", face, u, v)
    assert len(area) == 9 and np.array_equal(area[5].compute(), m.inverse_distortion(*expected).area)
    with pytest.raises(TypeError):
        large.apply(m, "inverse", u, u, v)
    with pytest.raises(TypeError):
        large.apply(m, "forward", u, v)


@pytest.mark.parametrize("chunks", [None, 700])
def test_arrays_of_xarray(vectors, chunks):
    m = cubemap.Mapping()
    x, y, z = (xarray.DataArray(one, dims="point", coords={"point": np.arange(5000) * 2}) for one in vectors)
    if chunks:
        x, y, z = (one.chunk({"point": chunks}) for one in (x, y, z))
    face, u, v = large.apply(m, "forward", x, y, z)
    assert np.array_equal(u.values, m.forward(*vectors)[1]) and np.array_equal(face.point, x.point)
    assert large.apply(None, "lonlat_from_direction", x, y, z)[0].dtype == np.float64


def raster_of(height):
    lat, lon = np.radians(90 - (np.arange(height) + 0.5) * 180 / height), np.radians((np.arange(2 * height) + 0.5) * 180 / height - 180)
    return (np.sin(3 * lon) * np.cos(lat[:, np.newaxis]) ** 3 + 0.5 * np.sin(2 * lat[:, np.newaxis])).astype(np.float32)


@pytest.mark.parametrize("chunks", [(64, 64), (256, 512), (100, 37)])
@pytest.mark.parametrize("filter", ["nearest", "bilinear", "lanczos3"])
def test_tiles_are_what_the_library_makes_of_the_whole(chunks, filter):
    raster = raster_of(256)
    whole = cubemap.Surface("equirect;size=512")
    target = cubemap.Surface("cube:coupled;size=90")
    middle = np.arange(90) + 0.5
    x, y, z = target.directions(np.arange(6, dtype=np.uint8)[:, np.newaxis, np.newaxis], middle[np.newaxis, np.newaxis], middle[np.newaxis, :, np.newaxis])
    expected = whole.sample(raster, x, y, z, filter)[..., 0]
    made = large.reproject(da.from_array(raster, chunks=chunks), "cube:coupled", 90, tile=40, filter=filter)
    assert made.shape == (6, 90, 90) and made.chunks[1] == (40, 40, 10)
    error = np.abs(made.compute(scheduler="threads") - expected)
    near_pole = np.abs(z) > np.cos(np.radians(4 * 180 / 256))
    # beside a border of pixels the nearest may be the other one
    assert (error[~near_pole] > 1e-5).mean() < (2e-4 if filter == "nearest" else 1e-12)
    assert error.max() < 0.05


def test_rotated_and_other_targets():
    raster = da.from_array(raster_of(64), chunks=(32, 32))
    turned = large.reproject(raster, "cube:coupled", 32, tile=20, rotation=cubemap.Rotation("30,40,50")).compute(scheduler="threads")
    expected = cubemap.resample(raster.compute(), "equirect", cubemap.Surface("cube:coupled;size=32", rotation="30,40,50"), filter="bilinear")
    assert np.abs(turned - expected).max() < 0.02
    wide = large.reproject(raster, "mercator;size=64;north=80;south=-80", tile=50).compute(scheduler="threads")
    assert wide.shape == cubemap.Surface("mercator;size=64;north=80;south=-80").shape and np.abs(wide).max() < 1.6
    with pytest.raises(ValueError):
        large.reproject(raster, "cube:coupled", 32, filter="ewa")


def test_rasters_of_xarray():
    values = raster_of(64)
    lat, lon = 90 - (np.arange(64) + 0.5) * 180 / 64, (np.arange(128) + 0.5) * 180 / 64 - 180
    north = xarray.DataArray(values, dims=("lat", "lon"), coords={"lat": lat, "lon": lon}, name="t", attrs={"units": "K"})
    made = large.reproject(north, "cube:coupled;frame=gl", 32, tile=16)
    assert made.dims == ("face", "v", "u") and made.attrs["units"] == "K" and made.face.values[0] == "+x"
    expected = large.reproject(values, "cube:coupled;frame=gl", 32).compute(scheduler="threads")
    assert np.abs(made.values - expected).max() < 1e-6  # tiles of other sizes: the last bits
    # a place by its coordinates
    m = cubemap.Mapping("coupled", "gl")
    x, y, z = m.inverse(np.uint8(2), made.u.values[5], made.v.values[7])
    assert cubemap.Surface("cube:coupled;frame=gl;size=32").positions(x, y, z)[1:] == (pytest.approx(5.5), pytest.approx(7.5))
    assert np.abs(large.reproject(north[::-1], "cube:coupled;frame=gl", 32).values - expected).max() < 1e-6
    shifted = north.roll(lon=64)
    shifted = shifted.assign_coords(lon=lon + 180)
    assert np.abs(large.reproject(shifted, "cube:coupled;frame=gl", 32).values - expected).max() < 1e-5
    with pytest.raises(ValueError):
        large.reproject(north.rename(lat="y"), "cube:coupled", 32)
    with pytest.raises(ValueError):
        large.reproject(north.assign_coords(lat=lat**3), "cube:coupled", 32)


def raster_on_a_cluster(root):
    specification = importlib.util.spec_from_file_location("raster_on_a_cluster", root / "bindings/python/raster_on_a_cluster.py")
    example = importlib.util.module_from_spec(specification)
    sys.modules["raster_on_a_cluster"] = example  # workers read it by its name
    sys.path.insert(0, str(root / "bindings/python"))
    specification.loader.exec_module(example)
    return example


def test_the_memory_of_a_worker_is_its_own(root):
    """Not what the process had that began it, 600 MB here: of 20 GB the graph alone took more than a worker may have."""
    raster_on_a_cluster(root)
    kept = np.ones(600_000_000, np.uint8)
    path = os.pathsep.join([str(root / "bindings/python"), *filter(None, [os.environ.get("PYTHONPATH")])])
    measured = subprocess.run([sys.executable, "-c", "import raster_on_a_cluster as example; print(example.most_memory())"],
                              env={**os.environ, "PYTHONPATH": path}, check=True, capture_output=True)
    assert 10e6 < int(measured.stdout) < 400e6 < kept.nbytes


def test_a_cluster_with_a_worker_killed(root, request):
    example = raster_on_a_cluster(root)
    worst, count, expected, pid, done, peak = example.run(20000 if request.config.getoption("--long") else 200, 2)
    assert count == expected and worst < 4e-5 and pid and peak < 1e9
    assert 0.5 <= done < 0.9  # halfway: tasks of the raster come before tiles, and are more


def test_the_graph_of_a_large_raster_is_made_in_time():
    """20 GB in 4802 blocks: each of 3750 tiles must not look at each block."""
    raster = da.zeros((50176, 100352), chunks=(1024, 1024), dtype=np.float32)
    begun = time.process_time()
    faces = large.reproject(raster, "cube:coupled", 25088)
    assert faces.npartitions == 3750 and time.process_time() - begun < 60  # 8 s where each tile's blocks took 170


def test_types_beside_numbers_of_python():
    """Chunks are of the type that the whole says, which is NumPy's own."""
    m = cubemap.Mapping("coupled")
    for kind in (np.float32, np.float64, np.int8):
        plain = np.arange(1, 7).astype(kind)
        for others in ((0.5, 2), (0.5, plain)):
            expected = m.forward(plain, *others)
            made = large.apply(m, "forward", da.from_array(plain, chunks=4), *others)
            for one, other in zip(made, expected, strict=True):
                assert one.dtype == one.compute().dtype == other.dtype and np.array_equal(one.compute(), other)


def test_rasters_that_are_refused_at_once():
    with pytest.raises(TypeError, match="raster: .*float32, not float64"):
        large.reproject(np.ones((8, 16)), "cube:coupled", 8)
    for shape in ((8,), (0, 0), (8, 0), (8, 16, 0), (1, 8, 16, 1)):
        with pytest.raises(ValueError, match="raster: rows and columns"):
            large.reproject(np.ones(shape, "f4"), "cube:coupled", 8)
    for edges in ({"west": 10, "east": 10}, {"west": 20, "east": 10}, {"north": np.nan}, {"south": 90, "north": -90}, {"west": -np.inf}):
        with pytest.raises(ValueError, match="outer edges"):
            large.reproject(np.ones((8, 16), "f4"), "cube:coupled", 8, **edges)
    with pytest.raises(ValueError, match="tile: 1 or more"):
        large.reproject(np.ones((8, 16), np.float32), "cube:coupled", 8, tile=0)
