# SPDX-License-Identifier: MIT
"""Mappings between the sphere and the faces of a cube.

>>> import cubemap
>>> m = cubemap.Mapping("coupled")
>>> face, u, v = m.forward(2.0, 1.0, 0.5)
>>> print(face, round(u, 6), round(v, 6))
0 0.620558 0.327956
>>> x, y, z = m.inverse(face, u, v)
>>> print(round(y / x, 12), round(z / x, 12))
0.5 0.25

Angles are radians, but those of rotations degrees. docs/guide/python.md is the guide. Further parts: cubemap.healpy, which is
a drop-in for parts of healpy, cubemap.plot (matplotlib), cubemap.large (Dask and xarray), cubemap.sim (time-of-flight
cameras). Examples of help() have cubemap and, as np, NumPy.
"""

import importlib
from typing import TYPE_CHECKING

from . import _library, _methods
from ._errors import Error
from ._methods import *  # noqa: F403
from .advice import LIMITS, Advice, Candidate, Cost, advise
from .budget import Budget, BudgetEntry
from .camera import Camera
from .cells import (CURVES, LEVEL_MAX, NO_CELL, CellGrid, Region, cell_token, cells_contain, cells_intersect, normalise_cells,
                    parse_cell)
from .colors import Clipping, Color, Colormap, colormaps, find_colormap, register_colormaps
from .comparing import (ErrorFigures, Errors, MapFigures, compare_errors, compare_values, difference_map, equirect_weights, face_weights, flip, flip_hdr,
                        sphere_points, ssim)
from .depth import DepthBounds, DepthCount, DepthMaps, DepthPyramid, Rays, clean_depth
from .earth import (LATITUDES, Ellipsoid, Grid, LatitudeConversion, Orientation, Rotation, cap_radius, ellipsoids, orientations)
from .environments import (Environment, brdf_table, harmonics_basis, harmonics_cosine_lobe, harmonics_evaluate, harmonics_faces,
                           harmonics_ggx_lobe, harmonics_json, harmonics_rotate, harmonics_scale, harmonics_window_factors,
                           texel_solid_angles)
from .images import (FILTERS, Panorama, Plan, Surface, SurfaceKind, SurfacePreset, border, healpix_arrange, mips, resample, surface_kinds, surface_presets)
from .mapping import (NO_FACE, RECOMMENDED, Distortion, Face, Frame, Mapping, MappingInfo, Parameter, catalogue,
                      check_specification, find_mapping, frames, instruction_sets)
from .measures import (ORIENT_MEASURES, QUANTITIES, FaceSize, Orient, Precision, Statistics, Terms, advise_precision, advise_size,
                       advise_terms, orient, orient_value, percentiles, statistics)
from .octree import RULES, STATES, Octree, OctreeCount, OctreePicture, Voxels
from .pixels import NO_PIXEL, ORDERS, UNSEEN, Healpix, Ring
from .pose import Alignment, Pose, align
from .raster import NO_ID, Raster
from .store import Blob, Store
from .trajectory import NO_INDEX, Evaluation, Inertial, InertialNoise, Motion, MotionState, Trajectory
from .world import SCENES, Hit, Material, Mesh, Primitive, Scene

if TYPE_CHECKING:
    from . import healpy, large, plot, sim

__all__ = [
    "Advice", "advise", "advise_precision", "advise_size", "advise_terms", "align", "Alignment", "Blob", "border",
    "brdf_table", "Budget", "BudgetEntry", "Camera", "Candidate", "cap_radius", "catalogue", "cell_token", "CellGrid",
    "cells_contain", "cells_intersect", "check_specification", "clean_depth", "Clipping", "Color", "Colormap",
    "colormaps", "compare_errors", "compare_values", "Cost", "CURVES", "DepthBounds", "DepthCount", "DepthMaps",
    "DepthPyramid", "difference_map", "Distortion", "Ellipsoid", "ellipsoids", "Environment", "equirect_weights",
    "Error", "ErrorFigures", "Errors", "Evaluation", "Face", "face_weights", "FaceSize", "FILTERS", "find_colormap",
    "find_mapping", "flip", "flip_hdr", "Frame", "frames", "Grid", "harmonics_basis", "harmonics_cosine_lobe",
    "harmonics_evaluate", "harmonics_faces", "harmonics_ggx_lobe", "harmonics_json", "harmonics_rotate",
    "harmonics_scale", "harmonics_window_factors", "Healpix", "healpix_arrange", "Hit", "Inertial", "InertialNoise",
    "instruction_sets", "LatitudeConversion", "LATITUDES", "LEVEL_MAX", "LIMITS", "MapFigures", "Mapping",
    "MappingInfo", "Material", "Mesh", "mips", "Motion", "MotionState", "NO_CELL", "NO_FACE", "NO_ID", "NO_INDEX",
    "NO_PIXEL", "normalise_cells", "Octree", "OctreeCount", "OctreePicture", "ORDERS", "Orient", "orient",
    "ORIENT_MEASURES", "orient_value", "Orientation", "orientations", "Panorama", "Parameter", "parse_cell",
    "percentiles", "Plan", "Pose", "Precision", "Primitive", "QUANTITIES", "Raster", "Rays", "RECOMMENDED", "Region",
    "register_colormaps", "resample", "Ring", "Rotation", "RULES", "Scene", "SCENES", "sphere_points", "ssim",
    "STATES", "Statistics", "statistics", "Store", "Surface", "surface_kinds", "surface_presets", "SurfaceKind",
    "SurfacePreset", "Terms", "texel_solid_angles", "Trajectory", "UNSEEN", "Voxels",
]
__all__ += _methods.__all__

__version__ = _library.cm_version().decode()

if not TYPE_CHECKING:  # which would take it for whatever name is asked for

    def __getattr__(name):
        """The further parts are imported when they are first asked for."""
        if name in ("healpy", "large", "plot", "sim"):
            return importlib.import_module(f".{name}", __name__)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
