# SPDX-License-Identifier: MIT
"""cubemap.healpy beside healpy: 10^6 points each."""

import re

import cubemap
import numpy as np
import pytest
from cubemap import Healpix, healpy

reference = pytest.importorskip("healpy")
COUNT = 10**6
SIDES = [1, 64, 2**14, 2**29]
BOTH = pytest.mark.parametrize("nest", [False, True])


@pytest.fixture
def vectors(random):
    return random.normal(size=(3, COUNT))


def pixels(random, nside):
    return random.integers(0, 12 * nside**2, COUNT)


def close(got, expected, bound):
    return all(np.abs(one - other).max() <= bound for one, other in zip(got, expected, strict=True))


@BOTH
@pytest.mark.parametrize("nside", SIDES)
def test_points_to_pixels(nside, nest, vectors):
    theta, phi = healpy.vec2ang(vectors.T)
    assert np.array_equal(healpy.ang2pix(nside, theta, phi, nest), reference.ang2pix(nside, theta, phi, nest))
    assert np.array_equal(healpy.vec2pix(nside, *vectors, nest), reference.vec2pix(nside, *vectors, nest))
    lon, lat = healpy.vec2ang(vectors.T, lonlat=True)
    got, expected = healpy.ang2pix(nside, lon, lat, nest, True), reference.ang2pix(nside, lon, lat, nest, True)
    # degrees are rounded: at 2^29 pixels have 1e-9 rad, and some points in 10^6 are within 1e-15 of a border
    assert (got != expected).sum() <= (5 if nside == 2**29 else 0)


@BOTH
@pytest.mark.parametrize("nside", SIDES)
def test_pixels_to_points(nside, nest, random):
    pixel = pixels(random, nside)
    assert close(healpy.pix2ang(nside, pixel, nest), reference.pix2ang(nside, pixel, nest), 4e-15)
    assert close(healpy.pix2vec(nside, pixel, nest), reference.pix2vec(nside, pixel, nest), 4e-15)
    assert close(healpy.pix2ang(nside, pixel, nest, True), reference.pix2ang(nside, pixel, nest, True), 3e-13)


@pytest.mark.parametrize("nside", SIDES)
def test_orders(nside, random):
    pixel = pixels(random, nside)
    assert np.array_equal(healpy.nest2ring(nside, pixel), reference.nest2ring(nside, pixel))
    assert np.array_equal(healpy.ring2nest(nside, pixel), reference.ring2nest(nside, pixel))


@BOTH
@pytest.mark.parametrize("nside", [1, 2, 64, 2**29])
def test_neighbours(nside, nest, random):
    pixel = pixels(random, nside)
    assert np.array_equal(healpy.get_all_neighbours(nside, pixel, nest=nest), reference.get_all_neighbours(nside, pixel, nest=nest))


def test_neighbours_of_angles():
    assert np.array_equal(healpy.get_all_neighbours(8, 0.3, 0.4), reference.get_all_neighbours(8, 0.3, 0.4))


@BOTH
@pytest.mark.parametrize("nside", [1, 64, 2**29])
def test_boundaries(nside, nest, random):
    pixel = pixels(random, nside)[:COUNT // 64]  # 10^6 points with 16 steps a side
    assert np.abs(healpy.boundaries(nside, pixel, 16, nest) - reference.boundaries(nside, pixel, 16, nest)).max() < 4e-15
    assert healpy.boundaries(nside, int(pixel[0]), 2, nest).shape == (3, 8)


def test_vectors_and_angles(vectors):
    length = np.linalg.norm(vectors, axis=0)
    theta, phi = healpy.vec2ang(vectors.T)
    # healpy's arc cosine loses half of the digits at the poles: compared where it does not
    assert np.abs(theta - reference.vec2ang(vectors.T)[0])[np.abs(vectors[2] / length) < 0.99].max() < 1e-14
    assert np.abs(phi - reference.vec2ang(vectors.T)[1]).max() < 1e-15
    assert np.abs(healpy.ang2vec(theta, phi).T - vectors / length).max() < 1e-15
    lon, lat = np.degrees(phi), 90 - np.degrees(theta)
    assert np.abs(healpy.ang2vec(lon, lat, lonlat=True) - reference.ang2vec(lon, lat, lonlat=True)).max() < 1e-15
    for one in ((1, 2, 3), [0, 0, 1]):
        assert np.allclose(healpy.vec2ang(one), reference.vec2ang(np.array(one)))


def test_vectors_of_angles_are_within_rounding(random):
    """Beside the poles, too, whatever NumPy's sines are: those of its AVX-512 are off by 3 ulp, and healpy's vectors by 5."""
    theta = np.concatenate((random.uniform(0, np.pi, COUNT), 10.0 ** random.uniform(-300, 0, 1000), np.pi - 10.0 ** random.uniform(-16, 0, 1000),
                            np.radians(np.arange(181)), [0, 5e-324, np.pi / 2, np.nextafter(np.pi / 2, 0), np.nextafter(np.pi, 0), np.pi]))
    phi = random.permutation(np.concatenate((random.uniform(-10, 10, theta.size - 2000), 10.0 ** random.uniform(-300, 6, 1000),
                                             np.arange(-500, 500) * np.pi / 4)))
    got, other = healpy.ang2vec(theta, phi), reference.ang2vec(theta, phi)
    theta_long, phi_long = theta.astype(np.longdouble), phi.astype(np.longdouble)
    rho = np.sin(theta_long)
    truth = np.stack((rho * np.cos(phi_long), rho * np.sin(phi_long), np.cos(theta_long)), axis=-1)
    # sines and cosines are within 1.25 ulp, products of two within 2 * 1.25 + 0.5, whose ulp may be half of theirs
    error, ulp = np.abs(got - truth), np.spacing(np.abs(truth).astype(np.float64))
    assert error.max() < 3 * 2**-53 and np.abs(other - truth).max() < 9 * 2**-53
    assert (error[:, :2] <= 6 * ulp[:, :2]).all() and (error[:, 2] <= 1.25 * ulp[:, 2]).all()
    for k in (*range(0, theta.size, 997), *range(theta.size - 2187, theta.size)):
        assert healpy.ang2vec(theta[k].item(), phi[k].item()).tobytes() == got[k].tobytes()
    grid = healpy.ang2vec(theta[:4, np.newaxis], phi[:3])
    assert grid.shape == (4, 3, 3) and np.array_equal(grid[2, 1], healpy.ang2vec(theta[2], phi[1]))
    assert healpy.ang2vec([], []).shape == (0, 3) and healpy.ang2vec(np.float64(0.3), 1).shape == (3,)
    assert np.array_equal(healpy.ang2vec(theta[::-7].astype(">f8"), phi[::-7]), got[::-7])
    for refused in ((0.3, float("nan")), (0.3, -float("inf")), (float("nan"), 0.3), (-1e-9, 0.0), (np.ones(3), [0, 1, np.nan])):
        with pytest.raises(ValueError):
            healpy.ang2vec(*refused)


@pytest.mark.parametrize("options", [{}, {"pess": True}, {"power": -2}, {"order_in": "NEST"}, {"order_out": "NEST"},
                                     {"order_in": "RING", "order_out": "NEST", "dtype": np.float32}], ids=str)
@pytest.mark.parametrize("nside", [8, 128, 256, 512])
def test_ud_grade(nside, options, random):
    values = random.normal(size=12 * 256**2)  # 786,432
    if nside <= 256 or "power" not in options:
        values[random.integers(0, values.size, 1000)] = healpy.UNSEEN
    got, expected = healpy.ud_grade(values, nside, **options), reference.ud_grade(values, nside, **options)
    assert got.dtype == expected.dtype and np.array_equal(got == healpy.UNSEEN, np.abs(expected / healpy.UNSEEN - 1) < 1e-5) or \
        "dtype" in options
    assert (np.abs(got - expected) <= 1e-6 * np.maximum(1, np.abs(expected))).all()


def test_maps(random):
    values = random.normal(size=(2, 12 * 16**2)).astype(np.float32)
    assert np.array_equal(healpy.reorder(values, r2n=True), reference.reorder(values, r2n=True))
    assert np.array_equal(healpy.reorder(values[0], inp="NEST", out="RING"), reference.reorder(values[0], inp="NEST", out="RING"))
    assert healpy.ud_grade(values, 4).shape == (2, 192) and healpy.get_nside(values[0]) == 16
    whole = np.arange(12 * 16**2)
    assert healpy.ud_grade(whole, 32).dtype == reference.ud_grade(whole, 32).dtype


@BOTH
def test_discs(nest, random):
    found = 0
    while found < COUNT:
        nside = int(2 ** random.integers(0, 9))
        vector, radius = random.normal(size=3), random.choice([0.01, 0.3, 1, 3.2]) * random.random()
        got = healpy.query_disc(nside, vector, radius, nest=nest)
        assert np.array_equal(got, np.sort(reference.query_disc(nside, vector, radius, nest=nest)))
        found += max(got.size, 1)


@BOTH
def test_discs_with_all_that_overlaps(nest, random):
    for _ in range(60):
        nside, vector = int(2 ** random.integers(0, 7)), random.normal(size=3)
        radius = random.choice([1e-3, 0.1, 1, 3]) * random.random()
        got = healpy.query_disc(nside, vector, radius, inclusive=True, nest=nest)
        # points of the disc are in its pixels
        axis = np.cross(vector, random.normal(size=(500, 3)))
        axis /= np.linalg.norm(axis, axis=1)[:, np.newaxis]
        angle = radius * np.sqrt(random.random(500))[:, np.newaxis] * (1 - 1e-12)
        points = np.cos(angle) * vector / np.linalg.norm(vector) + np.sin(angle) * axis
        assert np.isin(healpy.vec2pix(nside, *points.T, nest), got).all()
        few = reference.query_disc(nside, vector, radius, inclusive=True, nest=nest)
        assert got.size <= few.size + 0.3 * few.size + 10


def test_discs_that_overlap_at_poles_and_where_belt_and_caps_meet(random):
    """The rings there have pixels of another shape; the rim's points are what is missed first."""
    for _ in range(200):
        nside, fact = int(random.integers(1, 300)), int(random.choice([1, 2, 4, 8]))
        height = random.choice([-1, -2 / 3, 2 / 3, 1]) * (1 - 10 ** random.uniform(-12, -1))
        lon, radius = random.uniform(-np.pi, np.pi), random.random() * 10 ** random.uniform(-1.5, 1) / nside
        vector = np.array([*np.sqrt(1 - height**2) * np.array([np.cos(lon), np.sin(lon)]), height])
        got = healpy.query_disc(nside, vector, radius, inclusive=True, fact=fact)
        turned = np.cross(vector, random.normal(size=(1000, 3)))
        rim = np.cos(radius) * vector + np.sin(radius) * turned / np.linalg.norm(turned, axis=1)[:, np.newaxis] * (1 - 1e-12)
        assert np.isin(healpy.vec2pix(nside, *rim.T), got).all() and (np.diff(got) > 0).all()
        assert np.isin(healpy.query_disc(nside, vector, radius), got).all()


def test_discs_in_both_orders(random):
    for _ in range(200):
        nside, vector, radius = int(2 ** random.integers(0, 12)), random.normal(size=3), 10 ** random.uniform(-4, 0)
        for inclusive in (False, True):
            ring, nested = (healpy.query_disc(nside, vector, radius, inclusive, nest=nest) for nest in (False, True))
            assert np.array_equal(np.sort(healpy.ring2nest(nside, ring)), nested)


def test_single_points_are_as_arrays_of_them(random):
    """Numbers of Python have ways of their own."""
    for nside, nest in ((1, True), (64, False), (2**29, True)):
        for pixel in (0, 3, 12 * nside**2 - 1, *random.integers(0, 12 * nside**2, 20).tolist()):
            assert np.array_equal(healpy.get_all_neighbours(nside, pixel, nest=nest),
                                  healpy.get_all_neighbours(nside, np.array([pixel]), nest=nest)[:, 0])
            assert np.array_equal(healpy.boundaries(nside, pixel, 3, nest), healpy.boundaries(nside, np.array([pixel]), 3, nest)[0])
            alone, among = healpy.pix2ang(nside, pixel, nest, True), healpy.pix2ang(nside, np.array([pixel]), nest, True)
            assert type(alone[0]) is float and alone == (among[0][0], among[1][0])
            assert nside > 64 or healpy.ang2pix(nside, *alone, nest, True) == pixel
        assert (healpy.get_all_neighbours(nside, -1, nest=nest) == -1).all()
    for theta, phi in random.random((50, 2)).tolist():
        assert np.array_equal(healpy.ang2vec(theta, phi), healpy.ang2vec(np.array([theta]), np.array([phi]))[0])
    assert np.isnan(healpy.pix2ang(8, -1, lonlat=True)).all()
    for lat in (90.001, float("nan"), float("inf")):
        with pytest.raises(ValueError):
            healpy.ang2pix(8, 10.0, lat, lonlat=True)
    for lon, lat in random.uniform(-90, 90, (50, 2)).tolist():
        assert healpy.ang2pix(1024, 8 * lon, lat, lonlat=True) == healpy.ang2pix(1024, np.array([8 * lon]), np.array([lat]), lonlat=True)[0]
    for what in (lambda: healpy.ang2vec(4.0, 0.0), lambda: healpy.boundaries(4, 192), lambda: healpy.boundaries(4, 0, 0),
                 lambda: healpy.query_disc(4, (0, 0, 0), 1), lambda: healpy.query_disc(4, (0, 1), 1),
                 lambda: healpy.query_disc(4, (0, 0, 1), -1), lambda: healpy.query_disc(4, (0, 0, 1), float("nan")),
                 lambda: healpy.query_disc(4, (0, np.inf, 1), 1), lambda: healpy.query_disc(3, (0, 0, 1), 1, nest=True)):
        with pytest.raises(ValueError):
            what()


def test_single_vectors_are_as_arrays_of_them(random):
    vectors = np.concatenate((random.normal(size=(1200, 3)), np.eye(3), -np.eye(3), [[1, -0.0, 0], [0, 0, 0], [np.nan, 1, 2]]))
    for lonlat in (False, True):
        first, second = healpy.vec2ang(vectors, lonlat=lonlat)
        lon, lat = cubemap.lonlat_from_direction(*vectors.T)  # by the ufunc
        lon = np.where(lon < 0, lon + 2 * np.pi, lon)
        expected = (np.degrees(lon), np.degrees(lat)) if lonlat else (np.pi / 2 - lat, lon)
        assert np.array_equal((first, second), expected, equal_nan=True)
        for k in range(1190, len(vectors)):
            for one in (vectors[k], vectors[k].tolist(), tuple(vectors[k])):
                got = healpy.vec2ang(one, lonlat=lonlat)
                assert got[0].shape == got[1].shape == (1,)
                assert np.array_equal(got, ([first[k]], [second[k]]), equal_nan=True)
        strided = np.asfortranarray(vectors)[::-1]
        assert np.array_equal(healpy.vec2ang(strided, lonlat), (first[::-1], second[::-1]), equal_nan=True)
    assert [one.shape for one in healpy.vec2ang(np.empty((0, 3)))] == [(0,), (0,)]
    assert np.array_equal(healpy.vec2ang(np.array([1, 2, 3], ">i2")), healpy.vec2ang((1.0, 2.0, 3.0)))
    with pytest.raises(ValueError, match="three numbers each"):
        healpy.vec2ang(np.ones(4))
    for lon, lat in random.uniform(-90, 90, (50, 2)).tolist():
        assert np.array_equal(healpy.ang2vec(8 * lon, lat, lonlat=True), healpy.ang2vec(np.array([8 * lon]), np.array([lat]), lonlat=True)[0])
    for refused in (90.01, float("nan")):
        with pytest.raises(ValueError):
            healpy.ang2vec(0.0, refused, lonlat=True)


def test_maps_of_the_same_resolution_are_copies(random):
    for kind in (np.float64, np.float32):
        values = random.normal(size=12 * 16**2).astype(kind)
        values[[3, 700, 3071]] = healpy.UNSEEN, np.nan, np.inf
        values[5] = healpy.UNSEEN * (1 + 9e-6)  # healpy's own tolerance of what is UNSEEN
        before = values.copy()
        for options in ({}, {"order_in": "NEST"}, {"order_in": "NEST", "power": 2}, {"pess": True}):
            got = healpy.ud_grade(values, 16, **options)
            expected = np.where(np.isin(np.arange(values.size), (3, 5, 700, 3071)), kind(healpy.UNSEEN), values)
            assert got.dtype == kind and np.array_equal(got, expected) and not np.shares_memory(got, values)
        assert np.array_equal(values, before, equal_nan=True)


def test_boundaries_lie_together():
    """Nobody has to copy them."""
    unsigned = np.array([1, 2], np.uint64)
    assert np.array_equal(healpy.boundaries(64, unsigned), healpy.boundaries(64, [1, 2]))
    assert np.array_equal(healpy.boundaries(64, unsigned[0]), healpy.boundaries(64, 1)) and healpy.boundaries(64, []).shape == (0, 3, 4)
    for refused in ([1.5, 2.0], [-1], [12 * 64**2], np.arange(4).reshape(2, 2), np.array([2**64 - 1], np.uint64)):
        with pytest.raises((ValueError, TypeError)):
            healpy.boundaries(64, refused)
    assert healpy.boundaries(64, np.empty(0, int)).shape == (0, 3, 4) and healpy.boundaries(64, np.array(3)).shape == (3, 4)
    outline = Healpix(64).boundary(1234, 5)
    assert outline.shape == (20, 3) and outline.flags.c_contiguous
    assert healpy.boundaries(64, 1234, 5).flags.c_contiguous and np.array_equal(healpy.boundaries(64, 1234, 5), outline.T)


def test_discs_around_a_pole_and_at_great_resolutions():
    everything = np.arange(192)
    for vector in ((0, 0, 1), (0, 0, -2), (1e-12, 0, 1)):
        assert np.array_equal(healpy.query_disc(4, vector, 3.2), everything)
        assert np.array_equal(healpy.query_disc(4, vector, np.pi), everything)
        assert np.array_equal(healpy.query_disc(1024, vector, 0.002), np.sort(reference.query_disc(1024, np.array(vector), 0.002)))
    # healpy's own cosines do not tell such angles from each other: chords do
    nside, vector = 2**29, np.array([0.3, -0.5, 0.4])
    pixels = healpy.query_disc(nside, vector, 5e-9)
    vectors = np.array(healpy.pix2vec(nside, pixels))
    assert pixels.size == pytest.approx(np.pi * 5e-9**2 / healpy.nside2pixarea(nside), rel=0.2)
    assert np.linalg.norm(vectors.T - vector / np.linalg.norm(vector), axis=1).max() < 5.001e-9


def test_discs_of_any_length_of_their_vector():
    vector = np.array([0.5, -0.25, 0.125])
    for length in (2.0**-1060, 2.0**-540, 2.0**540, 2.0**1000):
        assert np.array_equal(healpy.query_disc(64, length * vector, 0.3), healpy.query_disc(64, vector, 0.3))
    for refused in (np.inf * vector, 0 * vector, [np.nan, 0, 1]):
        with pytest.raises(ValueError):
            healpy.query_disc(64, refused, 0.3)


def test_a_disc_of_more_than_there_is_needs_no_rings():
    with pytest.raises((MemoryError, ValueError)):
        healpy.query_disc(2**29, (0, 0, 1), 4.0)


def test_discs_of_half_a_turn_have_all():
    for nside in (1, 2, 5, 16):
        for pixel in range(12 * nside**2):
            around = -np.array(healpy.pix2vec(nside, pixel))
            assert healpy.query_disc(nside, around, np.pi).size == 12 * nside**2


def test_what_is_left_out_is_named():
    """All of healpy's functions of pixels and masks that are not here; those that draw, read and write, and of harmonics need no name."""
    of_pixels = {f"healpy.{name}" for name in ("pixelfunc", "rotator", "_query_disc", "_pixelfunc", "_masktools", "_hotspots")}
    lacking = {name for name in dir(reference) if getattr(getattr(reference, name), "__module__", "") in of_pixels and not hasattr(healpy, name)}
    assert "get_interp_val" in lacking and "query_strip" in lacking
    assert lacking <= set(re.findall(r"\w+", healpy.__doc__)), lacking


def test_many_turns():
    """Beside cosines and sines that know pi to all digits, as NumPy's."""
    lon = 1e12 * np.linspace(-1, 1, 1000)
    exact = healpy.vec2pix(256, np.cos(lon), np.sin(lon), np.full(1000, 0.1))
    assert np.array_equal(healpy.ang2pix(256, np.full(1000, np.arctan2(1, 0.1)), lon), exact)
    assert not np.array_equal(reference.ang2pix(256, np.full(1000, np.arctan2(1, 0.1)), lon), exact)


def test_texts_and_short_integers_are_refused():
    for what in (lambda: healpy.vec2ang(["1", "2", "3"]), lambda: healpy.vec2ang(np.array([1j, 2, 3])),
                 lambda: healpy.query_disc(8, ["1", "0", "0"], 0.1), lambda: healpy.ang2vec("1", "2"), lambda: healpy.ang2vec(0.1, ["2"])):
        with pytest.raises(TypeError, match="real numbers"):
            what()
    with pytest.raises(ValueError, match="int64"):
        healpy.query_disc(64, (1, 0, 0), 0.2, buff=np.empty(3000, np.int16))
    buff = np.empty(3000, np.int64)
    assert np.array_equal(healpy.query_disc(64, (1, 0, 0), 0.2, buff=buff), healpy.query_disc(64, (1, 0, 0), 0.2))


def test_arguments_of_discs():
    vector = np.array([1, 2, 3])
    expected = healpy.query_disc(8, vector, 0.3, inclusive=True, fact=4)
    assert np.array_equal(healpy.query_disc(8, vector.astype(object), 0.3, inclusive=True, fact=np.int64(4)), expected)
    for fact in (0, -1, 2**20 + 1):
        with pytest.raises(ValueError, match="fact: 1 to 2\\^20"):
            healpy.query_disc(8, vector, 0.3, inclusive=True, fact=fact)
    assert np.array_equal(healpy.boundaries(8, 3, step=np.int64(2)), healpy.boundaries(8, 3, step=2))


def test_sizes():
    for nside in (1, 2, 256, 2**20):
        for name in ("nside2npix", "nside2pixarea", "nside2resol", "max_pixrad", "nside2order"):
            assert getattr(healpy, name)(nside) == pytest.approx(getattr(reference, name)(nside), rel=1e-13), name
        assert healpy.npix2nside(12 * nside**2) == nside and healpy.isnpixok(12 * nside**2)
    assert healpy.order2nside(5) == 32 and healpy.npix2order(healpy.order2npix(4)) == 4
    assert healpy.nside2resol(64, arcmin=True) == pytest.approx(reference.nside2resol(64, arcmin=True))
    assert healpy.isnsideok(3) and not healpy.isnsideok(3, nest=True) and not healpy.isnsideok(0)
    assert healpy.isnsideok(np.array([1, 3, 0]), True).tolist() == [True, False, False]


def test_arrays_of_resolutions(random):
    nside = 2 ** random.integers(0, 10, 1000)
    theta, phi = random.uniform(0, np.pi, 1000), random.uniform(0, 7, 1000)
    pixel = healpy.ang2pix(nside, theta, phi)
    assert np.array_equal(pixel, reference.ang2pix(nside, theta, phi))
    assert close(healpy.pix2ang(nside, pixel), reference.pix2ang(nside, pixel), 4e-15)


def test_what_is_refused_and_what_is_none():
    for bad in (-0.1, np.pi + 1e-3, np.nan):
        with pytest.raises(ValueError):
            healpy.ang2pix(8, bad, 0.0)
        with pytest.raises(ValueError):
            healpy.ang2pix(8, np.array([0.1, bad]), 0.0)
    assert healpy.ang2pix(8, np.pi + 1e-6, 0.0) == reference.ang2pix(8, np.pi + 1e-6, 0.0)
    with pytest.raises(ValueError):
        healpy.ang2pix(3, 0.1, 0.1, nest=True)
    with pytest.raises(ValueError):
        healpy.vec2pix(8, 0.0, 0.0, 0.0)
    assert np.isnan(healpy.pix2ang(8, 12 * 64)).all() and np.isnan(healpy.pix2ang(8, np.array([-1]))).all()


@BOTH
def test_resolutions_that_are_arrays_of_no_dimension(nest):
    for nside in (np.array(4), np.int64(4), np.uint8(4)):
        assert healpy.ang2pix(nside, 0.3, 0.4, nest) == reference.ang2pix(4, 0.3, 0.4, nest)
        assert healpy.pix2ang(nside, 5, nest) == healpy.pix2ang(4, 5, nest)
        assert healpy.vec2pix(nside, 1, 0.2, 0.3, nest) == reference.vec2pix(4, 1, 0.2, 0.3, nest)
        assert np.array_equal(healpy.get_all_neighbours(nside, [5, 6], nest=nest), reference.get_all_neighbours(4, [5, 6], nest=nest))
        assert np.array_equal(healpy.boundaries(nside, 5, 3, nest), healpy.boundaries(4, 5, 3, nest))
        assert np.array_equal(healpy.query_disc(nside, (1, 0, 0), 0.5, nest=nest), reference.query_disc(4, (1, 0, 0), 0.5, nest=nest))
        assert healpy.nest2ring(nside, 7) == reference.nest2ring(4, 7) and healpy.max_pixrad(nside) == healpy.max_pixrad(4)
    found, expected = healpy.max_pixrad([[4], [8]]), reference.max_pixrad(np.array([[4], [8]]))
    assert found.shape == (2, 1) and np.allclose(found, expected, rtol=1e-13)


def test_maps_of_other_numbers(random):
    """Of files of FITS, complex ones, objects, and with a mask."""
    values = random.normal(size=768)
    for kind in (">f8", ">f4", ">i4"):
        swapped = (100 * values).astype(kind)
        for one in (healpy.ud_grade(swapped, 4), healpy.reorder(swapped, r2n=True)):
            assert one.dtype.isnative and one.dtype == swapped.dtype.newbyteorder("=")
        assert np.array_equal(healpy.reorder(swapped, n2r=True), reference.reorder(swapped, n2r=True))
    assert healpy.ud_grade(values.astype(object), 4).dtype == np.float64
    both = values + 1j * random.normal(size=768)
    both[[3, 700]] = healpy.UNSEEN
    for options in ({"nside_out": 4}, {"nside_out": 16}, {"nside_out": 4, "pess": True}, {"nside_out": 4, "order_in": "NEST", "order_out": "RING"}):
        assert np.allclose(healpy.ud_grade(both, **options), reference.ud_grade(both, **options), rtol=1e-12)
    assert np.isclose(healpy.ud_grade(both, 4, power=2)[50], reference.ud_grade(both, 4, power=2)[50])
    with pytest.raises(TypeError):
        Healpix(8).regrade(both, Healpix(4))
    masked = np.ma.masked_array(values, values > 1)
    filled = np.where(values > 1, healpy.UNSEEN, values)
    for nside in (4, 8, 16):
        assert np.array_equal(healpy.ud_grade(masked, nside), healpy.ud_grade(filled, nside))
    assert np.array_equal(healpy.ud_grade(np.ma.masked_array(np.arange(768), np.arange(768) < 4), 16), healpy.ud_grade(
        np.where(np.arange(768) < 4, healpy.UNSEEN, np.arange(768)), 16))
    assert np.array_equal(healpy.reorder(masked, r2n=True).filled(healpy.UNSEEN), reference.reorder(filled, r2n=True))
    assert np.array_equal(healpy.reorder(values, r2n=True, n2r=True), reference.reorder(values, r2n=True, n2r=True))
    pixels = np.ma.masked_array([1, 2], [True, False])
    assert np.array_equal(healpy.get_all_neighbours(16, pixels), healpy.get_all_neighbours(16, [1, 2]))


def test_what_is_no_map_and_no_pixel():
    for none in (5, None, "abc", {1: 2}):
        for what in (healpy.get_nside, healpy.get_map_size):
            with pytest.raises(TypeError, match="a map is an array"):
                what(none)
    for none in (1.5, "1", None, [1.0, 2.0]):
        with pytest.raises(ValueError, match="whole numbers"):
            healpy.boundaries(16, none)


NSIDES = pytest.mark.parametrize("nside", [8, np.array([8]), np.array([2, 4, 8]), [2, 4, 8], np.array([[2], [4]])], ids=repr)


@NSIDES
@BOTH
def test_masks_come_along_with_resolutions_that_are_arrays(nside, nest):
    pixel = np.ma.masked_array([1, 2, 3], [False, True, False])
    angle = np.ma.masked_array([0.1, 0.2, 0.3], [False, True, False])
    for name, arguments in (("pix2ang", (pixel, nest)), ("pix2ang", (pixel, nest, True)), ("pix2vec", (pixel, nest)),
                            ("ang2pix", (angle, 0.3, nest)), ("ang2pix", (0.3, angle, nest, True)), ("vec2pix", (angle, angle, 1.0, nest))):
        found = [getattr(module, name)(nside, *arguments) for module in (healpy, reference)]
        for one, theirs in zip(*found, strict=True) if name.startswith("pix") else [found]:
            assert type(one) is np.ma.MaskedArray and np.array_equal(one.mask, theirs.mask) and np.ma.allclose(one, theirs)
    # what has no mask: not the neighbours of what is under one, in other units
    found = healpy.get_all_neighbours(nside, np.rad2deg(angle), np.rad2deg(angle), nest=nest, lonlat=True)
    wanted = healpy.get_all_neighbours(nside, np.rad2deg(angle.data), np.rad2deg(angle.data), nest=nest, lonlat=True)
    assert type(found) is np.ndarray and np.array_equal(found, wanted)
    nside = np.ma.masked_array(np.broadcast_to(nside, 3) if np.ndim(nside) < 2 else nside, np.arange(np.size(nside)) == 1)
    assert type(healpy.get_all_neighbours(nside, 1)) is np.ndarray


@BOTH
def test_no_pixels_of_resolutions_that_are_arrays(nest):
    for nside, pixel in ((np.array([8]), np.array([], int)), (np.array([[2], [4]]), np.array([], int)), ([8], np.empty((0, 1), int))):
        for name in ("pix2ang", "pix2vec", "get_all_neighbours"):
            ours, theirs = (np.array(getattr(module, name)(nside, pixel, nest=nest)) for module in (healpy, reference))
            assert ours.shape == theirs.shape and ours.dtype == theirs.dtype
        assert healpy.nest2ring(nside, pixel).shape == reference.nest2ring(nside, pixel).shape
        assert healpy.ang2pix(nside, pixel / 2, pixel / 2, nest).dtype == np.int64
    for module in (healpy, reference):
        with pytest.raises(ValueError):
            module.pix2ang(np.array([0]), np.array([], int), nest)


@pytest.mark.parametrize("module", [healpy, reference], ids=["ours", "theirs"])
def test_kinds_of_errors(module):
    for nside in ("8", ["8"]):
        for call in (module.isnsideok, module.nside2pixarea, lambda nside: module.pix2ang(nside, 3)):
            with pytest.raises(TypeError):
                call(nside)
    for npix in (47, 0):
        with pytest.raises(TypeError):
            module.get_nside(np.zeros(npix))
    for call in (lambda values: module.ud_grade(values, 4), lambda values: module.reorder(values, r2n=True)):
        with pytest.raises(TypeError):
            call(np.zeros(47))
    with pytest.raises(ValueError):
        module.boundaries(np.array([8, 8]), 3)
    assert module.boundaries(np.array([8]), 3).shape == (3, 4)
    assert module.query_disc(np.array([8]), (1, 0, 0), 0.3).dtype == np.int64


def test_rings_and_pixels():
    hp = Healpix(7)
    assert [hp.ring_info(ring).first for ring in (1, 2)] == [0, 4] and hp.ring_count == 27
    ring, index = hp.ring_from_pixel(np.arange(hp.pixel_count))
    assert ring.max() == 27 and np.array_equal(ring, reference.pix2ring(7, np.arange(hp.pixel_count)))
    assert index[:5].tolist() == [0, 1, 2, 3, 0]
    assert hp.regrade(np.ones(hp.pixel_count), Healpix(7)).sum() == hp.pixel_count
