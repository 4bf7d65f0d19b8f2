# SPDX-License-Identifier: MIT
"""Masked pictures: what is masked is no data, and so is what is made from it.

A mask goes the picture's way as one of NaN and zeros, by the same filter: a pixel is masked whose footprint a masked one is in.

>>> earth = np.ma.masked_less(np.arange(8.0 * 16, dtype=np.float32).reshape(8, 16), 1.0)
>>> six = cubemap.resample(earth, "equirect", "cube:coupled;size=4", filter="nearest")
>>> bool(six.mask.any()), bool(six.mask.all())
(True, False)
"""

import numpy as np


def is_masked(pictures):
    """Is it an array with a mask?"""
    return isinstance(pictures, np.ma.MaskedArray)


def filled(pictures, not_finite="spread"):
    """The numbers of a masked picture: NaN for what is masked. Whole numbers have none: they are the mean of the rest where the
    mask comes along, as filters of splines look at all pixels, and 0 where it counts as 0."""
    if not is_masked(pictures):
        return pictures
    data, mask = np.ma.getdata(pictures), np.ma.getmaskarray(pictures)
    if data.dtype.kind == "f":
        return np.where(mask, data.dtype.type(np.nan), data)
    if not_finite == "skip" and mask.any():
        raise TypeError(f"pictures: masked ones of {data.dtype} cannot be skipped: give float32, .astype(np.float32)")
    return np.where(mask, data.dtype.type(0), data) if not_finite == "zero" else levelled(pictures)


def levelled(pictures):
    """A picture for who looks at what it has: what is masked is the mean of the rest."""
    mean = pictures.mean(dtype=np.float64) if pictures.count() else 0
    return np.ma.filled(pictures, pictures.dtype.type(mean))


def as_nan(pictures, whole_pixels=False):
    """The mask as a picture of float32: NaN where it masks, else 0. Of whole pixels all channels are masked if one is."""
    mask = np.ma.getmaskarray(pictures)
    if whole_pixels:
        mask = np.broadcast_to(mask.any(axis=-1, keepdims=True), mask.shape)
    return np.where(mask, np.float32(np.nan), np.float32(0))


def with_mask(result, gone, out=None):
    """A result with the mask that came along as NaN; given an array to write into, that is the result, and its mask is set if it has
    one."""
    if out is None:
        return np.ma.array(result, mask=np.isnan(gone))
    if is_masked(out):
        out.mask = np.isnan(gone)
    return out


def unmasked(values, name):
    """What has no mask; a masked array is refused where nobody could say what its mask means."""
    if is_masked(values) and np.ma.getmaskarray(values).any():
        raise TypeError(f"{name}: an array without masked numbers; .filled(...) says what they count as")
    return np.ma.getdata(values) if is_masked(values) else values


def three_numbers(values, name):
    """A list of three numbers, of which none is masked."""
    values = np.asarray(unmasked(values, name), float)
    if values.shape != (3,):
        raise ValueError(f"{name}: three numbers, not {values.shape}")
    return values.tolist()
