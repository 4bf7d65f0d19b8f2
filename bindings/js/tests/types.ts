// SPDX-License-Identifier: MIT
//
// Read by the compiler alone: the types are those of the functions, and mistakes are found.

import { CubemapError, Vector, load } from "cubemap";
import type { Cells, Grid } from "cubemap";
import { load as loadImage } from "cubemap/image";
import { load as loadScene } from "cubemap/scene";
import type { HitArrays, Octree, Picture, Voxel, VoxelArrays } from "cubemap/scene";

const cubemap = await load({ simd: false });
const mapping = new cubemap.Mapping("coupled", "gl", { tier: "fast" });

const point: { face: number; u: number; v: number } = mapping.forward(1, 2, 3);
const many: { face: Uint8Array; u: Float64Array; v: Float64Array } = mapping.forward([1], [2], [3]);
const floats: Float32Array = mapping.forward(new Float32Array(1), new Float32Array(1), new Float32Array(1)).u;
const vector: Vector<Float64Array> = cubemap.float64(3);
mapping.forward(vector, vector, vector, { u: vector });
const grid: Grid = new cubemap.Grid({ ellipsoid: "WGS84", latitude: "authalic" });
const cell: bigint = new cubemap.CellGrid(grid, "hilbert").forwardLonlat(30, 0.1, 0.2);
const cells: Cells = [cell];
const message: string | null = cubemap.specificationCheck("coupled");
const jacobian: Float64Array[] = mapping.forwardJacobian([1], [2], [3]);

// @ts-expect-error: no such mapping function
mapping.foreward(1, 2, 3);
// @ts-expect-error: numbers or arrays, not both
mapping.forward(1, [2], 3);
// @ts-expect-error: no such curve
new cubemap.CellGrid(grid, "peano");
// @ts-expect-error: a cell is a BigInt
cubemap.cellLevel(5);
// @ts-expect-error: a camera needs its options
() => new scene.Camera();
// @ts-expect-error: no such option
new cubemap.Grid({ elipsoid: "WGS84" });

const image = await loadImage();
const plan = new image.Plan(new image.Surface("equirect;size=8"), new image.Surface("cube:coupled;size=8"), { filter: "ewa" });
const pictures = plan.resample([{ data: new Uint8Array(96), width: 8, height: 4, channels: 3 }], []);

const scene = await loadScene();
const camera = new scene.Camera({ width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5 });
const octree: Octree = new scene.Octree({ edge: 0.05, levels: 8, rule: "log-odds", pages: new scene.Store(), memory: 1000000n });
const depth: Picture = { data: new Uint16Array(48), width: 8, height: 6 };
const pose = scene.Pose.exp([0, 0, 0, 0, 0, 1]);
octree.update({ camera, pose, depth, depthUnit: 0.001 });
const voxel: Voxel = octree.at([0, 0, 0], 0);
const struck: Voxel | null = octree.ray([0, 0, 0], [1, 0, 0], 5);
const voxels: VoxelArrays = octree.extract(2);
octree.walkBox([0, 0, 0], [1, 1, 1], ({ state }) => state === "occupied");
const hits: HitArrays = scene.Scene.named("room").cast([0], [0], [1], [1], [0], [0]);
const range: Float32Array = new scene.Rays(camera).toRange(new Float32Array(48), { range: scene.float32(48) });
new scene.Raster(camera, 0).triangles(null, { position: [0, 0, 1, 1, 0, 1, 0, 1, 1] });
new scene.Raster(camera).points(null, { position: [0, 0, 1] });
const finest: Voxel = octree.at([0, 0, 0]);
const opened: Octree = scene.Octree.load(new scene.Store());
const named: string | null = scene.Scene.nameAt(0);
const counted: bigint = octree.count.occupied;

const budget = scene.budgetLimitError({ entry: [{ name: "noise", contribution: 1, cost: 2 }], unit: "m" }, 0.5);
const why: string | null = scene.budgetSum(budget).entry[0]!.reason;
const drawn: Float64Array = scene.randomNormalArray(1n, 0, 0, 0, 10);
const counts: Float64Array = scene.randomPoissonArray(1n, 0, 0, 0, drawn, { count: scene.float64(10) });

// @ts-expect-error: a reason may be none
budget.entry[0]!.reason.length;
// @ts-expect-error: a budget has no entries, but each is an entry
scene.budgetSum({ entries: [] });
// @ts-expect-error: how many?
scene.randomUniformArray(1n, 0, 0, 0);
// @ts-expect-error: what a ray meets may be nothing
octree.ray([0, 0, 0], [1, 0, 0], 5).state;
// @ts-expect-error: no such rule
new scene.Octree({ edge: 0.05, levels: 8, rule: "odds" });
// @ts-expect-error: a camera is no map
octree.merge(camera);
// @ts-expect-error: pixels of these types are none
octree.update({ camera, depth: { data: new Float64Array(48), width: 8, height: 6 } });

export { counted, counts, finest, hits, named, opened, range, struck, voxel, voxels, why };
// @ts-expect-error: there may be no such scene
scene.Scene.nameAt(0).length;
export { CubemapError, cells, floats, jacobian, many, message, pictures, point };
