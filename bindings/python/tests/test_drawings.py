# SPDX-License-Identifier: MIT
"""Drawings: one scale of colours for all faces, and what of imshow's can be said otherwise."""

import matplotlib
import numpy as np
import pytest

matplotlib.use("Agg")
import cubemap.plot  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import LogNorm, Normalize  # noqa: E402

RISING = np.arange(1.0, 6 * 16 + 1).reshape(6, 4, 4)


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def limits(axes):
    return {(image.norm.vmin, image.norm.vmax) for image in axes.images}


@pytest.mark.parametrize("norm", [LogNorm, Normalize, lambda: LogNorm(2, 50)])
def test_a_norm_of_the_users(norm):
    own = norm()
    axes = cubemap.plot.faces(RISING, norm=own)
    axes.figure.canvas.draw()
    assert all(image.norm is own for image in axes.images) and limits(axes) == {(2, 50) if norm().vmin else (1, 96)}
    axes = cubemap.plot.distortion("gnomonic", "area", size=8, norm=LogNorm())
    axes.figure.canvas.draw()
    assert len(limits(axes)) == 1


@pytest.mark.parametrize("pictures", [RISING, RISING[..., np.newaxis], RISING.astype(int), np.where(RISING == 96, np.inf, RISING),
                                      np.where(RISING == 50, np.nan, RISING), np.ma.masked_greater(RISING, 90)],
                         ids=["numbers", "channel", "whole", "infinite", "none", "masked"])
def test_faces_have_one_scale(pictures):
    axes = cubemap.plot.faces(pictures)
    axes.figure.canvas.draw()
    finite = np.ma.masked_invalid(pictures)
    assert limits(axes) == {(finite.min(), finite.max())}


@pytest.mark.filterwarnings("error")
def test_faces_without_a_number():
    for none in (np.full((6, 4, 4), np.nan), np.ma.masked_all((6, 4, 4))):
        assert len(cubemap.plot.faces(none).images) == 6


def test_pixels_may_be_smooth():
    axes = cubemap.plot.faces(RISING, interpolation="bilinear")
    assert {image.get_interpolation() for image in axes.images} == {"bilinear"}
    assert {image.get_interpolation() for image in cubemap.plot.faces(RISING).images} == {"nearest"}


def test_the_bar_is_of_what_was_drawn_last():
    axes = cubemap.plot.faces(RISING)
    cubemap.plot.distortion("coupled", "area", size=8, axes=axes)
    bar = axes.figure.axes[-1]
    assert bar.get_ylim() == pytest.approx((axes.images[-1].norm.vmin, axes.images[-1].norm.vmax)) and bar.get_ylim()[1] < 2


def test_what_cannot_be_drawn_is_said():
    for take, words in [(lambda: cubemap.plot.distortion("coupled", "angle"), "quantity: 'angle' is none of major, "),
                        (lambda: cubemap.plot.distortion("coupled", size=0), "size: more than 0, not 0"),
                        (lambda: cubemap.plot.graticule("coupled", step=0), "step: more than 0, not 0"),
                        (lambda: cubemap.plot.graticule("coupled", step=float("nan")), "step: more than 0, not nan"),
                        (lambda: cubemap.plot.indicatrices("coupled", count=-1), "count: more than 0, not -1"),
                        (lambda: cubemap.plot.faces(np.ones((5, 4, 4))), r"pictures: \(6, rows, columns\[, channels\]\), not \(5, 4, 4\)"),
                        (lambda: cubemap.plot.faces(5), r"not \(\)")]:
        with pytest.raises(ValueError, match=words):
            take()
