# SPDX-License-Identifier: MIT
"""Numbers with units: angles in any unit of angle, and an error with the way out for what has another."""

import cubemap
import numpy as np
import pytest
from cubemap import healpy

units = pytest.importorskip("astropy.units")
mapping = cubemap.Mapping("coupled")
LON, LAT = np.array([0.2, -3.0, 1.5]), np.array([0.5, -1.25, 0.0])


def alike(one, other):
    return all(map(np.array_equal, one, other)) if isinstance(one, tuple) else np.array_equal(one, other)


@pytest.mark.parametrize("unit", ["rad", "deg", "arcmin", "hourangle"])
def test_angles_have_any_unit_of_angle(unit):
    """The numbers are those of radians."""
    lon, lat = ((one * units.rad).to(unit) for one in (LON, LAT))
    numbers = lon.to_value("rad"), lat.to_value("rad")
    for function in (mapping.forward_lonlat, cubemap.Grid("coupled").forward_lonlat, cubemap.direction_from_lonlat):
        assert alike(function(lon, lat), function(*numbers))
    assert alike(mapping.forward_lonlat(lon[0], numbers[1][0]), mapping.forward_lonlat(numbers[0][0], numbers[1][0]))
    pixels = cubemap.Healpix(64).pixel_from_lonlat(lon, lat)
    assert alike(pixels, cubemap.Healpix(64).pixel_from_lonlat(*numbers))
    assert alike(healpy.ang2pix(64, 0.5 * np.pi - numbers[1], numbers[0]), healpy.ang2pix(64, (90 * units.deg - lat), lon))
    convert = cubemap.LatitudeConversion("geographic", "authalic").convert
    assert alike(convert(lat), convert(numbers[1]))


def test_numbers_without_unit_stay():
    """A direction of a unit vector has the unit of none; results and out= are numbers."""
    x, y, z = np.random.default_rng(1).normal(size=(3, 10))
    none = units.dimensionless_unscaled
    assert alike(mapping.forward(x * none, y * none, z * none), mapping.forward(x, y, z))
    assert alike(mapping.forward_jacobian(x * none, y, z), mapping.forward_jacobian(x, y, z))
    out = np.empty(10, np.uint8), np.empty(10), np.empty(10)
    assert mapping.forward(x * none, y, z, out=out)[1] is out[1]
    assert alike(out, mapping.forward(x, y, z))


def test_other_units_are_refused_with_the_way_out():
    """One line that says which argument, and what to write."""
    with pytest.raises(TypeError, match=r"^lat: an angle, not a quantity of m; \.to_value\('m'\) has its number$"):
        mapping.forward_lonlat(0.1, LAT * units.m)
    with pytest.raises(TypeError, match=r"^x: a number without unit, not a quantity of kpc; \.to_value\('kpc'\)"):
        mapping.forward(LON * units.kpc, LAT * units.kpc, LAT * units.kpc)
    with pytest.raises(TypeError, match="^out: an array of numbers, not a quantity$"):
        cubemap.direction_from_lonlat(LON, LAT, out=(LON * units.m, LON, LON))


def test_other_errors_are_their_own():
    """What is wrong without units says what NumPy says."""
    with pytest.raises(TypeError, match="ufunc 'forward' not supported"):
        mapping.forward(np.ma.array(["a"]), 1.0, 2.0)
