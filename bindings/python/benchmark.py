#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Nanoseconds a point: the C function on arrays (called through ctypes, once for all points), this package with fresh outputs
and with out=, healpy and astropy-healpix where they are; one point alone; and whole calls of healpy's names. The least of
several rounds, which take turns.

usage: benchmark.py [--points N] [--rounds N]
"""

import argparse
import time

import cubemap
import numpy as np
from cubemap import _library as library
from cubemap import healpy as own

try:
    import healpy
except ImportError:
    healpy = None
try:
    import astropy_healpix
except ImportError:
    astropy_healpix = None


def least(calls, rounds, repeat):
    """The least time of each call in seconds; rounds of all of them, so that a busy machine is busy for each."""
    best = dict.fromkeys(calls, np.inf)
    for _ in range(rounds):
        for name, call in calls.items():
            begun = time.perf_counter()
            for _ in range(repeat):
                call()
            best[name] = min(best[name], (time.perf_counter() - begun) / repeat)
    return best


def c_call(function, handle, count, arrays):
    """The function of the library on arrays that are there."""
    pointers = [array.ctypes.data for array in arrays]
    return lambda: function(handle, count, *pointers)


def row(name, calls, points, rounds):
    best = least(calls, rounds, max(1, 200_000 // points))
    print(f"{name:34} {points:>9}", *(f"{best[one] / points * 1e9:9.2f}" if one in best else "        -"
                                      for one in ("C", "fresh", "out=", "healpy", "astropy")), f"{best['out='] / best['C']:10.2f}")


def arrays_of(points, rounds):
    random = np.random.default_rng(1)
    x, y, z = random.normal(size=(3, points))
    for specification in ("coupled", "tangent", "healpix"):
        m = cubemap.Mapping(specification)
        face, u, v = m.forward(x, y, z)
        out, back = (np.empty_like(face), np.empty_like(u), np.empty_like(v)), (np.empty(points), np.empty(points), np.empty(points))
        row(f"{specification} forward", {"C": c_call(library.cm_forward_array, m._handle, points, (x, y, z, *out)),
            "fresh": lambda: m.forward(x, y, z), "out=": lambda: m.forward(x, y, z, out=out)}, points, rounds)
        row(f"{specification} inverse", {"C": c_call(library.cm_inverse_array, m._handle, points, (face, u, v, *back)),
            "fresh": lambda: m.inverse(face, u, v), "out=": lambda: m.inverse(face, u, v, out=back)}, points, rounds)
    healpix(x, y, z, points, rounds)
    camera(random, points, rounds)


def camera(random, points, rounds):
    c = cubemap.Camera(640, 480, 525, 525, 319.5, 239.5, distortion=(-0.28, 0.07, 1e-3, -5e-4))
    pixels = tuple(random.uniform(0, ((640,), (480,)), (2, points)))
    rays, out, back = c.ray(*pixels), tuple(np.empty((2, points))), tuple(np.empty((3, points)))
    row("camera with a lens: project", {"C": c_call(library.cm_camera_project_array, c._handle, points, (*rays, *out)),
        "fresh": lambda: c.project(*rays), "out=": lambda: c.project(*rays, out=out)}, points, rounds)
    row("camera with a lens: ray", {"C": c_call(library.cm_camera_ray_array, c._handle, points, (*pixels, *back)),
        "fresh": lambda: c.ray(*pixels), "out=": lambda: c.ray(*pixels, out=back)}, points, rounds)


def healpix(x, y, z, points, rounds):
    hp, nside = cubemap.Healpix(1024), 1024
    theta, phi = own.vec2ang(np.stack((x, y, z), axis=-1))
    pixel, angles = np.empty(points, np.int64), (np.empty(points), np.empty(points))
    calls = {"C": c_call(library.cm_healpix_pixel_from_angles_array, hp._handle, points, (theta, phi, pixel)),
             "fresh": lambda: own.ang2pix(nside, theta, phi), "out=": lambda: hp.pixel_from_angles(theta, phi, out=pixel)}
    more = {}
    if healpy:
        calls["healpy"], more["healpy"] = lambda: healpy.ang2pix(nside, theta, phi), lambda: healpy.pix2ang(nside, pixel)
    if astropy_healpix:
        lat = np.pi / 2 - theta
        from astropy_healpix.core import healpix_to_lonlat, lonlat_to_healpix
        from astropy import units

        lon, lat = phi * units.rad, lat * units.rad
        calls["astropy"], more["astropy"] = lambda: lonlat_to_healpix(lon, lat, nside), lambda: healpix_to_lonlat(pixel, nside)
    row("ang2pix, nside 1024", calls, points, rounds)
    row("pix2ang, nside 1024", {"C": c_call(library.cm_healpix_angles_from_pixel_array, hp._handle, points, (pixel, *angles)),
        "fresh": lambda: own.pix2ang(nside, pixel), "out=": lambda: hp.angles_from_pixel(pixel, out=angles), **more}, points, rounds)


def alone(rounds):
    m, hp = cubemap.Mapping(), cubemap.Healpix(1024)
    forward, inverse, pixel = m.forward, m.inverse, hp.pixel_from_angles
    jacobian, distortion, vector = m.forward_jacobian, m.forward_distortion, np.array([0.3, -0.5, 0.4])
    calls = {"coupled forward": lambda: forward(2.0, 1.0, 0.5), "coupled inverse": lambda: inverse(0, 0.3, 0.4),
             "coupled forward_jacobian": lambda: jacobian(2.0, 1.0, 0.5), "coupled forward_distortion": lambda: distortion(2.0, 1.0, 0.5),
             "cubemap.healpy.vec2ang": lambda: own.vec2ang(vector), "cubemap.healpy.ang2vec": lambda: own.ang2vec(0.3, 0.4),
             "pixel_from_angles": lambda: pixel(0.3, 0.4), "cubemap.healpy.ang2pix": lambda: own.ang2pix(1024, 0.3, 0.4),
             "a function that does nothing": lambda: None}
    if healpy:
        calls["healpy.ang2pix"] = lambda: healpy.ang2pix(1024, 0.3, 0.4)
        calls["healpy.vec2ang"], calls["healpy.ang2vec"] = lambda: healpy.vec2ang(vector), lambda: healpy.ang2vec(0.3, 0.4)
    best = least(calls, rounds, 20_000)
    nothing = best["a function that does nothing"]
    print(f"\n{'one point of Python numbers':34} {'us':>9}")
    for name, seconds in best.items():
        if name != "a function that does nothing":
            print(f"{name:34} {(seconds - nothing) * 1e6:9.3f}")


def calls(rounds):
    """Whole calls of healpy's names."""
    random = np.random.default_rng(1)
    vector, pixels, values = np.array([0.3, -0.5, 0.4]), random.integers(0, 12 * 64**2, 10_000), random.normal(size=12 * 256**2)
    all_of_them = {
        "query_disc(64, v, 0.5)": lambda hp: hp.query_disc(64, vector, 0.5),
        "query_disc(64, v, 0.5, nest=True)": lambda hp: hp.query_disc(64, vector, 0.5, nest=True),
        "query_disc(64, v, 0.5, inclusive=True)": lambda hp: hp.query_disc(64, vector, 0.5, inclusive=True),
        "query_disc(1024, v, 0.1)": lambda hp: hp.query_disc(1024, vector, 0.1),
        "query_disc(1024, v, 0.1, nest=True)": lambda hp: hp.query_disc(1024, vector, 0.1, nest=True),
        "query_disc(1024, v, 0.1, inclusive=True)": lambda hp: hp.query_disc(1024, vector, 0.1, inclusive=True),
        "boundaries(64, 1234)": lambda hp: hp.boundaries(64, 1234),
        "boundaries(64, 10^4 pixels)": lambda hp: hp.boundaries(64, pixels),
        "get_all_neighbours(64, 1234)": lambda hp: hp.get_all_neighbours(64, 1234),
        "get_all_neighbours(64, 10^4 pixels)": lambda hp: hp.get_all_neighbours(64, pixels),
        "nest2ring(64, 10^4 pixels)": lambda hp: hp.nest2ring(64, pixels),
        "pix2ang(64, 1234, lonlat=True)": lambda hp: hp.pix2ang(64, 1234, lonlat=True),
        "ud_grade(nside 256, 64)": lambda hp: hp.ud_grade(values, 64),
        'ud_grade(nside 256, 64, order_in="NEST")': lambda hp: hp.ud_grade(values, 64, order_in="NEST"),
        'ud_grade(nside 256, 256, order_in="NEST")': lambda hp: hp.ud_grade(values, 256, order_in="NEST"),
    }
    print(f"\n{'microseconds a call':42} {'cubemap':>10} {'healpy':>10}")
    for name, call in all_of_them.items():
        both = {"own": lambda call=call: call(own), **({"healpy": lambda call=call: call(healpy)} if healpy else {})}
        best = least(both, rounds, 20)
        print(f"{name:42}", *(f"{seconds * 1e6:10.2f}" for seconds in best.values()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, nargs="*", default=[1000, 100_000, 1_000_000])
    parser.add_argument("--rounds", type=int, default=15)
    given = parser.parse_args()
    print(f"instructions {cubemap.Mapping().instructions}, NumPy {np.__version__}, healpy {getattr(healpy, '__version__', 'none')}, "
          f"astropy-healpix {getattr(astropy_healpix, '__version__', 'none')}")
    print(f"{'ns a point':34} {'points':>9} {'C':>9} {'fresh':>9} {'out=':>9} {'healpy':>9} {'astropy':>9} {'out= / C':>10}")
    for points in given.points:
        arrays_of(points, given.rounds)
    alone(given.rounds)
    calls(given.rounds)


if __name__ == "__main__":
    main()
