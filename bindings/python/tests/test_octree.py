# SPDX-License-Identifier: MIT
"""Maps of the analytic room, asked, kept, merged, paged, drawn and carved; what is refused."""

import cubemap
import numpy as np
import pytest
from cubemap import STATES, Pose

CAMERA = cubemap.Camera(96, 72, 60, 60, 47.5, 35.5)
AROUND = cubemap.Camera(mapping="coupled", size=32, pixel_centre=0.5)
ROOM = cubemap.Scene.named("room")
# z forward along x of the world, y down
AHEAD = Pose([[0, -1, 0], [0, 0, -1], [1, 0, 0]], (0.1, 0.05, 1.2))
LEFT = Pose([[1, 0, 0], [0, 0, -1], [0, 1, 0]], (0.1, 0.05, 1.2))
OCCUPIED, FREE, UNKNOWN = (STATES.index(word) for word in ("occupied", "free", "unknown"))


def view(pose, camera=CAMERA):
    seen = ROOM.render(camera, pose)
    return seen.distance.astype(np.float32), (255 * seen.color).round().astype(np.uint8)


def mapped(*poses, edge=0.05, **options):
    made = cubemap.Octree(edge, 8, **options)
    for pose in poses:
        depth, color = view(pose)
        made.update(depth, CAMERA, pose, color=color)
    return made


@pytest.fixture(scope="module")
def room():
    return mapped(AHEAD)


def same(a, b):
    return all(np.array_equal(one, other) for one, other in zip(a, b, strict=True))


def test_points(room):
    found = room.at([[1.0, 0.05, 1.2], [2.99, 0.05, 1.2], [-2.0, 0, 1.2], [100.0, 0, 0]], 0)
    assert found.state.tolist() == [FREE, OCCUPIED, UNKNOWN, UNKNOWN]
    assert found.edge.tolist() == [0.05, 0.05, 0.05, 0.0] and found.alpha[0] < 127 < found.alpha[1]
    assert found.has_color.tolist() == [0, 1, 0, 0] and np.abs(found.color[1].astype(int) - (217, 115, 89)).max() < 3
    one = room.at((1.0, 0.05, 1.2), 0)
    assert one.state == FREE and abs(one.x - 1.025) < 1e-9
    several = room.at((1.01, 0.05, 1.2), np.arange(9))
    assert several.level.tolist() == list(range(9)) and np.allclose(several.edge, 0.05 * 2.0 ** np.arange(9))
    assert room.at((1.0, 0.05, 1.2), 9).edge == 0 and room.at((np.nan, 0, 0), 0).edge == 0


def test_rays(room):
    directions = np.array([[1, 0, 0], [1, 0.1, 0.05], [-1, 0, 0]], float)
    found = room.ray(AHEAD.position, directions, 0.0)
    assert found.state[:2].tolist() == [OCCUPIED] * 2 and np.isnan(found.distance[2])
    true = ROOM.cast(*AHEAD.position, *(directions / np.linalg.norm(directions, axis=1)[:, None]).T).distance
    assert np.abs(found.distance - true)[:2].max() < 0.1
    assert np.isnan(room.ray(AHEAD.position, (1, 0, 0), 1.0).distance)
    walked = room.walk_ray(AHEAD.position, (1, 0, 0), 3.0)
    assert (np.diff(walked.x) > 0).all() and walked.state[0] == FREE and OCCUPIED in walked.state
    with pytest.raises(ValueError):
        room.walk_ray((0, 0), (1, 0, 0))


def test_nearest(room):
    occupied = room.extract()
    centres = np.stack(occupied[:3], axis=-1)
    points = np.array([[2.5, 0.3, 1.0], [2.0, 0.0, 1.3], [0.1, 0.0, 1.2]])
    found = room.nearest(points, 1.0)
    for point, distance in zip(points, found.distance, strict=True):
        least = np.linalg.norm(centres - point, axis=1).min()
        assert abs(distance - least) < 1e-9 if least <= 1.0 else np.isnan(distance)
    assert np.isfinite(found.distance).any() and np.isnan(found.distance).any()


def test_extracted_and_walked(room):
    for level in range(4):
        found = room.extract(level)
        assert (found.state == OCCUPIED).all() and (found.level == level).all()
        assert same(room.at(np.stack(found[:3], axis=-1), level), found)
    whole = room.walk_box((-7, -7, -7), (7, 7, 7))
    volume = 8 ** whole.level
    assert room.count.occupied == volume[whole.state == OCCUPIED].sum() == len(room.extract().x)
    assert room.count.free == volume[whole.state == FREE].sum() > 1000
    part = room.walk_box((0, -1, 1), (2, 1, 2))
    assert len(part.x) and (part.x > 0).all() and (part.z < 2).all()
    assert room.step == 1 and len(room.walk_changes(1).x) == 0 and same(room.walk_changes(0), whole)
    assert len(room.walk_box((9, 9, 9), (8, 8, 8)).x) == 0


def test_merged():
    one, other, both = mapped(AHEAD), mapped(LEFT), mapped(AHEAD, LEFT)
    one.merge(other)
    assert one.step == 2 and same(one.extract(), both.extract()) and one.count[:2] == both.count[:2]
    turned = cubemap.Octree(0.05, 8)
    turned.merge(other, Pose(position=(-0.5, 0, 0)))
    assert abs(len(turned.extract().x) - len(other.extract().x)) < 0.1 * len(other.extract().x)
    assert not same(turned.extract(), other.extract())
    with pytest.raises(cubemap.Error):
        one.merge(cubemap.Octree(0.05, 8, rule="log-odds"))
    with pytest.raises(cubemap.Error):
        one.merge(one)


@pytest.mark.parametrize("paged", [False, True])
def test_kept(paged):
    store, whole = cubemap.Store(), mapped(AHEAD, LEFT)
    made = mapped(AHEAD, LEFT, **({"memory": 100_000, "pages": store} if paged else {}))
    assert (made.count.paged > 0) == paged and made.user_data == b""
    made.save(store, b"by hand")
    back = cubemap.Octree.load(store, memory=100_000 * paged, pages=paged)
    assert back.user_data == b"by hand" and back.step == 2 and back.options == whole.options
    for one in (made, back):
        one.update_points(AHEAD.position, [[1.5, 0.2, 1.1]])
    whole.update_points(AHEAD.position, [[1.5, 0.2, 1.1]])
    assert same(back.extract(), whole.extract()) and same(made.extract(), whole.extract())
    with pytest.raises(cubemap.Error):
        cubemap.Octree.load(cubemap.Store())


def test_points_of_another_sensor():
    made = cubemap.Octree(0.05, 8)
    points = np.array([[1.02, 0.01, 0.01], [0.01, 1.02, 0.01], [np.nan, 0, 0]])
    made.update_points((0.01, 0.01, 0.01), points, np.array([[255, 0, 0], [0, 255, 0], [9, 9, 9]], np.uint8))
    found = made.at([[1.02, 0.01, 0.01], [0.5, 0.01, 0.01], [0.01, 1.02, 0.01]], 0)
    assert found.state.tolist() == [OCCUPIED, FREE, OCCUPIED]
    assert found.color[0].tolist() == [255, 0, 0] and found.color[2].tolist() == [0, 255, 0]
    ends = cubemap.Octree(0.05, 8, endpoints_only=True)
    ends.update_points((0.01, 0.01, 0.01), points)
    found = ends.at([[1.02, 0.01, 0.01], [0.5, 0.01, 0.01]], 0)
    assert found.state.tolist() == [OCCUPIED, UNKNOWN] and ends.options["endpoints_only"] and ends.count.free == 0
    for wrong in (points[:, :2], points[0]):
        with pytest.raises(ValueError):
            made.update_points((0, 0, 0), wrong)
    with pytest.raises(ValueError):
        made.update_points((0, 0, 0), points, np.zeros((2, 3), np.uint8))
    with pytest.raises(cubemap.Error):
        made.update_points((0, np.inf, 0), points)


def test_pictures(room):
    depth, color = view(AHEAD)
    for threads in (1, 2):
        seen = mapped(AHEAD, threads=threads).render(CAMERA, AHEAD)
        middle = np.s_[20:50, 30:60]
        assert np.nanmedian(np.abs(seen.depth - depth)[middle]) < 0.08 and seen.color.dtype == np.float32
        assert np.median(np.abs(255 * seen.color - color)[middle]) < 4
        assert threads == 1 or np.array_equal(seen.color, first.color)
        first = seen
    small = room.render(CAMERA, AHEAD, depth=False, dtype="uint8", channels=4, background=(0, 0, 1))
    assert small.depth is None and small.color.shape == (72, 96, 4) and small.color[36, 48, 3] == 255
    around = room.render(AROUND, Pose(position=AHEAD.position), color=False)
    assert around.color is None and np.isnan(around.depth).any() and np.isfinite(around.depth).any()
    lit = room.render(CAMERA, AHEAD, light=(0.5, -1.0, 2.4), coarsest=2)
    assert not np.array_equal(lit.color, first.color)
    canvas = cubemap.Raster(CAMERA)
    canvas.triangles([[1, -0.5, 1], [1, 0.5, 1], [1, 0, 1.6]], pose=AHEAD)
    red = np.zeros((72, 96, 3)) + (1, 0, 0)
    with_mesh = room.render(CAMERA, AHEAD, mesh=canvas, mesh_color=red)
    shown = canvas.read()[1] != cubemap.NO_ID
    assert shown.any() and np.abs(with_mesh.depth[shown] - 0.9).max() < 1e-3
    assert (with_mesh.color[shown] > 0.99).any(0).tolist() == [True, False, False]
    for wrong in ({"channels": 2}, {"dtype": "float64"}, {"far": -1.0}, {"mesh_color": red[1:]}, {"light": (0, 0)}):
        with pytest.raises(ValueError):
            room.render(CAMERA, AHEAD, **wrong)


@pytest.mark.parametrize("outside_survives", [False, True])
def test_hulls(outside_survives):
    ball = cubemap.Scene([cubemap.Primitive.sphere((0, 0, 0), 0.5)])
    down = Pose([[1, 0, 0], [0, -1, 0], [0, 0, -1]], (0, 0, 3))
    front = Pose([[0, 1, 0], [0, 0, -1], [-1, 0, 0]], (3, 0, 0))
    masks = [(CAMERA, pose, np.isfinite(ball.render(CAMERA, pose).distance).astype(np.uint8)) for pose in (down, front)]
    hull = cubemap.Octree(0.1, 5, threads=2)
    hull.carve_hull(masks, outside_survives=outside_survives)
    assert hull.at((0, 0, 0), 0).state == OCCUPIED and hull.at((0, 0.9, 0), 0).state == FREE
    assert hull.at((-1.5, -1.5, -1.5), 0).state == FREE and 400 < hull.count.occupied < 3000
    with pytest.raises(cubemap.Error):
        hull.carve_hull(masks)
    with pytest.raises(cubemap.Error):
        cubemap.Octree(0.1, 5).carve_hull([])


def test_what_was_measured_decides():
    free = []
    for kind, factor in (("depth", 1.0), ("range", np.linalg.norm(np.stack(CAMERA.ray(*CAMERA.pixels())), axis=0))):
        made = cubemap.Octree(0.05, 8, far=2.5)
        depth = view(AHEAD)[0] * factor
        made.update((1000 * depth).round().astype(np.uint16), CAMERA, AHEAD, unit=1e-3, kind=kind)
        assert made.at((2.99, 0.05, 1.2), 0).state == UNKNOWN and made.at((1.0, 0.05, 1.2), 0).state == FREE
        free.append(made.count.free)
    assert abs(free[0] - free[1]) < 0.01 * free[0]  # what is taken for depth and is range reaches farther, 20 % at corners
    around = cubemap.Octree(0.05, 8)
    around.update(*(view(Pose(position=AHEAD.position), AROUND)[:1]), AROUND, Pose(position=AHEAD.position))
    assert around.at([(2.99, 0.05, 1.2), (-2.99, 0.05, 1.2)], 0).state.tolist() == [OCCUPIED] * 2
    before = around.count
    around.update(np.full(AROUND.shape, np.nan, np.float32), AROUND)
    assert around.count[:2] == before[:2]
    around.compact()
    assert around.count[:2] == before[:2] and around.count.bytes <= before.bytes


def test_same_bits():
    sets = cubemap.instruction_sets()
    first = mapped(AHEAD, LEFT).extract()
    assert all(same(mapped(AHEAD, LEFT, instructions=name, threads=2).extract(), first) for name in sets)


def test_options():
    made = cubemap.Octree(0.02, 10, centre=(1, 2, 3), rule="log-odds", hit=0.5, nearest=0.3, far=4, noise=0.01, color=False)
    options = made.options
    assert options["centre"] == (1, 2, 3) and options["rule"] == "log-odds" and options["nearest"] == 0.3 and not options["color"]
    assert cubemap.Octree(**options).options == options and repr(made).startswith("<cubemap.Octree of 10 levels")
    for wrong in ({"edge": 0.0}, {"edge": np.nan}, {"levels": 0}, {"levels": 21}, {"nearest": 2, "far": 1}, {"rule": "none"},
                  {"rule": "log-odds", "low": 1.0, "high": 0.5}, {"memory": 1000}, {"instructions": "mmx"}, {"threads": -1},
                  {"centre": (0, 0)}, {"no_return_is_free": True}):
        with pytest.raises(ValueError):
            cubemap.Octree(**{"edge": 0.1, **wrong})
    depth = view(AHEAD)[0]
    for wrong in (depth[1:], depth.astype(np.float64), depth[..., None, None]):
        with pytest.raises((TypeError, ValueError)):
            made.update(wrong, CAMERA, AHEAD)
    with pytest.raises(cubemap.Error):
        made.extract(11)


def test_objects_of_other_kinds_are_refused():
    """The library would take their handles for what it asked for."""
    camera, octree, other = cubemap.Camera(16, 12, 12, 12, 7.5, 5.5), cubemap.Octree(0.1, 6), cubemap.Healpix(8)
    depth = np.ones(camera.shape, np.float32)
    for call, words in ((lambda: octree.merge(other), "other: a Octree, not Healpix"),
                        (lambda: octree.update(depth, Pose()), "camera: a Camera, not Pose"),
                        (lambda: octree.update(depth, other), "camera: a Camera, not Healpix"),
                        (lambda: octree.render(other), "camera: a Camera, not Healpix"),
                        (lambda: octree.render(camera, mesh=other), "mesh: a Raster, not Healpix"),
                        (lambda: cubemap.Octree(0.1, 6, pages=other), "pages: a Store, not Healpix"),
                        (lambda: cubemap.Raster(other), "camera: a Camera, not Healpix"),
                        (lambda: other.regrade(np.ones(768), 4), "to: a Healpix, not int")):
        with pytest.raises(TypeError, match=words):
            call()
