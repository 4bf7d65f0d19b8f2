# SPDX-License-Identifier: MIT
"""Ellipsoids, latitudes, rotations, grids, cells and regions; statistics and orientations."""

import pickle

import cubemap
import numpy as np
import pytest


def test_ellipsoids():
    earth = cubemap.Ellipsoid("WGS84")
    assert earth.a == 6378137 and abs(1 / earth.f - 298.257223563) < 1e-12 and earth in cubemap.ellipsoids()
    assert abs(4 * np.pi * earth.authalic_radius**2 / earth.area - 1) < 1e-15
    assert cubemap.Ellipsoid("6378137,298.257223563") == earth
    with pytest.raises(cubemap.Error, match="Vulcan"):
        cubemap.Ellipsoid("Vulcan")


def test_latitudes_by_vectors(root):
    files = sorted(root.glob("tests/vectors/latitudes/lat_*.txt"))
    assert len(files) == 6
    to = cubemap.LatitudeConversion("geographic", "authalic")
    back = cubemap.LatitudeConversion("authalic", "geographic")
    latitude = np.linspace(-np.pi / 2, np.pi / 2, 1001)
    assert np.abs(back.convert(to.convert(latitude)) - latitude).max() < 1e-15
    # Snyder 1987, p. 16: beta for phi = 40 degrees on Clarke 1866 is 39.8722878 degrees
    clarke = cubemap.LatitudeConversion("geographic", "authalic", "6378206.4,294.9786982")
    assert abs(np.degrees(clarke.convert(np.radians(40.0))) - 39.8722878) < 5e-8
    assert to.order > 0 and to.error < 1e-15
    x, y, z = cubemap.direction_from_lonlat(0.3, latitude)
    moved = cubemap.lonlat_from_direction(*to.convert_direction(x, y, z))
    assert np.abs(moved[1] - to.convert(latitude)).max() < 1e-15


def test_rotations():
    r = cubemap.Rotation("10,20,30")
    assert np.allclose(r.angles, (10, 20, 30)) and np.allclose(r.matrix @ r.matrix.T, np.eye(3))
    directions = np.random.default_rng(1).normal(size=(5, 7, 3))
    assert np.allclose(r.apply(directions), directions @ r.matrix.T)
    assert np.allclose(r.apply_back(r.apply(directions)), directions)
    assert cubemap.Rotation.from_angles(10, 20, 30) == r and cubemap.Rotation(r.matrix) == r
    named = cubemap.orientations()[0]
    assert np.allclose(cubemap.Rotation(named.identifier).angles, (named.lon, named.lat, named.roll))
    with pytest.raises(cubemap.Error):
        cubemap.Rotation(np.ones((3, 3)))
    with pytest.raises(ValueError):
        r.matrix[0, 0] = 2


def test_grids(random):
    grid = cubemap.Grid("seamless", rotation="10,20,30")
    lon, lat = random.uniform(-np.pi, np.pi, 1000), np.arcsin(random.uniform(-1, 1, 1000))
    back = grid.inverse_lonlat(*grid.forward_lonlat(lon, lat))
    assert np.abs(back[0] - lon).max() < 1e-12 and np.abs(back[1] - lat).max() < 1e-14
    # equal-area: each face has a sixth of the ellipsoid
    u, v = random.uniform(-1, 1, (2, 1000))
    assert np.abs(grid.area_element(np.uint8(3), u, v) * 24 / grid.ellipsoid.area - 1).max() < 1e-12
    x, y, z = cubemap.direction_from_lonlat(lon, lat)
    inside = grid.to_sphere(x, y, z)
    assert np.abs(np.stack(grid.from_sphere(*inside)) - np.stack((x, y, z))).max() < 1e-15
    face, u, v = grid.mapping.forward(*inside)
    assert np.array_equal(face, grid.forward(x, y, z)[0]) and np.abs(u - grid.forward(x, y, z)[1]).max() < 1e-15
    assert pickle.loads(pickle.dumps(grid)) == grid and cubemap.Grid() != grid and eval(repr(grid)) == grid
    assert grid.forward_distortion(np.stack((x, y, z), axis=-1)).scale.shape == (1000,)
    with pytest.raises(cubemap.Error):
        cubemap.Grid("shirley")


def test_cells_of_s2(root):
    cells = cubemap.CellGrid.s2()
    rows = [line.split() for line in (root / "tests/vectors/cells/s2.txt").read_text().splitlines() if line.startswith("P ")]
    x, y, z = (np.array([float.fromhex(row[k]) for row in rows]) for k in (1, 2, 3))
    expected = np.array([int(row[4], 16) for row in rows], np.uint64)
    assert len(rows) > 100 and np.array_equal(cells.forward(x, y, z, 30), expected)
    assert cells.is_s2 and pickle.loads(pickle.dumps(cells)) == cells


def test_cells(random):
    cells = cubemap.CellGrid("coupled")
    lon, lat = random.uniform(-np.pi, np.pi, 2000), np.arcsin(random.uniform(-1, 1, 2000))
    found = cells.forward_lonlat(lon, lat, 12)
    assert found.dtype == np.uint64 and (cubemap.cell_level(found) == 12).all()
    assert np.array_equal(cubemap.cell_parent(found, 5), cells.forward_lonlat(lon, lat, 5))
    assert np.array_equal(cells.forward_lonlat(*cells.centre_lonlat(found), 12), found)
    # databases have them as signed numbers: the same bits
    assert np.array_equal(cubemap.cell_face(found.view(np.int64)), cubemap.cell_face(found))
    for signed, cell in zip(found.view(np.int64).ravel()[:20].tolist(), found.ravel()[:20].tolist(), strict=True):
        assert cubemap.cell_parent(signed, 3) == cubemap.cell_parent(cell, 3)
    assert cubemap.cell_face(-1 << 63) == cubemap.cell_face(1 << 63)
    for beyond in (1 << 64, -1 << 64):
        with pytest.raises(OverflowError):
            cubemap.cell_face(beyond)
    assert cubemap.parse_cell(cubemap.cell_token(found[0])) == found[0]
    around, count = cells.neighbours(found)
    assert around.shape == (2000, 8) and (count >= 7).all()
    assert cells.corners(found[:10]).shape == (10, 4, 3) and cells.neighbours(int(found[0]))[1] == 8
    six = cubemap.normalise_cells(cubemap.cell_at_index(1, np.arange(24)))
    assert len(six) == 6 and abs(cells.area(six).sum() / cells.grid.ellipsoid.area - 1) < 1e-9
    assert cubemap.cells_contain(six, found[0]) and cubemap.cells_intersect(six[:1], six[0])
    assert len(cells.neighbours_at(found[0], 14)) == 20
    with pytest.raises(cubemap.Error):
        cells.forward_lonlat(0.0, 0.0, 31)
    with pytest.raises(cubemap.Error):
        cubemap.parse_cell("not a cell")


def test_coverings(random):
    cells = cubemap.CellGrid()
    cap = cubemap.Region.cap(0.3, 0.4, cubemap.cap_radius(200e3))
    outer, inner = cells.cover(cap, 0, 10), cells.cover(cap, 0, 10, inner=True)
    area = 2 * np.pi * (1 - np.cos(200e3 / 6371e3)) * 6371e3**2
    assert cells.area(inner).sum() < area * 1.01 and cells.area(outer).sum() > area * 0.99
    assert len(cells.cover(cap, 0, 20, most=10)) <= 10
    normals = random.normal(size=(2000, 3)) * 0.02 + cubemap.direction_from_lonlat(0.3, 0.4)
    inside = cap.contains(normals)
    leaves = cells.forward(*normals.T, 30)
    covered = np.array([cubemap.cells_contain(outer, leaf) for leaf in leaves])
    assert inside.any() and not inside.all() and covered[inside].all()
    box = cubemap.Region.box(0, 0, 0.1, 0.1)
    assert box.contains(cubemap.direction_from_lonlat(0.05, 0.05)) and pickle.loads(pickle.dumps(box)) == box
    ring = cubemap.Region.polygon([(0, 0), (0.1, 0), (0.1, 0.1), (0, 0.1)], [(0.04, 0.04), (0.04, 0.06), (0.06, 0.06), (0.06, 0.04)])
    assert not ring.contains(cubemap.direction_from_lonlat(0.05, 0.05)) and ring.contains(cubemap.direction_from_lonlat(0.02, 0.02))
    assert eval(repr(ring)) == ring
    with pytest.raises(cubemap.Error):
        cubemap.Region.cap(0, 0, -1)


def test_statistics_of_papers():
    found = cubemap.statistics("gnomonic", "area", over="sphere")
    assert abs(found.mean - 1) < 1e-9 and found.ratio == pytest.approx(3**1.5, rel=1e-9)
    assert cubemap.statistics("seamless", "area").rmse < 1e-12
    value, doubt = cubemap.percentiles("coupled", "isotropy", [0, 50, 100])
    assert value[0] <= value[1] <= value[2] and (doubt >= 0).all()
    with pytest.raises(ValueError):
        cubemap.statistics("coupled", "beauty")
    with pytest.raises(cubemap.Error):
        cubemap.statistics("shirley")


def test_orient():
    mask = np.zeros((30, 60), np.float32)
    mask[5:12, 20:35] = 1
    found = cubemap.orient("coupled", mask, boxes_max=100)
    assert found.after < found.before
    assert cubemap.orient_value("coupled", mask, found.rotation) == pytest.approx(found.after, rel=1e-12)
    assert cubemap.orient_value("coupled", mask, "0,0,0") == pytest.approx(found.before, rel=1e-12)


def test_advice():
    size = cubemap.advise_size("coupled", 1e-3)
    assert size.pixels <= size.power < 2 * size.pixels and size.coarsest <= 1e-3
    assert cubemap.advise_precision("coupled", 10.0).precision == "float"
    assert cubemap.advise_terms("geographic", "authalic", 1e-3).terms < cubemap.advise_terms("geographic", "authalic", 0).terms


def test_matrices_that_are_no_rotations():
    for matrix in (2 * np.eye(3), np.full((3, 3), np.nan), np.diag([1.0, 1.0, -1.0])):
        with pytest.raises(cubemap.Error, match="rows are not of length 1, at right angles and right-handed"):
            cubemap.Rotation(matrix)
