# SPDX-License-Identifier: MIT
"""Masked pictures: a result is masked where a masked pixel takes part in it, and is what it was elsewhere."""

import cubemap
import numpy as np
import pytest
from cubemap import large

ONE, OTHER = "equirect;size=64", "cube:coupled;size=16"


def earth(dtype=np.float32, channels=()):
    """A picture of which a part is masked, with numbers under the mask that show if they are used."""
    rng = np.random.default_rng(3)
    numbers = rng.uniform(0, 1, (32, 64, *channels))
    numbers = (255 * numbers).astype(dtype) if np.dtype(dtype).kind == "u" else numbers.astype(dtype)
    mask = np.zeros(numbers.shape, bool)
    mask[10:14, 20:40] = True
    return np.ma.array(numbers, mask=mask)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float16, np.float32])
@pytest.mark.parametrize("filter", ["nearest", "bilinear", "lanczos3", "ewa", "auto"])
def test_a_mask_comes_along(dtype, filter):
    """What is under the mask changes nothing that is seen; what touches the mask is masked, the rest has the same bits."""
    picture = earth(dtype)
    plan = cubemap.Plan(ONE, OTHER, filter=filter)
    found = plan.resample(picture)
    assert isinstance(found, np.ma.MaskedArray) and found.dtype == dtype
    assert 0 < found.mask.sum() < found.size / 2
    other = picture.copy()
    other.data[other.mask] = 1 if np.dtype(dtype).kind == "f" else 200
    with_other = cubemap.Plan(ONE, OTHER, filter=plan.filter_of(picture)).resample(other)
    assert np.array_equal(found.mask, with_other.mask)
    assert np.array_equal(found.compressed(), with_other.compressed())
    if filter != "auto":  # which takes splines here: they look at all pixels
        bare = plan.resample(picture.data)
        assert np.array_equal(found.compressed(), bare[~found.mask])


def test_channels_have_masks_of_their_own():
    """Each channel its own; of a picture with opacity the whole pixel is masked."""
    picture = earth(channels=(4,))
    picture.mask[..., 1:] = False
    found = cubemap.resample(picture, ONE, OTHER, filter="bilinear")
    assert found.mask[..., 0].any() and not found.mask[..., 1:].any()
    found = cubemap.resample(picture, ONE, OTHER, filter="bilinear", alpha=4)
    assert found.mask.any() and np.array_equal(found.mask.all(axis=-1), found.mask.any(axis=-1))


def test_what_is_masked_may_be_left_out():
    """not_finite says what is done with no data: skipped, the mask shrinks to where nothing is left; as zero there is no mask."""
    picture = earth()
    spread, skip, zero = (cubemap.resample(picture, ONE, OTHER, filter="bilinear", not_finite=word) for word in ("spread", "skip", "zero"))
    assert 0 < skip.mask.sum() < spread.mask.sum() and not zero.mask.any()
    assert np.array_equal(zero.data, cubemap.resample(picture.filled(0), ONE, OTHER, filter="bilinear"))
    with pytest.raises(TypeError, match="cannot be skipped: give float32"):
        cubemap.resample(earth(np.uint8), ONE, OTHER, filter="bilinear", not_finite="skip")


def test_out_is_the_result():
    """Its mask is set if it has one, in the rows that are written."""
    picture = earth()
    plan = cubemap.Plan(ONE, OTHER, filter="bilinear")
    whole = plan.resample(picture)
    plain = np.zeros((6, 16, 16), np.float32)
    assert plan.resample(picture, plain) is plain
    out = np.ma.masked_all((6, 16, 16), np.float32)
    plane = int(whole.mask.any(axis=(1, 2)).argmax())
    assert plan.resample(picture, out, rows=(plane, 4, 8)) is out
    assert np.array_equal(out.mask[plane, 4:12], whole.mask[plane, 4:12])
    assert out.mask[plane, :4].all() and out.mask[plane, 12:].all()


def test_samples_levels_borders_and_lists():
    """The other functions of pictures."""
    surface, picture = cubemap.Surface(ONE), earth()
    x, y, z = surface.directions(0, np.arange(64) + 0.5, np.full(64, 11.5))
    sample = surface.sample(picture, np.ma.array(x, mask=np.arange(64) == 2), y, z, "nearest")
    assert np.array_equal(np.flatnonzero(sample.mask[:, 0]), [2, *range(20, 40)])
    places = np.ma.array(x, mask=np.arange(64) == 2)
    for whole in (picture.data, (picture.data > 0).astype(np.uint8)):  # a picture without a mask
        sample = surface.sample(whole, places, y, z, "nearest")
        assert np.array_equal(np.flatnonzero(sample.mask[:, 0]), [2])
        assert np.array_equal(sample.data, surface.sample(whole, x, y, z, "nearest"))
    with pytest.raises(TypeError, match="pictures: uint8"):
        surface.sample(picture.data.tolist(), places, y, z)
    levels = cubemap.mips(surface, picture)
    assert levels[1].mask.any() and not levels[1].mask.all() and np.array_equal(levels[0].mask, picture.mask)
    bordered = cubemap.border(surface, picture, 1)
    assert np.array_equal(bordered.mask[0, 1:-1, 1:-1], picture.mask)
    values = np.ma.masked_less(np.arange(12 * 16.0), 5)
    arranged = cubemap.healpix_arrange(values, 4)
    assert arranged.mask.sum() == 5
    assert np.array_equal(cubemap.healpix_arrange(arranged, 4, to_list=True).mask, values.mask)


def test_a_mask_that_nobody_understands_is_refused():
    """Comparisons, surroundings and orientations say so; with nothing masked they take the numbers."""
    picture = earth()
    for call in (lambda one: cubemap.compare_errors(one, one), lambda one: cubemap.orient_value("coupled", one, "0,0,0")):
        with pytest.raises(TypeError, match="without masked numbers"):
            call(picture)
        assert call(np.ma.array(picture.data)) == call(picture.data)


def test_depth_that_is_masked_was_not_measured():
    """NaN, as all that was not measured."""
    stored = np.ma.array([[1000, 2000, 3000]], np.uint16, mask=[[False, True, False]])
    depth, count = cubemap.clean_depth(stored, 1e-3)
    assert np.isnan(depth[0]).tolist() == [False, True, False]


def test_masked_blocks_of_a_raster():
    """NaN in the faces, as a raster's own NaN."""
    da = pytest.importorskip("dask.array")
    picture = earth()
    masked = large.reproject(da.from_array(picture, chunks=(16, 32), asarray=False), "cube:coupled", 16, tile=8).compute()
    filled = large.reproject(da.from_array(picture.filled(np.nan), chunks=(16, 32)), "cube:coupled", 16, tile=8).compute()
    assert np.isnan(filled).any() and np.array_equal(masked, filled, equal_nan=True)
