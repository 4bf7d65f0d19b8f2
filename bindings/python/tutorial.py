#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The Python package in six steps, each with a picture: tutorial.py [FOLDER] writes them there.

docs/guide/python.md shows the pictures; bindings/python/test runs this.
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import cubemap  # noqa: E402
import cubemap.plot  # noqa: E402

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
root = pathlib.Path(__file__).resolve().parents[2]


def save(name):
    plt.savefig(folder / name, dpi=80)
    plt.close("all")


# 1. A point to a face, and back. Numbers give numbers, arrays give arrays.
m = cubemap.Mapping("coupled")
face, u, v = m.forward(2.0, 1.0, 0.5)
print(f"face {face} ({m.frame.faces[face].name}), u {u:.6f}, v {v:.6f}")
print(*(f"{number:.6f}" for number in m.inverse(face, u, v)))

lon, lat = np.radians([13.4, -74.0, 139.7]), np.radians([52.5, 40.7, 35.7])
face, u, v = m.forward_lonlat(lon, lat)
print(face, u.round(4), v.round(4))

# 2. What a mapping does to circles: Tissot's indicatrices. Equal areas have ellipses of one size.
figure, both = plt.subplots(1, 2, figsize=(12, 4.6), layout="constrained")
for axes, name in zip(both, ("gnomonic", "coupled")):
    cubemap.plot.indicatrices(name, axes=axes)
    found = cubemap.statistics(name, "area")
    axes.set_title(f"{name}: areas {found.minimum:.2f} to {found.maximum:.2f} of their mean")
save("indicatrices.png")

# 3. The same as colours, on one face; colour maps are the library's own.
cubemap.register_colormaps()
figure, both = plt.subplots(1, 2, figsize=(12, 4.2), layout="constrained")
for axes, name in zip(both, ("tangent", "coupled")):
    cubemap.plot.distortion(name, "isotropy", axes=axes, cmap="cubemap.sequential-single", vmin=1, vmax=1.75)
    axes.set_title(f"{name}: how much longer an ellipse is than wide")
save("distortion.png")

# 4. A picture of the Earth to six faces, mixed as light; and back again.
earth = plt.imread(root / "data" / "earth-2048.jpg")
six = cubemap.resample(earth, "equirect", "cube:coupled;size=256", transfer="srgb")
again = cubemap.resample(six, "cube:coupled", f"equirect;size={earth.shape[1]}", transfer="srgb")
print("six faces", six.shape, "and back", again.shape, "mean error", round(float(np.abs(again[..., :3].astype(float) - earth).mean()), 2))
cubemap.plot.faces(six, m)
save("earth.png")

# 5. On the ellipsoid: cells of equal area that cover a region, the Alps.
cells = cubemap.CellGrid(cubemap.Grid("seamless"))
alps = cubemap.Region.polygon(np.radians([(5.5, 43.7), (8.0, 44.0), (16.4, 47.5), (13.0, 48.0), (8.0, 47.6), (5.6, 45.9)]))
covering = cells.cover(alps, 4, 9, most=60)
area = cells.area(covering)
print(len(covering), "cells", f"{area.sum() / 1e9:.0f} thousand km2, sizes {np.unique(cubemap.cell_level(covering)).tolist()}")
figure, axes = plt.subplots(figsize=(8, 4.6), layout="constrained")
for corners in np.degrees(cells.corners_lonlat(covering)):
    axes.fill(*corners.T, facecolor="#7aa6c2", edgecolor="white", linewidth=0.8)
axes.set(xlabel="longitude, degrees", ylabel="latitude, degrees", aspect=1.4, title="The Alps in cells of equal area, by levels")
save("cells.png")

# 6. HEALPix: a map of values, a disc in it, and the whole on a cube.
hp = cubemap.Healpix(32)
x, y, z = hp.direction_from_pixel(np.arange(hp.pixel_count))
values = np.sin(6 * x) * np.cos(5 * y) + z
from cubemap import healpy  # noqa: E402

values[healpy.query_disc(32, (1, 0.4, 0.3), np.radians(20))] = np.nan
dx, dy, dz = cubemap.plot.directions_of(m, 256)
cubemap.plot.faces(values[hp.pixel_from_direction(dx, dy, dz)], m, cmap="cubemap.uniform-blue-red")
save("healpix.png")
