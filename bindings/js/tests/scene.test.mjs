// SPDX-License-Identifier: MIT
//
// Cameras, depth images, worlds and octrees: bits of the native library's plain C, what users call, objects' lives.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test from "node:test";

import { CameraError, DataError, OutOfRangeError, hasSimd, load } from "cubemap/scene";

const [width, height] = [64, 48];
const pixels = width * height;
const lens = { width, height, fx: 40, fy: 41, cx: 31.5, cy: 23.5, distortion: [-0.1, 0.02, 0.001, -0.0005] };
const numbers = Array.from({ length: pixels }, (_, i) => i);
const columns = numbers.map((i) => i % width);
const rows = numbers.map((i) => Math.floor(i / width));

/** As pose_of of native_scene.c. */
function poseOf(view) {
    const [x, y] = [[1, 0], [0, 1], [-1, 0]][view];
    return { rotation: { row: [y, -x, 0, 0, 0, -1, x, y, 0] }, position: [0.1 * view, -0.05 * view, 1.25] };
}

/** Distances along the rays of a camera, which are depths. */
function look(scene, { x, y, z }, pose) {
    const { row } = pose.rotation;
    const turned = [0, 1, 2].map((k) => x.map((_, i) => row[k] * x[i] + row[3 + k] * y[i] + row[6 + k] * z[i]));
    const origin = pose.position.map((value) => new Float64Array(x.length).fill(value));
    return scene.cast(...origin, ...turned);
}

const viewOf = (camera, view, distance) => ({ camera, pose: poseOf(view), depthUnit: 1,
    depth: { data: Float32Array.from(distance), width, height } });

function same(is, wanted, what) {
    assert.equal(is.length, wanted.length, what);
    const at = is.findIndex((value, i) => !Object.is(value, wanted[i]) && !(Number.isNaN(value) && Number.isNaN(wanted[i])));
    assert.equal(at, -1, `${what}, ${at}: ${is[at]}, but natively ${wanted[at]}`);
}

function sameVoxels(voxels, next, what) {
    const [count] = next(Float64Array, 1);
    assert.ok(count > 10, what);
    const wanted = next(Float64Array, 5 * count);
    same(Float64Array.from(wanted, (_, i) => {
        const [voxel, k] = [Math.floor(i / 5), i % 5];
        return k < 3 ? voxels.centre[3 * voxel + k] : [voxels.edge, voxels.alpha][k - 3][voxel];
    }), wanted, what);
    assert.equal(voxels.edge.length, count);
}

/** A map of the room from three places. */
function mapOf(lib, { compare = () => {}, options = {} } = {}) {
    const camera = new lib.Camera(lens);
    const scene = lib.Scene.named("room");
    const octree = new lib.Octree({ edge: 0.05, levels: 9, ...options });
    const rays = camera.ray(columns, rows);
    let hit;
    for (let view = 0; view < 3; view++) {
        hit = look(scene, rays, poseOf(view));
        compare(hit.distance, `distances of view ${view}`);
        octree.update(viewOf(camera, view, hit.distance));
    }
    return { camera, scene, octree, hit };
}

for (const simd of hasSimd() ? [false, true] : [false]) {
    test(`bits of cameras, depths and maps, ${simd ? "with" : "without"} vectors`, async () => {
        const bytes = await readFile(process.env.CUBEMAP_NATIVE_SCENE);
        let at = 0;
        const next = (Type, n) => {
            const size = n * Type.BYTES_PER_ELEMENT;
            assert.ok(at + size <= bytes.length, "the vectors end early");
            at += size;
            return new Type(bytes.buffer.slice(bytes.byteOffset + at - size, bytes.byteOffset + at));
        };
        const lib = await load({ simd });
        const camera = new lib.Camera(lens);
        const { x, y, z } = camera.ray(columns, rows);
        same(x, next(Float64Array, pixels), "x of rays");
        same(y, next(Float64Array, pixels), "y of rays");
        const { column, row } = camera.project(x, y, z);
        same(column, next(Float64Array, pixels), "columns");
        same(row, next(Float64Array, pixels), "rows");
        const { octree, hit } = mapOf(lib, { compare: (distance, what) => same(distance, next(Float64Array, pixels), what) });
        const depth = Float32Array.from(hit.distance);
        const rays = new lib.Rays(camera);
        const maps = rays.maps(depth);
        [...maps.vertex, ...maps.normal, maps.radius].forEach((plane, k) => same(plane, next(Float32Array, pixels), `map ${k}`));
        same(rays.smooth(depth, 2, 0.05), next(Float32Array, pixels), "smoothed");
        sameVoxels(octree.extract(), next, "voxels");
        sameVoxels(octree.extract(3), next, "voxels of level 3");
        assert.equal(at, bytes.length, "the vectors have more");
    });
}

const lib = await load();

test("a map says what is where", () => {
    const { octree } = mapOf(lib);
    assert.equal(octree.step, 3n);
    // the wall at x = 3, the air before it, what nobody saw
    assert.equal(octree.at([2.99, 0.3, 1.8]).state, "occupied");
    assert.equal(octree.at([1, 0, 1.4]).state, "free");
    assert.equal(octree.at([0, 0, -1]).state, "unknown");
    const struck = octree.ray([0, 0.2, 1.8], [2, 0, 0], 0);
    assert.ok(struck.state === "occupied" && Math.abs(struck.distance - 3) < 0.1, `the wall is ${struck.distance} away`);
    assert.equal(octree.ray([0, 0.2, 1.8], [2, 0, 0], 1), null);
    assert.ok(octree.nearest([2.9, 0.2, 1.8], 0.5).distance < 0.15);
    assert.equal(octree.nearest([0, 0, 1.4], 0.1), null);
    const { occupied, free, bytes } = octree.count;
    assert.equal(Number(occupied), octree.extract().edge.length);
    assert.ok(free > occupied && bytes > 0n);
    octree.compact();
    assert.equal(octree.count.occupied, occupied);
    assert.equal(octree.options.rule, "counts");
});

test("walks call a function for each voxel", () => {
    const { octree } = mapOf(lib);
    const along = [];
    octree.walkRay([0, 0.2, 1.8], [1, 0, 0], 0, (voxel) => { along.push(voxel.state); });
    assert.ok(along.includes("occupied") && along[0] === "free");
    let visited = 0;
    octree.walkBox([-3.1, -2.6, -0.1], [3.1, 2.6, 3.1], (voxel) => { visited += voxel.state === "occupied" ? 1 : 0; });
    assert.ok(visited > 100);
    let all = 0;
    octree.walkBox([-1, -1, 1], [1, 1, 2], () => ++all === 5);
    assert.equal(all, 5);
    assert.throws(() => octree.walkBox([-1, -1, 1], [1, 1, 2], () => { throw new Error("mine"); }), /^Error: mine$/);
    // what a walk reads stays as it is until its end; reading it is allowed
    for (const change of [() => octree.free(), () => octree.compact(), () => octree.save(new lib.Store()),
        () => octree.updatePoints([0, 0, 1.2], Float32Array.of(0.5, 0.5, 1.2), Uint8Array.of(255, 0, 0)),
        () => octree.walkRay([0, 0.2, 1.8], [1, 0, 0], 0, () => octree.free())]) {
        assert.throws(() => octree.walkBox([-1, -1, 1], [1, 1, 2], change), /^ReferenceError: the Octree is being read: /);
    }
    let read = 0;
    octree.walkBox([-1, -1, 1], [1, 1, 2], ({ x, y, z }) => { octree.walkRay([0, 0.2, 1.8], [1, 0, 0], 0, () => { read++; }); octree.at([x, y, z]); });
    assert.ok(read > 100);
    const since = octree.step;
    octree.updatePoints([0, 0, 1.2], Float32Array.of(0.5, 0.5, 1.2), Uint8Array.of(255, 0, 0));
    let changed = 0;
    octree.walkChanges(since, () => { changed++; });
    assert.ok(changed > 0);
});

test("maps are kept, loaded and merged", () => {
    const { octree } = mapOf(lib);
    const store = new lib.Store();
    octree.save(store, new TextEncoder().encode("a room"));
    const again = lib.Octree.load(store);
    assert.deepEqual(again.extract(), octree.extract());
    assert.equal(new TextDecoder().decode(again.userData), "a room");
    const other = new lib.Octree({ edge: 0.05, levels: 9 });
    other.merge(again);
    assert.deepEqual(other.extract(), octree.extract());
    assert.throws(() => lib.Octree.load(new lib.Store()), DataError);
});

test("stores", () => {
    const store = new lib.Store();
    store.put("b", { kind: 7, version: 1, data: Uint8Array.of(1, 2, 3) });
    store.put(Uint8Array.of(97), { kind: 7, version: 2, data: new Uint8Array(0) });
    store.commit();
    assert.deepEqual(store.get("b", 7, 1), { kind: 7, version: 1, data: Uint8Array.of(1, 2, 3) });
    assert.equal(store.get("c", 7, 1), null);
    assert.throws(() => store.get("a", 7, 1), (error) => error.name === "VersionError" && error.code === 21);
    assert.deepEqual([store.next(), store.next("a"), store.next("b")], [Uint8Array.of(97), Uint8Array.of(98), null]);
    store.remove("b");
    store.rollback();
    assert.equal(store.get("b", 7, 1).data.length, 3);
    assert.throws(() => store.put("", { data: new Uint8Array(0) }), { name: "ArgumentError" });
    assert.throws(() => store.put("d", { data: [1] }), TypeError);
});

test("maps in pages need their store", () => {
    const pages = new lib.Store();
    const { octree } = mapOf(lib, { options: { pages, memory: 200000n } });
    assert.ok(octree.count.paged > 0n);
    assert.deepEqual(octree.extract().edge.length, mapOf(lib).octree.extract().edge.length);
    pages.free();
    assert.throws(() => octree.extract(), /the Store has been freed/);
    octree.free();
});

test("a map is drawn, behind what a canvas has", () => {
    const { octree, camera, hit } = mapOf(lib, { options: { color: 1 } });
    const { color, depth } = octree.render(camera, poseOf(2));
    assert.ok(color.data instanceof Uint8Array && color.channels === 4);
    const middle = width * height / 2 + width / 2;
    assert.ok(Math.abs(depth.data[middle] - hit.distance[middle]) < 0.15, `${depth.data[middle]}, but ${hit.distance[middle]}`);
    const only = { color: { data: new Float32Array(3 * pixels), width, height, channels: 3 } };
    assert.equal(octree.render(camera, poseOf(2), { background: [1, 0, 0], light: 1, lightPosition: [0, 0, 2] }, only), only);
    const raster = new lib.Raster(camera);
    raster.triangles(poseOf(2), { position: [-0.8, -5, -5, -0.8, 5, -5, -0.8, 0, 9] });
    const before = raster.read().image[middle];
    assert.ok(Math.abs(before - 1) < 1e-6);
    const hidden = octree.render(camera, poseOf(2), { mesh: raster, meshColor: new Float32Array(3 * pixels).fill(0.5) });
    assert.notDeepEqual(hidden.color.data, color.data);
    assert.throws(() => octree.render(camera, poseOf(2), { mesh: raster, meshColor: new Float32Array(3) }), RangeError);
});

test("hulls", () => {
    const camera = new lib.Camera({ width: 32, height: 32, fx: 32, fy: 32, cx: 15.5, cy: 15.5 });
    const data = new Uint8Array(32 * 32).map((_, i) => (Math.hypot(i % 32 - 15.5, Math.floor(i / 32) - 15.5) < 8 ? 255 : 0));
    const mask = (row, position) => ({ camera, pose: { rotation: { row }, position },
        color: { data, width: 32, height: 32, channels: 1 } });
    const octree = new lib.Octree({ edge: 1 / 16, levels: 5 });
    octree.carveHull([mask([1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 0, -2]), mask([0, 0, -1, 0, 1, 0, 1, 0, 0], [-2, 0, 0])], true);
    assert.equal(octree.at([0, 0, 0]).alpha, 255);
    assert.equal(octree.at([0.9, 0.9, 0.9]).alpha, 0);
    assert.throws(() => octree.carveHull([], true), { name: "ArgumentError" });
});

test("cameras", async () => {
    const camera = new lib.Camera(lens);
    assert.deepEqual(camera.options.distortion.slice(0, 4), lens.distortion);
    assert.equal(camera.hasRay(31.5, 23.5), true);
    assert.equal(camera.jacobian([0, 0, 2])[0], 20);
    assert.ok(Math.abs(camera.solidAngle(31.5, 23.5) * 40 * 41 - 1) < 1e-9);
    assert.ok(camera.border(0) > 1);
    const half = camera.halved();
    assert.deepEqual([half.options.width, half.options.height, half.options.fx], [32, 24, 20]);
    const mapping = new lib.Mapping("coupled");
    const around = new lib.Camera({ width: 16, height: 96, mapping });
    mapping.free(); // the camera has a copy
    const { x, y, z } = around.ray(7.5, 7.5);
    assert.ok(Math.abs(Math.hypot(x, y, z) - 1) < 1e-15);
    const place = around.project(x, y, z);
    assert.ok(Math.abs(place.column - 7.5) < 1e-12 && Math.abs(place.row - 7.5) < 1e-12);
    assert.throws(() => new lib.Camera({ width: 4, height: 4 }), CameraError);
    assert.throws(() => new lib.Camera({ width: 4, focal: 4 }), /cameraOptions has no 'focal'/);
    const core = await import("cubemap");
    const foreign = new (await core.load()).Mapping("coupled");
    assert.throws(() => new lib.Camera({ width: 16, height: 96, mapping: foreign }), /mapping is to be a Mapping/);
});

test("depth images", () => {
    const camera = new lib.Camera({ width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5 });
    const stored = new Uint16Array(48).fill(10000);
    stored[0] = 0;
    const { depth, count } = lib.cleanDepth({ data: stored, width: 8, height: 6 }, { unit: 1 / 5000 });
    assert.deepEqual([count.valid, count.zero, depth[1], Number.isNaN(depth[0])], [47, 1, 2, true]);
    const rays = new lib.Rays(camera);
    assert.deepEqual([rays.pixelCount, rays.halvedPixelCount], [48, 12]);
    const range = rays.toRange(depth);
    assert.ok(Math.abs(range[47] - 2 * Math.hypot(1, 3.5 / 8, 2.5 / 8)) < 1e-6);
    const here = lib.float32(48);
    assert.equal(rays.fromRange(range, { depth: here }), here.array);
    assert.ok(Math.abs(here.array[47] - 2) < 1e-6);
    const { vertex, normal, radius } = rays.maps(depth);
    assert.ok(Math.abs(vertex[0][47] - 2 * 3.5 / 8) < 1e-6 && Math.abs(normal[2][27] + 1) < 1e-6);
    assert.ok(Math.abs(radius[27] - 2 * Math.SQRT2 / 8) < 1e-6);
    assert.equal(rays.maps(depth, { normal: false }).normal, null);
    assert.deepEqual([...rays.halve(depth, 0.05)], new Array(12).fill(2));
    const pyramid = new lib.DepthPyramid(8, 6);
    pyramid.fill(depth);
    assert.equal(pyramid.last, 1);
    const level = pyramid.level(1);
    assert.deepEqual([level.width, level.height, level.least[0], level.most[11]], [4, 3, -2, 2]);
    assert.deepEqual(pyramid.bounds(4, 2, 7, 5), { least: 2, most: 2, hasUnmeasured: 0 });
    assert.throws(() => rays.toRange(new Float32Array(47)), /depth has 47 elements, but is to have 48/);
    assert.throws(() => rays.smooth(depth, -1, 1), OutOfRangeError);
});

test("worlds, meshes and what is drawn of them", () => {
    const corners = { position: [0, 0, 0, 1, 0, 0, 0, 1, 0], index: [0, 1, 2], material: { color: [1, 0.5, 0], reflectance: 0.5 } };
    const mesh = new lib.Mesh(corners);
    assert.deepEqual([...mesh.options.index], [0, 1, 2]);
    assert.equal(mesh.options.vertexCount, 3);
    assert.equal(mesh.options.uv, null);
    assert.deepEqual([...mesh.bounds.greatest], [1, 1, 0]);
    assert.equal(new lib.Mesh(mesh.options).options.triangleCount, 1);
    assert.throws(() => new lib.Mesh({ ...corners, index: [0, 1] }), RangeError);
    assert.throws(() => new lib.Mesh({ ...corners, index: [0, 1, 3] }), { name: "ArgumentError" });
    const scene = new lib.Scene();
    const one = [1, 0, 0, 0, 1, 0, 0, 0, 1];
    assert.equal(scene.add({ kind: "mesh", mesh, pose: { rotation: { row: one } }, material: { color: [1, 1, 1], reflectance: 1 } }), 0);
    assert.equal(scene.add({ kind: "sphere", first: [0, 0, -4], radius: 1, material: { color: [0, 0, 1], reflectance: 1 } }), 1);
    assert.equal(scene.count, 2);
    assert.equal(scene.at(1).kind, "sphere");
    const hit = scene.cast([0.25, 0, 9], [0.25, 0, 9], [2, -1, 9], [0, 0, 0], [0, 0, 0], [-1, -1, 1]);
    assert.deepEqual([...hit.distance], [2, 2, Infinity]);
    assert.deepEqual([...hit.id], [0, 1, 2 ** 32 - 1]);
    assert.deepEqual([hit.color[0][0], hit.color[1][0], hit.reflectance[0]], [1, 0.5, 0.5]);
    assert.equal(hit.normal[2][1], 1);
    assert.throws(() => scene.cast([0.25, 0, 9], [0.25, 0, 9], 2, [0, 0, 0], [0, 0, 0], [-1, -1, 1]), TypeError);
    mesh.free();
    assert.throws(() => scene.cast([0], [0], [0], [0], [0], [1]), /the Mesh has been freed/);
    assert.equal(lib.Scene.nameAt(0), "room");
    assert.equal(lib.Scene.nameAt(99), null);
    const camera = new lib.Camera({ width: 8, height: 8, fx: 8, fy: 8, cx: 3.5, cy: 3.5 });
    const raster = new lib.Raster(camera);
    raster.triangles(null, { position: [-9, -9, 2, 9, -9, 2, 0, 9, 2], firstId: 7 });
    raster.points(null, { position: [0.0625, 0.0625, 1] });
    raster.discs(null, { centre: [[0], [0], [3]], normal: [[0], [0], [1]], radius: [9], firstId: 20 });
    const { image, id } = raster.read();
    assert.deepEqual([image[27], id[27], image[36], id[36]], [2, 7, 1, 0]);
    const { second, third } = raster.weights(null, { position: [-9, -9, 2, 9, -9, 2, 0, 9, 2], firstId: 7 });
    assert.ok(second[27] > 0 && third[27] > 0 && second[27] + third[27] < 1 && Number.isNaN(second[36]));
    raster.clear();
    assert.ok(Number.isNaN(raster.read().image[27]));
    camera.free();
    assert.throws(() => raster.read(), /the Camera has been freed/);
});

test("trajectories", () => {
    const pose = (x) => ({ rotation: { row: [1, 0, 0, 0, 1, 0, 0, 0, 1] }, position: [x, 0, 0] });
    const stamps = [0, 1, 2, 3];
    const path = new lib.Trajectory(stamps, stamps.map((t) => pose(t * t)));
    assert.equal(path.count, 4);
    assert.deepEqual(path.at(2).pose.position, [4, 0, 0]);
    assert.equal(path.nearest(1.2, 0.5), 1);
    assert.equal(path.interpolate(0.5).position[0], 0.5);
    assert.throws(() => path.interpolate(9), OutOfRangeError);
    const other = new lib.Trajectory(stamps.map((t) => t + 0.001), stamps.map((t) => pose(t * t + 5)));
    assert.deepEqual(path.associate(other, 0.01), { indexA: Uint32Array.of(0, 1, 2, 3), indexB: Uint32Array.of(0, 1, 2, 3) });
    const evaluation = path.evaluate(other, { interval: 0.5 });
    assert.ok(evaluation.pairs === 4 && evaluation.ateRmse < 1e-12 && evaluation.rank === 1);
    const motion = new lib.Motion(path);
    path.free(); // the curve has its own numbers
    assert.ok(Math.abs(motion.at(1.5).velocity[0] - 3) < 1e-9);
    const measured = motion.inertial({ rate: 10, gravity: [0, 0, -9.81] });
    assert.deepEqual([measured.stamp.length, measured.acceleration.length, measured.rate.length], [31, 93, 93]);
    assert.ok(Math.abs(measured.acceleration[45] - 2) < 1e-6 && Math.abs(measured.acceleration[47] - 9.81) < 1e-6);
    assert.throws(() => new lib.Trajectory([0, 0], [pose(0), pose(1)]), (error) => error instanceof DataError && error.message.endsWith("at index 1"));
    const { motion: moved, rank } = lib.Pose.align([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1]);
    assert.ok(rank === 3 && Math.abs(moved.position[0] - 5) < 1e-12);
});

test("budgets", () => {
    const entry = [{ name: "distortion", contribution: 0.004, cost: 2.1 }, { name: "multipath", contribution: 0.001, cost: 46 },
        { name: "noise", contribution: 0.0005, cost: 1, isRequired: 1 }];
    const budget = { subject: "depth camera", unit: "m", costUnit: "ms", entry };
    const kept = lib.budgetLimitError(budget, 0.002);
    assert.deepEqual(kept.entry.map(({ name, isKept }) => [name, isKept]), [["distortion", 1], ["multipath", 0], ["noise", 1]]);
    assert.deepEqual([kept.error, kept.cost, kept.subject, kept.costUnit], [0.001, 3.1, "depth camera", "ms"]);
    assert.ok(kept.entry.every(({ reason, unit }) => reason.length > 5 && unit === null));
    assert.equal(entry[0].isKept, undefined);
    assert.deepEqual(lib.budgetLimitCost(budget, 1.5).entry.filter(({ isKept }) => isKept).map(({ name }) => name), ["noise"]);
    assert.equal(lib.budgetLimitCost(budget, 100).error, 0);
    assert.ok(Math.abs(lib.budgetSum(budget).error - 0.0055) < 1e-15);
    assert.deepEqual(lib.budgetSum(kept), kept);
    const read = JSON.parse(lib.budgetJson(kept));
    assert.deepEqual([read.subject, read.error, read.entries.map((one) => one.kept)], ["depth camera", 0.001, [true, false, true]]);
    assert.equal(read.entries[0].reason, kept.entry[0].reason);
    assert.deepEqual(lib.budgetSum({}).entry, []);
    assert.equal(JSON.parse(lib.budgetJson({})).subject, null);
    assert.throws(() => lib.budgetLimitCost(budget, 0.5), (error) => error.code === 15);
    assert.throws(() => lib.budgetLimitError(budget, -1), OutOfRangeError);
    assert.throws(() => lib.budgetLimitError(budget, NaN), OutOfRangeError);
    assert.throws(() => lib.budgetSum({ entry: [{ contribution: 1, unit: "km" }], unit: "m" }), (error) => error.code !== 0);
    assert.throws(() => lib.budgetSum({ entries: [] }), TypeError);
    // in many calls nothing is left behind
    const before = lib.memory.buffer.byteLength;
    for (let i = 0; i < 20000; i++) {
        lib.budgetLimitError(budget, 0.002);
    }
    assert.equal(lib.memory.buffer.byteLength, before);
});

test("arrays of random numbers are those of their pixels", () => {
    const one = (draw, ...more) => Float64Array.from({ length: 1000 }, (_, i) => draw(20n, 3, 7 + i, 2, ...more.map((list) => list[i])));
    assert.deepEqual(lib.randomUniformArray(20n, 3, 7, 2, 1000), one(lib.randomUniform));
    assert.deepEqual(lib.randomNormalArray(20n, 3, 7, 2, 1000), one(lib.randomNormal));
    const mean = Float64Array.from({ length: 1000 }, (_, i) => i / 7);
    assert.deepEqual(lib.randomPoissonArray(20n, 3, 7, 2, mean), one(lib.randomPoisson, mean));
    assert.equal(lib.randomPoissonArray(20n, 3, 7, 2, 12.5), lib.randomPoisson(20n, 3, 7, 2, 12.5));
    const there = lib.float64(1000);
    assert.equal(lib.randomNormalArray(20n, 3, 7, 2, 1000, { value: there }).buffer, lib.memory.buffer);
    assert.deepEqual(Float64Array.from(there.array), one(lib.randomNormal));
    assert.equal(lib.randomUniformArray(20n, 3, 7, 2, 0).length, 0);
    for (const n of [-1, 1.5, NaN, undefined, "3"]) {
        assert.throws(() => lib.randomUniformArray(20n, 3, 7, 2, n), RangeError);
    }
});

test("arguments of other types are refused", () => {
    const { octree, camera } = mapOf(lib);
    assert.throws(() => octree.update({ camera, pose: poseOf(0), depth: { data: [1], width: 1, height: 1 }, depthUnit: 1 }), TypeError);
    assert.throws(() => octree.update({ camera, pose: poseOf(0), depth: { data: new Float32Array(3), width: 2, height: 2 }, depthUnit: 1 }), RangeError);
    assert.throws(() => octree.update({ camera: octree, pose: poseOf(0) }), /camera is to be a Camera/);
    assert.throws(() => new lib.Octree({ edge: 0.1, levels: 4, rule: "guess" }), /rule is 'guess', but is to be one of counts, log-odds/);
    assert.throws(() => octree.updatePoints([0, 0, 0], new Float32Array(4)), RangeError);
    assert.throws(() => octree.extract(99), OutOfRangeError);
});
