# SPDX-License-Identifier: MIT
"""Advice, plans as text, panoramas, and what else is called once."""

import pickle

import cubemap
import numpy as np
import pytest


def test_the_cheapest_that_keeps_limits_is_first():
    costs = [("gnomonic", "double", (1.0, 1.0)), ("coupled", "double", (4.0, 5.0)), ("seamless", "double", (9.0, 9.0))]
    found = cubemap.advise(costs, {"area error": 0.1, "cost": 8.0} if "cost" in cubemap.LIMITS else {"area error": 0.1})
    assert len(found) == 3 and found[0].specification == "coupled" and found.qualified >= 1 and found[0].reason == ""
    last = next(one for one in found if one.specification == "gnomonic")
    assert "area error" in last.missed and "area error" in last.reason and last.values["area error"] == pytest.approx(1.7, abs=0.1)
    exact = cubemap.advise(costs, equal_area=True, ellipsoid="WGS84")
    assert [one.specification for one in exact][:exact.qualified] == ["seamless"] and exact[0].latitude == "authalic"
    with pytest.raises(ValueError):
        cubemap.advise(costs, {"beauty": 1})
    with pytest.raises(cubemap.Error):
        cubemap.advise([("nothing",)])


def test_plans_as_text(random):
    picture = random.random((32, 64, 3), dtype=np.float32)
    plan = cubemap.Plan(cubemap.Surface("equirect;size=64", rotation="10,20,30"), "cube:coupled;size=16", filter="lanczos3",
                        transfer="srgb")
    again = cubemap.Plan.from_text(plan.to_text())
    assert np.array_equal(again.resample(picture), plan.resample(picture)) and again.to_text() == plan.to_text()
    assert np.array_equal(pickle.loads(pickle.dumps(again)).resample(picture), plan.resample(picture))
    assert plan.filter_of(picture) == "lanczos3"
    assert cubemap.Plan("equirect;size=64", "cube:coupled;size=16").filter_of(picture) in cubemap.FILTERS[1:]
    with pytest.raises(cubemap.Error):
        cubemap.Plan.from_text("cubemap-plan 1\n")


def test_surfaces_know_their_mapping():
    assert cubemap.Surface("cube:tangent:c=1.1823;frame=gl;size=8").mapping == cubemap.Mapping("tangent:c=1.1823", "gl")
    assert cubemap.Surface("equirect;size=8").mapping is None


def test_maps_of_healpix_as_pictures(random):
    values = random.random(12 * 8 * 8, dtype=np.float32)
    for order in ("ring", "nested"):
        picture = cubemap.healpix_arrange(values, 8, order)
        assert picture.shape == (8, 96) and np.array_equal(cubemap.healpix_arrange(picture, 8, order, to_list=True), values)
        surface = cubemap.Surface("healpix:8")
        hp = cubemap.Healpix(8, order)
        x, y, z = hp.direction_from_pixel(np.arange(hp.pixel_count))
        assert np.allclose(surface.sample(picture, x, y, z, filter="nearest")[:, 0], values)


def test_panoramas():
    panorama = cubemap.Panorama(4000, 2000, 1000, 500, 2000, 1000, heading=90.0)
    again = cubemap.Panorama.read(panorama.write())
    assert again == panorama
    surface = panorama.surface(2000, 1000)
    assert surface.shape == (1000, 2000) and surface.rotation is not None
    whole = cubemap.Panorama.of_surface(cubemap.Surface("equirect;size=400"))
    assert (whole.full_width, whole.full_height) == (400, 200)
    with pytest.raises(cubemap.Error):
        cubemap.Panorama.read("nothing of the kind")
    with pytest.raises(cubemap.Error):
        panorama._replace(cropped_left=3500).write()


def test_errors_by_rows(random):
    one, other = random.random((2, 30, 20, 3), dtype=np.float32)
    errors = cubemap.Errors(3, peak=1.0)
    for first in range(0, 30, 7):
        errors.add(one[first:first + 7], other[first:first + 7])
    whole = cubemap.compare_errors(one, other, peak=1.0)
    assert errors.get().mse == pytest.approx(whole.mse) and errors.get().pixels == 600
    assert errors.get(1).mse == pytest.approx(((one - other)[..., 1].astype(float) ** 2).mean(), rel=1e-6)
    values = cubemap.compare_values(one.reshape(-1, 3), other.reshape(-1, 3), peak=1.0)
    assert values.mse == pytest.approx(whole.mse)


def test_what_kernels_take():
    constants, terms = cubemap.LatitudeConversion("geographic", "authalic").constants
    assert constants.shape == (13,) and terms in (3, 6, 12) and constants[0] != 0
    assert cubemap.LatitudeConversion("geographic", "geocentric").constants[1] == 0
    table = cubemap.brdf_table(4, 3, channels=3)
    scale, bias = cubemap.brdf_integrate(0, (np.arange(4) + 0.5) / 4, ((np.arange(3) + 0.5) / 3)[:, np.newaxis])
    assert np.allclose(table[..., 0], scale, atol=1e-6) and np.allclose(table[..., 1], bias, atol=1e-6)
    assert np.allclose(table.sum(axis=-1), 1, atol=1e-6)
