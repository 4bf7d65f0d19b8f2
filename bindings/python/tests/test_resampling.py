# SPDX-License-Identifier: MIT
"""Colour maps, surfaces, plans and what is drawn of them."""

import pickle

import cubemap
import matplotlib
import numpy as np
import pytest

matplotlib.use("Agg")
import cubemap.plot  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402


def test_colormaps_of_matplotlib():
    names = cubemap.register_colormaps()
    assert len(names) == 2 * len(cubemap.colormaps()) and cubemap.register_colormaps() == names
    c = cubemap.Colormap("sequential-single:hue=140").fit()
    assert np.allclose(c.to_matplotlib()(np.arange(256))[:, :3], c.samples(256))
    assert np.array_equal(c.samples(9, np.uint8), np.rint(c.samples(9) * 255))
    # equal steps for the eye: as far apart in CIELUV
    luv = cubemap.luv_from_linear(cubemap.linear_from_srgb(cubemap.Colormap("uniform-blue").fit().samples(64)))
    assert luv.shape == (64, 3)
    found = c.color_at(np.linspace(0, 1, 5))
    assert np.allclose(cubemap.srgb_from_linear(found.linear), found.srgb) and found.inside.all()
    assert np.allclose(cubemap.lch_from_luv(found.luv)[..., 0], found.lch[..., 0])
    assert pickle.loads(pickle.dumps(c)) == c and c.clipping(100).count == 0 and c.length > 0
    assert cubemap.find_colormap("nothing") is None and (c.corners > 0).all()
    # Sharma et al. 2005, table 1, pair 1
    assert cubemap.ciede2000((50, 2.6772, -79.7751), (50, 0, -82.7485)) == pytest.approx(2.0425, abs=5e-5)
    with pytest.raises(cubemap.Error):
        cubemap.Colormap("mauve")
    with pytest.raises(TypeError):
        c.samples(5, np.float32)


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float16", "float32"])
def test_resampling_there_and_back(dtype, random):
    row, column = np.mgrid[0:128, 0:256]
    smooth = 0.5 + 0.4 * np.cos(np.pi * (row + 0.5) / 128) * 0.5 + 0.1 * np.sin(np.pi * (row + 0.5) / 128) * np.cos(np.pi * (column + 0.5) / 128)
    scale = np.iinfo(dtype).max if dtype.startswith("u") else 1
    picture = np.repeat((smooth * scale).astype(dtype)[..., np.newaxis], 3, axis=2)
    faces = cubemap.resample(picture, "equirect", "cube:coupled;size=96")
    assert faces.shape == (6, 96, 96, 3) and faces.dtype == picture.dtype
    back = cubemap.resample(faces, "cube:coupled", "equirect;size=256")
    assert np.abs(back.astype(float) - picture).max() < 0.004 * scale + (scale > 1)


def test_strides_of_pictures(random):
    picture = random.random((64, 128, 3), dtype=np.float32)
    plan = cubemap.Plan("equirect;size=128", "cube:coupled;size=32", filter="bilinear")
    expected = plan.resample(picture)
    wide = np.zeros((64, 256, 5), np.float32)
    wide[:, ::2, 1:4] = picture
    assert np.array_equal(plan.resample(wide[:, ::2, 1:4]), expected)
    assert np.array_equal(plan.resample(picture[::-1][::-1]), expected)
    upside = np.ascontiguousarray(picture[::-1])
    assert np.array_equal(plan.resample(upside[::-1]), expected)
    planar = np.ascontiguousarray(picture.transpose(2, 0, 1)).transpose(1, 2, 0)
    assert np.array_equal(plan.resample(planar), expected)
    out = np.full((6, 32, 32, 4), 7, np.float32)
    assert plan.resample(picture, out=out[..., :3]) is not None
    assert np.array_equal(out[..., :3], expected) and (out[..., 3] == 7).all()
    part = plan.resample(picture, rows=(2, 5, 3))
    assert np.array_equal(part[2, 5:8], expected[2, 5:8]) and not part[[0, 1, 3, 4, 5]].any() and not part[2, 8:].any()
    assert np.array_equal(plan.resample(picture, threads=2), expected)
    assert np.abs(plan.resample(picture[..., 0]) - expected[..., 0]).max() < 2e-7  # other loops: the last bit
    assert plan.resample(picture, dtype=np.uint8).dtype == np.uint8
    for bad in (picture.astype(np.float64), picture[:10], np.zeros((6, 64, 128, 3), np.float32)):
        with pytest.raises((TypeError, ValueError)):
            plan.resample(bad)
    with pytest.raises(ValueError, match="pictures: "):  # not: out
        plan.resample(picture[..., :0])
    with pytest.raises(ValueError):
        plan.resample(picture, out=np.zeros((6, 32, 32, 4), np.float32))
    fixed = np.zeros((6, 32, 32, 3), np.float32)
    fixed.flags.writeable = False
    with pytest.raises(ValueError):
        plan.resample(picture, out=fixed)
    with pytest.raises(TypeError):
        cubemap.Plan("equirect;size=8", "cube;size=8", filtr="ewa")


def test_surfaces(random):
    s = cubemap.Surface("cube:coupled;frame=gl;size=64")
    x, y, z = random.normal(size=(3, 1000))
    plane, column, row = s.positions(x, y, z)
    length = np.sqrt(x * x + y * y + z * z)
    assert np.abs(np.stack(s.directions(plane, column, row)) * length - np.stack((x, y, z))).max() < 1e-13
    face, u, v = cubemap.Mapping("coupled", "gl").forward(x, y, z)
    assert np.array_equal(face, plane) and np.abs((u + 1) * 32 - column).max() < 1e-13
    assert s.shape == (6, 64, 64) and s.plane_shape == (6, 64, 64)
    assert s.pixel(3, 5, 6) == (3, 5, 6)
    assert pickle.loads(pickle.dumps(s)) == s and eval(repr(s)) == s
    cross = cubemap.Surface("cube:coupled;size=16;layout=cross")
    assert len(cross.shape) == 2 and cross.plane_shape == (6, 16, 16) and cross != s
    kinds = [kind.identifier for kind in cubemap.surface_kinds()]
    assert "equirect" in kinds and "cube" in kinds and cubemap.surface_presets()
    with pytest.raises(cubemap.Error):
        cubemap.Surface("sphere")
    plan = cubemap.Plan(s, "equirect;size=64", filter="lanczos3", transfer="srgb")
    assert pickle.loads(pickle.dumps(plan)) == plan and "lanczos3" in repr(plan) and plan.to_text()


def test_values_in_directions():
    s = cubemap.Surface("equirect;size=256")
    x, y, z = s.directions(np.uint8(0), np.arange(256)[np.newaxis] + 0.5, np.arange(128)[:, np.newaxis] + 0.5)
    picture = np.stack((x, y, z), axis=-1).astype(np.float32)
    direction = np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.36, 0.48, -0.8]])
    assert np.abs(s.sample(picture, *direction.T, filter="catmull-rom") - direction).max() < 1e-4


def test_levels_and_borders(random):
    s = cubemap.Surface("cube:gnomonic;size=32")
    faces = random.random((6, 32, 32), dtype=np.float32)
    levels = cubemap.mips(s, faces)
    assert [level.shape for level in levels] == [(6, 2**k, 2**k) for k in range(5, -1, -1)] and np.array_equal(levels[0], faces)
    assert abs(levels[-1].mean() - faces.mean()) < 0.02
    wide = cubemap.border(s, faces, 3)
    assert wide.shape == (6, 38, 38) and np.array_equal(wide[:, 3:-3, 3:-3], faces)


@pytest.mark.parametrize("frame", ["geo", "gl", "fits", "s2"])
def test_drawings(frame, tmp_path):
    m = cubemap.Mapping("coupled", frame)
    x, y, z = cubemap.plot.directions_of(m, 16)
    for axes in (cubemap.plot.faces(z, m), cubemap.plot.graticule(m, step=30), cubemap.plot.indicatrices(m, count=3),
                 cubemap.plot.distortion(m, size=16, arrangement="row")):
        axes.figure.savefig(tmp_path / "drawing.png")
        assert plt.imread(tmp_path / "drawing.png")[..., :3].std() > 0.03  # something is drawn
        plt.close(axes.figure)


@pytest.mark.parametrize("frame", ["geo", "gl", "fits"])
def test_crosses_join(frame):
    """In a cross, the pictures of faces that touch go on: rows of z, whose steps inside are small."""
    m = cubemap.Mapping("coupled", frame)
    size = 64
    x, y, z = cubemap.plot.directions_of(m, size)
    places = cubemap.plot._PLACES[frame]
    joined = 0
    for one, (column, row) in enumerate(places):
        for other, place in enumerate(places):
            here = np.stack((x, y, z), axis=-1)
            if place == (column + 1, row):
                joined += 1
                assert np.abs(here[one][:, -1] - here[other][:, 0]).max() < 3 / size
            if place == (column, row + 1):
                joined += 1
                assert np.abs(here[one][0] - here[other][-1]).max() < 3 / size
    assert joined == 5


def test_a_size_that_is_missing_is_said():
    for specification in ("equirect", "cube:coupled"):
        with pytest.raises(cubemap.Error, match=f"'{specification}' has no size: {specification};size=512"):
            cubemap.Surface(specification)


def test_what_cannot_be_drawn_is_said():
    with pytest.raises(ValueError):
        cubemap.plot.faces(np.zeros((5, 4, 4)))
    with pytest.raises(ValueError):
        cubemap.plot.graticule(arrangement="star")


def test_pictures_of_the_other_byte_order():
    """As files of FITS have them."""
    picture = np.random.default_rng(19).random((16, 32, 3)).astype(np.float32)
    for kind in (np.float32, np.float16, np.uint16):
        given = (picture * 100).astype(kind) if kind == np.uint16 else picture.astype(kind)
        swapped = given.astype(given.dtype.newbyteorder())
        expected = cubemap.resample(given, "equirect", "cube:coupled;size=8")
        assert np.array_equal(cubemap.resample(swapped, "equirect", "cube:coupled;size=8"), expected)
