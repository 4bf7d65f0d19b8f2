# SPDX-License-Identifier: MIT
"""Comparisons of pictures, and environments."""

import cubemap
import numpy as np
import pytest


def test_errors(random):
    one = random.integers(0, 256, (40, 80, 3)).astype(np.uint8)
    other = np.clip(one.astype(int) + random.integers(-9, 10, one.shape), 0, 255).astype(np.uint8)
    error = (other.astype(float) - one) / 255
    figures = cubemap.compare_errors(one, other)
    assert figures.mse == pytest.approx((error**2).mean()) and figures.largest == pytest.approx(np.abs(error).max())
    assert figures.psnr == pytest.approx(-10 * np.log10((error**2).mean())) and figures.pixels == 3200
    weights = cubemap.equirect_weights(80, 40)
    assert weights.sum() * 80 == pytest.approx(4 * np.pi, rel=1e-6)
    weighted = cubemap.compare_errors(one, other, weights=weights)
    assert weighted.mse == pytest.approx((error**2 * weights[:, np.newaxis, np.newaxis]).sum() / weights.sum() / 240, rel=1e-6)
    assert np.allclose(cubemap.difference_map(one, other), np.abs(error).max(axis=2))
    assert cubemap.psnr(0.01, 1.0) == pytest.approx(20)
    with pytest.raises(cubemap.Error):
        cubemap.compare_errors(one, other[:10])
    with pytest.raises(cubemap.Error):
        cubemap.compare_errors(np.full((4, 4), np.nan, np.float32), np.zeros((4, 4), np.float32))


def test_what_is_seen(random):
    one = random.random((64, 64, 3), dtype=np.float32)
    for measure, none in ((cubemap.ssim, 1.0), (cubemap.flip, 0.0), (cubemap.flip_hdr, 0.0)):
        figures, values = measure(one, one)
        assert figures.mean == pytest.approx(none, abs=1e-6) and values.shape == (64, 64)
        figures, values = measure(one, np.clip(one + 0.2, 0, 1))
        assert abs(figures.mean - none) > 0.02 and np.mean(values) == pytest.approx(figures.mean, rel=1e-5)


def test_solid_angles():
    assert cubemap.texel_solid_angles("tangent", 32).sum() == pytest.approx(4 * np.pi)
    assert cubemap.face_weights("seamless", 16).sum() == pytest.approx(4 * np.pi / 6, rel=1e-6)
    x, y, z = cubemap.sphere_points(1000)
    assert np.abs(x * x + y * y + z * z - 1).max() < 1e-15 and abs(z.mean()) < 1e-12


def test_harmonics(random):
    x, y, z = random.normal(size=(3, 500))
    coefficients = random.normal(size=(16, 2))
    value = cubemap.harmonics_evaluate(coefficients, x, y, z)
    assert np.allclose(value, cubemap.harmonics_basis(3, x, y, z) @ coefficients)
    r = cubemap.Rotation("10,20,30")
    turned = cubemap.harmonics_rotate(coefficients, r)
    directions = r.apply(np.stack((x, y, z), axis=-1))
    assert np.allclose(cubemap.harmonics_evaluate(turned, *directions.T), value)
    assert cubemap.harmonics_cosine_lobe(2)[0] == pytest.approx(np.pi) and cubemap.harmonics_ggx_lobe(4, 0.5)[0] == pytest.approx(1)
    faces = cubemap.harmonics_faces(coefficients, "coupled", 64)
    environment = cubemap.Environment("coupled", faces)
    assert (environment.size, environment.channels) == (64, 2) and environment.level_count == 7
    assert np.abs(environment.project(3) - coefficients).max() < 1e-2
    lobe = cubemap.harmonics_cosine_lobe(3)
    fast = cubemap.harmonics_faces(cubemap.harmonics_scale(coefficients, lobe), "coupled", 8)
    assert np.abs(environment.irradiance("coupled", 8) - fast).max() < 0.02 * np.abs(fast).max()
    assert np.abs(environment.prefilter(0.0, "coupled", 64) - faces).max() < 0.05
    assert '"degree":3' in cubemap.harmonics_json(coefficients).replace(" ", "")
