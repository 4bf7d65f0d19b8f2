# SPDX-License-Identifier: MIT
"""Time-of-flight cameras, simulated to the electron, and what is done with their pictures.

docs/guide/sim.md, sim-lens.md and sim-motion.md say what is modelled. Units are SI, angles radians, charges electrons. A
build without Embree has no such module: importing it then raises ImportError.

>>> from cubemap import sim
>>> camera = cubemap.Camera(32, 24, 26, 26, 15.5, 11.5)
>>> sensor = sim.Sensor(camera, pitch=12e-6, f_number=1.0, wavelength=850e-9, efficiency=0.4, exposure=5e-3,
...                     frequency=20e6, duty=0.5, contrast=0.8)
>>> scene = sim.TofScene(cubemap.Scene.named("room"))
>>> pose = cubemap.Pose.from_quaternion((0, 0, 1.2), (-0.5, 0.5, -0.5, 0.5))  # looks along x
>>> frame = scene.simulate(sensor, [sim.Light(4.0)], pose)
>>> error = sim.depth_error(frame.distance, scene.find_truth(camera, pose).range)
>>> frame.phase.shape, error.missing, error.median_absolute < 0.01
((4, 24, 32), 0, True)
"""

from .. import _library

if not _library.HAS_SIM:
    raise ImportError("cubemap was built without its module sim, which needs Embree (libembree-dev) when it is built",
                      name=__name__)

from .._methods import depth_error_checkerboard
from .brdf import Brdf, BrdfSample, brdf_goniometer
from .channels import (COMPENSATIONS, FlowPair, channel_census, channel_equalize, channel_equalize_locally,
                       channel_gradient, channel_normalize, channel_normalize_locally, compensate,
                       compensate_pixelwise, compensation_flows, flow_warp)
from .errors import (SPARSIFICATION_MEASURES, DepthEdges, DepthError, DepthPlane, Sparsification, depth_error,
                     depth_error_bad, depth_error_edges, depth_error_local, depth_error_plane, depth_error_quantiles,
                     depth_error_slope, depth_error_sparsify, depth_error_temporal)
from .lens import LensMap, lens_frustum, lens_guard, lens_move_vertices, lens_pinhole
from .texels import (SPACINGS, TexelImage, TexelOptions, TexelPlaces, texel_complete, texel_linearise, texel_matrix,
                     texel_places, texel_points, texel_render, texel_sample)
from .tof import (FLYING, MOTION, MULTIPATH, NOTHING, SATURATED, SPEED_OF_LIGHT, Light, Options, Reconstruction, Report,
                  Sensor, Surroundings, TofFrame, TofScene, Truth)

__all__ = [
    "Brdf", "brdf_goniometer", "BrdfSample", "channel_census", "channel_equalize", "channel_equalize_locally",
    "channel_gradient", "channel_normalize", "channel_normalize_locally", "compensate", "compensate_pixelwise",
    "compensation_flows", "COMPENSATIONS", "depth_error", "depth_error_bad", "depth_error_checkerboard",
    "depth_error_edges", "depth_error_local", "depth_error_plane", "depth_error_quantiles", "depth_error_slope",
    "depth_error_sparsify", "depth_error_temporal", "DepthEdges", "DepthError", "DepthPlane", "flow_warp", "FlowPair",
    "FLYING", "lens_frustum", "lens_guard", "lens_move_vertices", "lens_pinhole", "LensMap", "Light", "MOTION",
    "MULTIPATH", "NOTHING", "Options", "Reconstruction", "Report", "SATURATED", "Sensor", "SPACINGS",
    "Sparsification", "SPARSIFICATION_MEASURES", "SPEED_OF_LIGHT", "Surroundings", "texel_complete",
    "texel_linearise", "texel_matrix", "texel_places", "texel_points", "texel_render", "texel_sample", "TexelImage",
    "TexelOptions", "TexelPlaces", "TofFrame", "TofScene", "Truth",
]
