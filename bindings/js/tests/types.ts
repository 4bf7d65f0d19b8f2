// SPDX-License-Identifier: MIT
//
// Read by the compiler alone: the types are those of the functions, and mistakes are found.

import { CubemapError, Vector, load } from "cubemap";
import type { Cells, Grid } from "cubemap";
import { load as loadImage } from "cubemap/image";

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
// @ts-expect-error: no such option
new cubemap.Grid({ elipsoid: "WGS84" });

const image = await loadImage();
const plan = new image.Plan(new image.Surface("equirect;size=8"), new image.Surface("cube:coupled;size=8"), { filter: "ewa" });
const pictures = plan.resample([{ data: new Uint8Array(96), width: 8, height: 4, channels: 3 }], []);

export { CubemapError, cells, floats, jacobian, many, message, pictures, point };
