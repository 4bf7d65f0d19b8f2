# SPDX-License-Identifier: MIT
"""Time-of-flight frames against what is worked out by hand, and what is done with depth and its channels afterwards."""

import pickle
import subprocess
import sys

import cubemap
import numpy as np
import pytest
from cubemap import _library

if not _library.HAS_SIM:
    pytest.skip("built without Embree", allow_module_level=True)
from cubemap import Material, Pose, Primitive, sim

WIDTH, HEIGHT = 64, 48
CAMERA = cubemap.Camera(WIDTH, HEIGHT, 50, 50, 32, 24)
SENSOR = sim.Sensor(CAMERA, pitch=12e-6, f_number=1.2, wavelength=850e-9, efficiency=0.4, exposure=5e-3, readout=2e-3,
                    frequency=20e6, duty=0.5, contrast=0.8)
LIGHT = sim.Light(0.7)
WALL = Primitive.plane((0, 0, 1.7), (0, 0, 1), Material(reflectance=0.6))
BALL = Primitive.sphere((0.1, 0.05, 1.2), 0.2, Material(reflectance=0.9))
WAVE = 4 * np.pi * 20e6 / sim.SPEED_OF_LIGHT  # phase a metre


def frame_of(*primitives, sensor=SENSOR, lights=(LIGHT,), trajectory=None, time=0.0, threads=1, **options):
    scene = sim.TofScene(cubemap.Scene(primitives), threads=threads)
    return scene.simulate(sensor, lights, trajectory, time, sim.Options(**options))


def same(a, b):
    return all(np.array_equal(one, other, equal_nan=True) for one, other in zip(a[:-1], b[:-1], strict=True))


def test_a_wall_is_as_worked_out_by_hand():
    """Lambers, Hoberg and Kolb 2015, eqs. 4 to 15; beside the axis cos^4 of the lens, the surface's cosine, the longer way."""
    frame = frame_of(WALL)
    radiance = 0.6 * 0.7 / (4 * np.pi) / 1.7**2 / np.pi
    energy = np.pi / 4 / 1.2**2 * radiance * 12e-6**2 * 5e-3 * 0.5
    electrons = 0.4 * energy * 850e-9 / (6.62607015e-34 * sim.SPEED_OF_LIGHT)
    moved = 0.8 * electrons * np.cos(np.pi / 2 * np.arange(4) + WAVE * 1.7)
    near = {"rtol": 0, "atol": 1e-6 * electrons}
    np.testing.assert_allclose(frame.phase[:, 24, 32], moved, **near)
    np.testing.assert_allclose(frame.charge_a[:, 24, 32], (electrons + moved) / 2, **near)
    np.testing.assert_allclose(frame.charge_b[:, 24, 32], (electrons - moved) / 2, **near)
    column, row = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    cosine = 1 / np.sqrt(1 + ((column - 32) / 50) ** 2 + ((row - 24) / 50) ** 2)
    np.testing.assert_allclose(frame.intensity, electrons * cosine**7, **near)
    np.testing.assert_allclose(frame.amplitude, 0.8 * electrons * cosine**7, **near)
    np.testing.assert_allclose(frame.distance, 1.7 / cosine, rtol=0, atol=2e-6)
    assert not frame.flags.any() and frame.report.rays >= WIDTH * HEIGHT and frame.report.saturated == 0


def test_light_in_a_sphere_is_what_the_integral_says():
    """Lamp and camera in the middle of a sphere of 1 m that scatters half of all light: each bounce multiplies the phasor
    by half of the integral of r e^(ikr) / 2 from 0 to 2, in closed form."""
    wave, frames = WAVE / 2, {}
    factor = 0.5 * (np.exp(2j * wave) * (1 - 2j * wave) - 1) / (2 * wave**2)
    direct = np.exp(2j * wave)
    inside = sim.TofScene(cubemap.Scene([Primitive.sphere((0, 0, 0), 1.0, Material(reflectance=0.5))]))
    small = SENSOR._replace(camera=cubemap.Camera(8, 6, 6, 6, 3.5, 2.5))
    for bounces in (0, 1, 8):
        options = sim.Options(bounces=bounces, traces=bounces > 1, paths=1024)
        frames[bounces] = inside.simulate(small, [LIGHT], options=options)
        expected = direct * sum(factor**k for k in range(bounces + 1))
        distance = np.angle(expected) % (2 * np.pi) / (2 * wave)
        assert abs(frames[bounces].distance.mean() - distance) < (1e-6, 1.5e-3, 2e-3)[(0, 1, 8).index(bounces)], bounces
    brighter = frames[1].intensity.sum() / frames[0].intensity.sum()
    assert abs(brighter - 1.5) < 0.01  # half of all light once more
    assert frames[1].report.lights > 100 and (frames[1].flags & sim.MULTIPATH).all()


def test_threads_pickles_and_poses_change_no_bit():
    scene = sim.TofScene(cubemap.Scene([WALL, BALL]))
    options = sim.Options(samples=(3, 3), noise=True, seed=7)
    one = scene.simulate(SENSOR, [LIGHT], options=options)
    assert same(one, sim.TofScene(scene.scene, threads=3).simulate(SENSOR, [LIGHT], options=options))
    again = pickle.loads(pickle.dumps(scene))
    assert again == scene and len(again) == 2 and same(one, again.simulate(SENSOR, [LIGHT], Pose(), options=options))
    standing = cubemap.Trajectory([0.0], Pose()[None])
    assert same(one, scene.simulate(SENSOR, [LIGHT], standing, 3.0, options))
    assert not same(one, scene.simulate(SENSOR, [LIGHT], options=options._replace(view=1)))
    assert not same(one, scene.simulate(SENSOR, [LIGHT], Pose(position=(0, 0, 0.1)), options=options))


def test_noise_has_the_spread_of_the_formula():
    dim = sim.TofScene(cubemap.Scene([WALL]))
    clean = dim.simulate(SENSOR, [sim.Light(0.02)])
    electrons = float(clean.intensity[24, 32])
    expected = SENSOR.noise_of_distance(electrons)
    assert abs(expected - 1 / WAVE / (np.sqrt(2) * 0.8 * np.sqrt(electrons))) < 1e-12
    views = [dim.simulate(SENSOR, [sim.Light(0.02)], options=sim.Options(noise=True, seed=3, view=view)).distance[24, 32]
             for view in range(300)]
    assert abs(np.std(views) / expected - 1) < 0.15 and abs(np.mean(views) - 1.7) < 0.2 * expected


def test_shot_noise_may_be_a_measured_polynomial():
    dim, light = sim.TofScene(cubemap.Scene([WALL])), sim.Light(0.3)
    normal = sim.Options(noise=True, shot="freeman-tukey", seed=5)
    clean = dim.simulate(SENSOR, [light]).charge_a
    apart = (dim.simulate(SENSOR, [light], options=normal).charge_a - clean - 0.25) / np.sqrt(clean + 0.5)
    apart = apart[clean > 25]
    assert abs(apart.mean()) < 4 / np.sqrt(apart.size) and abs(apart.var() - 1) < 5 * np.sqrt(2 / apart.size)
    silent = SENSOR._replace(shot_variance=(0.0,), shot_range=(1, 2))
    np.testing.assert_allclose(dim.simulate(silent, [light], options=normal).charge_a, clean, rtol=2e-7, atol=1e-12)
    with pytest.raises(ValueError, match="shot"):
        dim.simulate(SENSOR, [light], options=sim.Options(noise=True, shot="gauss"))


def test_sensors():
    assert abs(SENSOR.frame_time - 4 * 7e-3) < 1e-12 and SENSOR.images == 4
    two = SENSOR._replace(second_frequency=15e6)
    far = frame_of(Primitive.plane((0, 0, 13.8), (0, 0, 1)), sensor=two)
    assert far.phase.shape == (8, HEIGHT, WIDTH) and abs(far.distance[24, 32] - 13.8) < 1e-4  # beyond 7.49 m
    wrapped = frame_of(Primitive.plane((0, 0, 13.8), (0, 0, 1)))
    assert abs(wrapped.distance[24, 32] - (13.8 - sim.SPEED_OF_LIGHT / 40e6)) < 1e-4
    frame = frame_of(WALL)
    again = SENSOR.reconstruct(frame.charge_a, frame.charge_b)
    for name in ("distance", "amplitude", "intensity"):
        np.testing.assert_allclose(getattr(again, name), getattr(frame, name), rtol=2e-6)
    full = frame_of(WALL, sensor=SENSOR._replace(full_well=1000.0))
    assert (full.flags & sim.SATURATED).any() and full.report.saturated == (full.flags & sim.SATURATED != 0).sum()
    half = frame_of(WALL, sensor=SENSOR._replace(mask=((1, 0), (1, 0))), samples=(2, 2))
    assert abs(half.intensity[24, 32] / frame.intensity[24, 32] - 0.5) < 0.02
    assert not np.array_equal(frame_of(WALL, sensor=SENSOR._replace(harmonics=(1, 0, 1 / 9))).phase, frame.phase)


def test_lights_and_surroundings():
    frame = frame_of(WALL)
    even = frame_of(WALL, lights=[LIGHT._replace(intensity=(2, 2, 2))])
    np.testing.assert_allclose(even.intensity, frame.intensity, rtol=1e-5)
    shadow = frame_of(WALL, Primitive.sphere((0, 0, 1.0), 0.1), lights=[LIGHT._replace(position=(-0.5, 0, 0))])
    assert shadow.intensity[24, 42] == 0 and shadow.intensity[24, 58] > 0
    bright = frame_of(WALL, surroundings=sim.Surroundings(1.0))
    assert (bright.intensity > 1.01 * frame.intensity).all()
    np.testing.assert_allclose(bright.distance, frame.distance, atol=1e-4)
    pictured = frame_of(WALL, surroundings=sim.Surroundings(0.0, "coupled", np.ones((6, 8, 8))))
    np.testing.assert_allclose(pictured.intensity, bright.intensity, rtol=1e-3)


def test_surfaces_scatter_and_move():
    dull = sim.Brdf("cook-torrance", diffuse=0.25, roughness=0.3, eta=1.5)
    frame, quarter = frame_of(WALL), frame_of(WALL._replace(brdf=dull))
    np.testing.assert_allclose(quarter.intensity, frame.intensity / 4, rtol=1e-5)
    motion = cubemap.Trajectory([0.0, 1.0], Pose(position=[(0, 0, 0), (0, 0, 0.5)]))
    scene = cubemap.Scene([WALL._replace(motion=motion)])
    assert scene.primitives[0].motion is motion and pickle.loads(pickle.dumps(scene)) == scene
    moving = sim.TofScene(scene)
    assert abs(moving.find_truth(CAMERA, time=0.5).depth[24, 32] - 1.95) < 1e-6
    assert abs(moving.simulate(SENSOR, [LIGHT], time=2.0).distance[24, 32] - 2.2) < 1e-5


def test_brdfs():
    lambert, up = sim.Brdf(), (0.0, 0.0, 1.0)
    tilted = np.array([(0, 0.6, 0.8), (0.6, 0, -0.8)])
    np.testing.assert_allclose(lambert.value(up, up, tilted), [1 / np.pi, 0.0])
    assert abs(lambert.albedo(0.3) - 1) < 1e-6
    facets = sim.Brdf("cook-torrance", diffuse=0.2, specular=0.5, roughness=0.3, eta=1.5)
    u = np.random.default_rng(1).random((2000, 3))
    into, density, weight = facets.sample_direction(up, (0, 0.6, 0.8), u)
    np.testing.assert_allclose(density, facets.density(up, into, (0, 0.6, 0.8)), rtol=1e-9)
    assert abs(np.mean(weight) - facets.albedo(np.arccos(0.8))) < 0.02  # Monte Carlo of the same integral
    table = sim.Brdf("measured", samples=[(0.1, 0.2, 0.3, 0.4), (0.5, 0.4, 0.3, 0.4)])
    assert abs(table.value(up, up, (0, 0.6, 0.8)) - 0.4) < 1e-6
    for one in (lambert, facets, table):
        assert pickle.loads(pickle.dumps(one)) == one
    assert lambert != facets and repr(facets).startswith("cubemap.sim.Brdf('cook-torrance', diffuse=0.2")
    np.testing.assert_allclose(sim.brdf_goniometer(0.0, 0.0, 0.0), 0.0, atol=1e-12)
    for wrong in (dict(kind="phong"), dict(diffuse=0.5), dict(kind="measured"), dict(kind="cook-torrance", diffuse=2)):
        with pytest.raises(ValueError):
            sim.Brdf(**wrong)


def test_truth():
    scene = cubemap.Scene([WALL, BALL])
    seen = scene.render(CAMERA)
    truth = sim.TofScene(scene).find_truth(CAMERA)
    assert np.array_equal(truth.object, seen.id) and truth.flow_next is None
    np.testing.assert_allclose(truth.depth, seen.distance, rtol=1e-6)
    np.testing.assert_allclose(truth.range, np.linalg.norm(truth.position, axis=-1), rtol=1e-6)
    np.testing.assert_allclose(truth.normal[24, 0], (0, 0, -1), atol=1e-6)
    assert truth.shape[24, 0] == cubemap.world.PRIMITIVES.index("plane")
    path = cubemap.Trajectory([0.0, 1.0], Pose(position=[(0, 0, 0), (0.1, 0, 0)]))
    moved = sim.TofScene(cubemap.Scene([WALL])).find_truth(CAMERA, path, 0.0, next=1.0)
    np.testing.assert_allclose(moved.flow_next[..., 0], -0.1 / 1.7 * 50, rtol=1e-5)
    assert moved.flow_before is None


def test_plans():
    scene = sim.TofScene(cubemap.Scene([WALL, BALL]))
    chosen, budget = scene.plan(SENSOR, [LIGHT], 10.0)
    assert len(budget.entries) == 9 and budget.unit == "m" and budget.error <= 10.0
    assert chosen.samples == (1, 1) and chosen.bounces == 0 and not chosen.noise
    names = [entry.name for entry in budget.entries]
    assert "oversampling" in names and budget.to_json()
    strict, why = scene.plan(SENSOR, [LIGHT], 0.0)
    sampling = why.entries[-1]  # nothing is dropped: what remains is that light is sampled
    assert sampling.name == "sampling of scattered light" and why.error == sampling.contribution > 0.0
    assert strict.bounces >= 1 and strict.samples == (3, 3)
    once, why = scene.plan(SENSOR, [LIGHT], 0.0, most=sim.Options(bounces=1, lights=20))
    assert once.bounces == 1 and once.lights == 20 and why.entries[3].reason == "dropped: limit given"
    direct, _why = scene.plan(SENSOR, [LIGHT], 0.0, most=sim.Options(bounces=-1))
    assert direct.bounces == 0


def test_what_is_refused():
    scene = sim.TofScene(cubemap.Scene([WALL]))
    for sensor in (SENSOR._replace(pitch=0.0), SENSOR._replace(phases=2), SENSOR._replace(mask=((np.nan,),))):
        with pytest.raises(cubemap.Error):
            scene.simulate(sensor, [LIGHT])
    for lights in ([], [sim.Light(0.7, aperture=0.0)], [sim.Light(np.nan)]):
        with pytest.raises(cubemap.Error):
            scene.simulate(SENSOR, lights)
    with pytest.raises(cubemap.Error):
        sim.TofScene(cubemap.Scene())
    with pytest.raises(ValueError):
        SENSOR.reconstruct(np.zeros((3, 5)), np.zeros((3, 5)))
    with pytest.raises(ValueError):
        scene.simulate(SENSOR, [LIGHT], options=sim.Options(surroundings=sim.Surroundings(radiance=np.zeros((5, 4, 4)))))


# ---- lenses ----

BARREL = cubemap.Camera(80, 60, 60, 60, 39.5, 29.5, distortion=(-0.2, 0.03))


def test_lenses_resample_a_plane_exactly():
    lens = sim.LensMap(BARREL)
    assert lens.unfilled == 0 and lens.pinhole.shape >= BARREL.shape
    tilted = Primitive.plane((0, 0, 2.0), (0.3, 0.1, 1))
    drawn, true = (cubemap.Scene([tilted]).render(camera).distance for camera in (lens.pinhole, BARREL))
    np.testing.assert_allclose(lens.depth(drawn), true, rtol=1e-5)
    column, row = lens.places()
    np.testing.assert_allclose(np.stack(lens.pinhole.ray(column, row)), np.stack(BARREL.ray(*BARREL.pixels())), atol=1e-9)
    places = np.stack(np.broadcast_arrays(*lens.pinhole.pixels()), axis=-1)
    np.testing.assert_allclose(lens.color(places), np.stack((column, row), axis=-1), atol=1e-3)
    np.testing.assert_allclose(lens.color(places[..., 0]), column, atol=1e-3)
    labels = lens.labels(places[..., 0].astype(np.uint16), 999)
    assert labels.dtype == np.uint16 and (labels == np.rint(column)).mean() > 0.99
    assert np.abs(lens.flow(np.zeros((*lens.pinhole.shape, 2)))).max() < 0.51  # the nearest pixel's centre
    assert np.array_equal(sim.LensMap(BARREL, threads=2).depth(drawn), lens.depth(drawn))
    again = pickle.loads(pickle.dumps(lens))
    assert again == lens == sim.LensMap(BARREL, threads=2) and hash(again) == hash(lens)
    assert np.array_equal(again.depth(drawn), lens.depth(drawn))


def test_lenses_move_vertices():
    points = np.random.default_rng(2).uniform((-0.5, -0.4, 1), (0.5, 0.4, 3), (200, 3))
    moved = sim.lens_move_vertices(BARREL, points)
    plain = cubemap.Camera(80, 60, 60, 60, 39.5, 29.5)
    np.testing.assert_allclose(np.stack(plain.project(*moved.T)), np.stack(BARREL.project(*points.T)), atol=1e-9)
    left, right, upper, lower = sim.lens_frustum(BARREL)
    np.testing.assert_allclose((left, right), (-40 / 60, 40 / 60), atol=1e-12)
    guard = sim.lens_guard(BARREL, 0.1)
    assert guard > 1.1 and sim.lens_guard(BARREL, 0.3) == pytest.approx(guard + 0.2)
    assert np.isnan(sim.lens_move_vertices(BARREL, (0.0, 0.0, -1.0))).all()
    assert sim.lens_move_vertices(BARREL, np.empty((0, 3))).shape == (0, 3)
    with pytest.raises(cubemap.Error):
        sim.lens_frustum(cubemap.Camera(mapping="coupled", size=8))


# ---- motion ----

def test_compensation_takes_a_shift_back():
    """A smooth picture that moves by a pixel from channel to channel."""
    row, column = np.mgrid[:40, :60].astype(float)

    def picture(time):
        return np.sin(0.3 * (column - time)) + np.cos(0.2 * row)

    now, before = (np.stack([picture(4 * frame + k) for k in range(4)]) for frame in (1, 0))
    assert sim.COMPENSATIONS[0] == "CCM-B" and sim.compensation_flows("ccm-1", 4) == ((0, 1, -1, 1),)
    for scheme in sim.COMPENSATIONS:
        pairs = sim.compensation_flows(scheme, 4)
        flows = np.zeros((len(pairs), 40, 60, 2))
        for flow, pair in zip(flows, pairs, strict=True):
            flow[..., 0] = 4 * (pair.to_frame - pair.from_frame) + pair.to_channel - pair.from_channel  # pixels a channel
        corrected = sim.compensate(now, flows, scheme, before)
        inner = (slice(None), slice(8, -8), slice(8, -8))
        assert np.abs(corrected - picture(4))[inner].max() < 0.01 < np.abs(now - picture(4))[inner].max(), scheme
        assert np.array_equal(corrected, sim.compensate(now, flows, scheme, before, threads=2))
    with pytest.raises(ValueError):
        sim.compensate(now, flows[:1], "CCM-B", before)
    moved, coverage = sim.flow_warp(now[0], np.full((40, 60, 2), (1.0, 0.0)))
    np.testing.assert_allclose(moved[:, 4:-4], now[0][:, 3:-5], atol=1e-6)
    assert np.allclose(coverage[:, 4:-4], 1)


def test_channels():
    picture = np.arange(20.0).reshape(4, 5)
    np.testing.assert_allclose(sim.channel_gradient(picture)[1, 1], np.hypot(1, 5), rtol=1e-6)
    np.testing.assert_allclose(sim.channel_normalize(picture, 2.0), picture / 19 * 2, rtol=1e-6)
    census = sim.channel_census(picture)
    assert census.dtype == np.uint8 and census[1, 1] == 0b00001111
    np.testing.assert_allclose(sim.channel_equalize(picture, 256).max(), 1)
    assert abs(sim.channel_normalize_locally(picture, 1)[1, 1]) < 1e-6  # the middle is the mean
    assert sim.channel_equalize_locally(picture, 2, 3.0).shape == (4, 5)
    changed = np.stack([picture, picture, picture])
    changed[2, 1, 1] += 5
    corrected, count = sim.compensate_pixelwise(changed, np.stack([picture] * 3), 1.0)
    assert count == 1 and np.array_equal(corrected, np.stack([picture] * 3))


# ---- errors of depth, texels ----

def test_errors_of_depth():
    truth = np.full((4, 5), 2.0)
    depth = truth + np.linspace(-0.1, 0.28, 20).reshape(4, 5)
    depth[0, 0] = np.nan
    error = (depth.astype(np.float32).astype(float) - truth)[np.isfinite(depth)]
    found = sim.depth_error(depth, truth)
    assert (found.count, found.missing, found.extra) == (19, 1, 0)
    np.testing.assert_allclose((found.bias, found.mae, found.rmse, found.deviation, found.median, found.maximum),
                               (error.mean(), np.abs(error).mean(), np.sqrt((error**2).mean()), error.std(),
                                np.median(error), np.abs(error).max()), rtol=1e-6)
    np.testing.assert_allclose(sim.depth_error_local(depth, truth), depth - truth, atol=1e-6)
    np.testing.assert_allclose(sim.depth_error_quantiles(depth, truth, [0, 0.5, 1]),
                               np.quantile(np.abs(error), [0, 0.5, 1]), atol=1e-7)
    assert sim.depth_error_bad(depth, truth, 0.1) == ((np.abs(error) > 0.1).sum() + 1) / 20
    frames = np.random.default_rng(3).normal(2, 0.1, (9, 4, 5)).astype(np.float32)
    mean, deviation = sim.depth_error_temporal(frames)
    np.testing.assert_allclose(mean, frames.mean(0), rtol=1e-5)
    np.testing.assert_allclose(deviation, frames.std(0, ddof=1), rtol=1e-4)
    assert sim.depth_error_checkerboard(1.0, 0.03, 0.01, 1e-6) > 0
    with pytest.raises(cubemap.Error):
        sim.depth_error(np.full(3, np.nan), np.ones(3))
    with pytest.raises(ValueError):
        sim.depth_error(np.ones(3), np.ones(4))


def test_errors_of_surfaces():
    random = np.random.default_rng(4)
    points = np.concatenate((random.uniform(-1, 1, (500, 2)), np.full((500, 1), 3.0)), axis=1)
    plane = sim.depth_error_plane(points + (0, 0, 0))
    assert plane.count == 500 and plane.rms < 1e-6 and abs(plane.distance + 3) < 1e-5
    np.testing.assert_allclose(plane.normal, (0, 0, -1), atol=1e-6)
    tilt = (0.0, np.sin(0.2), np.cos(0.2))
    np.testing.assert_allclose(sim.depth_error_slope([(0, 0, 1), tilt], [tilt, tilt]), (0.2, 0), atol=1e-3)
    step = np.where(np.arange(20) < 10, 1.0, 2.0) * np.ones((15, 1))
    edges = sim.depth_error_edges(np.roll(step, 1, axis=1)[:, 1:], step[:, 1:])
    assert edges.recall == edges.precision == 1.0 and edges.measured == 15
    depth = 2 + np.linspace(0, 1, 100)
    plot = sim.depth_error_sparsify(depth, np.full(100, 2.0), -depth, [0.0, 0.5])
    np.testing.assert_allclose(plot.error, plot.oracle)
    np.testing.assert_allclose(plot.error, (0.5, np.linspace(0, 1, 100)[:50].mean()), rtol=1e-5)
    assert abs(plot.area) < 1e-9


def test_texels():
    options = sim.TexelOptions(field=1.0, width=64, height=48, columns=8, rows=6, window=8)
    whole = sim.texel_complete(options)
    assert whole.spacing == "even spaces" and whole.unit == 1 and whole.columns == 8
    image = sim.texel_render(cubemap.Scene([WALL]), Pose(), options)
    assert image.color.shape == (48, 64, 3) and image.point.shape == (6, 8, 3)
    np.testing.assert_allclose(image.depth, 1.7, rtol=1e-6)
    again = sim.texel_points(options, image.depth)
    assert np.array_equal(again.point, image.point) and again.color is None
    np.testing.assert_allclose(image.range, np.linalg.norm(image.point, axis=-1), rtol=1e-6)
    places = sim.texel_places(options)
    np.testing.assert_allclose(image.point[0, :, 0], 1.7 * places.x, rtol=1e-5)
    np.testing.assert_allclose(image.uv[:, 0, 1], places.row / 48, rtol=1e-5)
    np.testing.assert_allclose(sim.texel_sample(options, np.full((48, 64), 3.0)), 3.0)
    np.testing.assert_allclose(sim.texel_linearise(1.0, np.inf, [0.0, 0.5]), (1.0, 2.0))
    scan = Pose.exp((0.1, 0.2, 0.3, 0.0, 0.1, 0.0))
    np.testing.assert_array_equal(sim.texel_matrix(scan, scan), np.eye(4))
    np.testing.assert_allclose(sim.texel_matrix(Pose(), scan), scan.matrix, atol=1e-12)


def test_a_build_without_it_says_so():
    program = "from cubemap import _library; _library.HAS_SIM = False; import cubemap.sim"
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert ended.returncode and "ImportError: cubemap was built without its module sim, which needs Embree" in ended.stderr
