// SPDX-License-Identifier: MIT
//
// What users call: results, errors in the library's words, arrays in the module's memory, objects' lives.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test from "node:test";
import vm from "node:vm";

import { CubemapError, EllipsoidError, FrameError, MappingError, OutOfRangeError, PixelError, Vector, hasSimd, load } from "cubemap";

const cubemap = await load();

test("points and arrays", () => {
    const mapping = new cubemap.Mapping("coupled");
    const { face, u, v } = mapping.forward(2, 1, 0.5);
    assert.equal(face, 0);
    assert.equal(u.toFixed(6), "0.620558");
    assert.equal(v.toFixed(6), "0.327956");
    const back = mapping.inverse(face, u, v);
    assert.ok(Math.hypot(back.x - 2 / Math.hypot(2, 1, 0.5), back.y - 1 / Math.hypot(2, 1, 0.5)) < 1e-15);
    const many = mapping.forward([2, 0], [1, 0], [0.5, 0]);
    assert.deepEqual([...many.face], [0, 255]);
    assert.equal(many.u[0], u);
    assert.ok(Number.isNaN(many.v[1]));
    assert.deepEqual(mapping.forward([], [], []).u, new Float64Array(0));
    const floats = mapping.forward(Float32Array.of(2), Float32Array.of(1), Float32Array.of(0.5));
    assert.ok(floats.u instanceof Float32Array && Math.abs(floats.u[0] - u) < 1e-6);
    assert.equal(mapping.forwardJacobian(2, 1, 0.5).length, 6);
    assert.ok(Math.abs(mapping.forwardDistortion(2, 1, 0.5).area - 1) < 0.003);
});

test("frames, parameters, what a mapping says of itself", () => {
    const mapping = new cubemap.Mapping("tangent:c=0.5", "gl");
    assert.equal(mapping.frame.identifier, "gl");
    assert.equal(mapping.frame.face[0].name, "+x");
    assert.equal(mapping.parameter(0), 0.5);
    assert.equal(mapping.info.identifier, "tangent");
    assert.equal(mapping.tier, "exact");
    assert.equal(mapping.instructions, hasSimd() ? "wasm128" : "scalar");
    assert.equal(mapping.hasBounds, false);
});

test("errors have the library's words", () => {
    assert.throws(() => new cubemap.Mapping("cuopled"), (error) => error instanceof MappingError && error instanceof CubemapError
        && error.code === 3 && error.name === "MappingError" && error.message.startsWith("no mapping is called 'cuopled'"));
    assert.throws(() => new cubemap.Mapping("tangent:c=9"), OutOfRangeError);
    assert.throws(() => new cubemap.Healpix(63, "nested"), (error) => error instanceof PixelError
        && error.message === "nside is 63, but in the order NESTED it is a power of two");
    assert.throws(() => new cubemap.Mapping("healpix").warp(0, 0), /no such operation/);
    assert.equal(cubemap.specificationCheck("coupled"), null);
    assert.match(cubemap.specificationCheck("bogus"), /^no mapping is called 'bogus'/);
});

test("names of frames and ellipsoids that are none are of the kinds that such errors have", () => {
    const kind = (Class, code) => (error) => error.constructor === Class && error.code === code && error.message.startsWith("there is no ");
    assert.throws(() => new cubemap.Mapping("coupled", "up"), kind(FrameError, 6));
    assert.throws(() => new cubemap.Grid({ frame: "up" }), kind(FrameError, 6));
    assert.throws(() => new cubemap.Grid({ ellipsoid: "WGS1884" }), kind(EllipsoidError, 10));
    assert.throws(() => new cubemap.LatitudeConversion("WGS1884", "geographic", "authalic"), kind(EllipsoidError, 10));
});

test("where a module may come from", async () => {
    const address = new URL(import.meta.resolve === undefined ? "../dist/core-scalar.wasm" : "./core-scalar.wasm", import.meta.resolve?.("cubemap") ?? import.meta.url);
    const bytes = await readFile(address);
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    for (const source of [address, address.href, bytes, buffer, vm.runInNewContext("b => { const c = new ArrayBuffer(b.length); new Uint8Array(c).set(b); return c; }")(bytes),
        await WebAssembly.compile(bytes), null]) {
        assert.equal(new (await load({ source })).Mapping("coupled").forward(2, 1, 0.5).face, 0);
    }
    assert.ok(await load(null) && await load({ simd: null }));
    // in a page or a worker, beside it
    globalThis.location = { href: new URL("page.html", address).href };
    try {
        assert.equal(new (await load({ source: "core-scalar.wasm" })).Mapping("coupled").instructions, "scalar");
    } finally {
        delete globalThis.location;
    }
    for (const source of ["core-scalar.wasm", 5, {}, true]) {
        await assert.rejects(load({ source }), (error) => error instanceof TypeError && error.message.startsWith("source is to be a WebAssembly.Module, its bytes or its address, not "));
    }
});

test("arguments of other types are refused", () => {
    const mapping = new cubemap.Mapping("coupled");
    assert.throws(() => mapping.forward([1, 2], [1], [1, 2]), /y has 1 elements, but is to have 2/);
    assert.throws(() => mapping.inverse(256, 0, 0), /whole numbers from 0 to 255/);
    assert.throws(() => mapping.inverse([0.5], [0], [0]), RangeError);
    assert.throws(() => mapping.forward("1", "2", "3"), TypeError);
    assert.throws(() => mapping.forward([1n], [1n], [1n]), TypeError);
    assert.throws(() => mapping.forward(new Int32Array(1), new Int32Array(1), new Int32Array(1)), TypeError);
    assert.throws(() => new cubemap.CellGrid(mapping, "hilbert"), /grid is to be a Grid/);
    assert.throws(() => new cubemap.CellGrid(new cubemap.Grid(), "hilbrt"), /to be one of/);
    assert.throws(() => new cubemap.Grid({ elipsoid: "WGS84" }), /no 'elipsoid'/);
    assert.throws(() => new cubemap.Grid({ ellipsoid: "WGS1884" }), /there is no ellipsoid 'WGS1884'/);
    assert.throws(() => new cubemap.Grid("coupled"), /gridOptions is to be an object of .*mapping.*, not 'coupled'/);
    assert.throws(() => new cubemap.Grid(new cubemap.Mapping("coupled")), /gridOptions is to be an object of .*, not a Mapping/);
    assert.throws(() => mapping.forward([1], [1], [1], { u: new Float64Array(2) }), /u has 2 elements/);
    assert.throws(() => mapping.forward([1], [1], [1], { u: new Float32Array(1) }), /Float64Array/);
});

test("arrays in the module's memory are used where they are, and survive its growth", () => {
    const mapping = new cubemap.Mapping("coupled");
    const n = 1000;
    const [x, y, z, u, v] = Array.from({ length: 5 }, () => cubemap.float64(n));
    const face = cubemap.uint8(n);
    x.array.fill(2);
    y.array.fill(1);
    z.array.fill(0.5);
    const before = x.array;
    const result = mapping.forward(x, y, z, { face, u, v });
    assert.equal(result.u, u.array, "no copy");
    assert.equal(result.u.buffer, cubemap.memory.buffer);
    assert.equal(u.array[n - 1].toFixed(6), "0.620558");
    const size = cubemap.memory.buffer.byteLength;
    const large = cubemap.float64(size / 8);
    assert.ok(cubemap.memory.buffer.byteLength > size);
    assert.equal(before.length, 0, "the old view is gone");
    assert.equal(x.array[n - 1], 2);
    assert.equal(mapping.forward(x, y, z, { face, u, v }).face[0], 0);
    const plain = new Float64Array(n);
    assert.equal(mapping.forward(x, y, z, { u: plain }).u, plain);
    assert.equal(plain[5].toFixed(6), "0.620558");
    large.free();
    large.free();
    assert.throws(() => large.array, ReferenceError);
    assert.ok(x instanceof Vector);
    assert.throws(() => cubemap.float64(-1), RangeError);
    assert.throws(() => cubemap.float64(2 ** 40), /no memory/);
});

test("the memory may grow while a call puts its arguments there", async () => {
    const own = await load();
    const mapping = new own.Mapping("coupled");
    const n = 2 ** 18;
    const [y, u] = [own.float64(n), own.float64(n)];
    y.array.fill(0.1);
    const before = own.memory.buffer;
    const { face } = mapping.forward(new Float64Array(n).fill(1), y.array, new Float64Array(n), { u: u.array });
    assert.notEqual(own.memory.buffer, before, "it has grown");
    assert.equal(face[n - 1], 0);
    assert.equal(u.array[n - 1], mapping.forward(1, 0.1, 0).u);
});

test("outputs that lie on inputs in the module's memory have what others would have", () => {
    const mapping = new cubemap.Mapping("coupled");
    const n = 1000;
    const [x, y, z] = [0, 1, 2].map((k) => Float64Array.from({ length: n }, (_, i) => Math.sin(3 * i + k)));
    const wanted = { ...mapping.forward(x, y, z), jacobian: mapping.forwardJacobian(x, y, z) };
    const room = cubemap.float64(4 * n);
    for (const shift of [-7, -1, 0, 1, 2, 999]) {
        const part = (at) => room.array.subarray(n + at, 2 * n + at);
        const given = () => {
            room.array.fill(0);
            part(0).set(x);
            return [part(0), y, z];
        };
        assert.deepEqual([...mapping.forward(...given(), { u: part(shift) }).u], [...wanted.u], `shifted by ${shift}`);
        assert.deepEqual([...part(shift)], [...wanted.u]);
        assert.deepEqual([...mapping.forwardJacobian(...given(), { jacobian: [part(shift)] })[0]], [...wanted.jacobian[0]]);
    }
    const own = cubemap.float64(n);
    own.array.set(x);
    assert.equal(mapping.forward(own, y, z, { u: own }).u, own.array);
    assert.deepEqual([...own.array], [...wanted.u]);
});

test("arrays of another instance's memory, of other contexts, of classes that extend them, and shared ones", async () => {
    const mapping = new cubemap.Mapping("coupled");
    const other = await load();
    const expected = mapping.forward([1, 2], [0.1, 0.2], [0.5, 3]);
    const [x, u] = [other.float64(2), other.float64(2)];
    x.array.set([1, 2]);
    const context = vm.createContext({});
    const y = vm.runInContext("Float64Array.of(0.1, 0.2)", context);
    const v = vm.runInContext("new Float64Array(2)", context);
    const z = new Float64Array(new SharedArrayBuffer(16));
    z.set([0.5, 3]);
    const face = Buffer.alloc(2);
    const result = mapping.forward(x, y, z, { face, u, v });
    assert.deepEqual([...face], [...expected.face]);
    assert.deepEqual([...u.array], [...expected.u]);
    assert.deepEqual([...v], [...expected.v]);
    assert.ok(result.face === face && result.u === u.array && result.v === v);
    assert.ok(mapping.forward(vm.runInContext("new Float32Array(1)", context), [1], [1]).u instanceof Float32Array);
    const cells = cubemap.uint64(4);
    cells.array.set(Array.from({ length: 4 }, (_, which) => cubemap.cellChild(1n << 60n, which)));
    assert.deepEqual(cubemap.cellUnionNormalise(cells), BigUint64Array.of(1n << 60n));
    assert.equal(cells.array[0], cubemap.cellChild(1n << 60n, 0), "what is given stays");
    for (const wrong of [null, new ArrayBuffer(8), new DataView(new ArrayBuffer(8))]) {
        assert.throws(() => mapping.forward(wrong, [1], [1]), /x is to be a number or an array of numbers/);
    }
});

test("whole numbers that do not fit are refused", () => {
    const cell = cubemap.cellParse("89c25");
    for (const level of [2 ** 32 + 3, 2.5, NaN, Infinity]) {
        assert.throws(() => cubemap.cellParent(cell, level), /level is .*, but is to be of the whole numbers from -2147483648 to 2147483647/);
    }
    const healpix = new cubemap.Healpix(64, "nested");
    for (const pixel of [2n ** 64n + 5n, 2n ** 63n, 5.5, 1e30]) {
        assert.throws(() => healpix.neighbours(pixel), RangeError);
        assert.throws(() => healpix.ringFromNested([pixel]), RangeError);
    }
    assert.throws(() => cubemap.cellUnionNormalise([2n ** 64n + 5n]), RangeError);
    assert.throws(() => healpix.neighbours("5"), TypeError);
    assert.throws(() => new cubemap.Healpix(2n ** 64n + 64n, "nested"), RangeError);
    assert.throws(() => cubemap.cellToken(2n ** 64n + 5n), RangeError);
    assert.equal(cubemap.cellToken(BigInt.asIntN(64, cell)), cubemap.cellToken(cell), "the same 64 bits");
    const options = { levelMax: 2 ** 32 + 8 };
    assert.throws(() => cubemap.cover(new cubemap.CellGrid(new cubemap.Grid(), "hilbert"), cubemap.Region.cap([0, 0, 1], 0.1), options),
        /levelMax is 4294967304/);
    assert.throws(() => new cubemap.Grid({ tolerance: "1e-9" }), /tolerance is to be a number/);
    assert.throws(() => new cubemap.Mapping("coupled\0"), /specification has a character of code 0/);
});

test("calls leave no memory behind", () => {
    const mapping = new cubemap.Mapping("coupled");
    const x = new Float64Array(100000).fill(1);
    mapping.forward(x, x, x);
    const size = cubemap.memory.buffer.byteLength;
    for (let i = 0; i < 50; i++) {
        mapping.forward(x, x, x);
        new cubemap.Mapping("qsc").free();
        assert.throws(() => new cubemap.Mapping("qsc:"));
    }
    assert.equal(cubemap.memory.buffer.byteLength, size);
});

test("objects are freed by hand, or when nobody has them", () => {
    const mapping = new cubemap.Mapping("coupled");
    mapping.free();
    mapping.free();
    assert.throws(() => mapping.forward(1, 0, 0), /the Mapping has been freed/);
    const grid = new cubemap.Grid({ mapping: "qsc" });
    const inner = grid.mapping;
    inner.free();
    assert.equal(inner.info.identifier, "qsc");
    grid.free();
    assert.throws(() => inner.info, ReferenceError);
    assert.throws(() => new cubemap.Region(), /no constructor/);
});

test("the Earth: grids, latitudes, rotations", () => {
    const grid = new cubemap.Grid({ mapping: "algebraic", ellipsoid: "GRS80" });
    const { face, u, v } = grid.forwardLonlat(0.2, 0.9);
    const { lon, lat } = grid.inverseLonlat(face, u, v);
    assert.ok(Math.abs(lon - 0.2) < 1e-15 && Math.abs(lat - 0.9) < 1e-15);
    assert.equal(grid.ellipsoid.identifier, "GRS80");
    assert.equal(grid.mapping.info.identifier, "algebraic");
    const latitude = new cubemap.LatitudeConversion("WGS84", "geographic", "authalic");
    assert.ok(Math.abs(latitude.convert(0.5) - 0.4981177071142542) < 1e-15);
    const rotation = cubemap.Rotation.fromAngles(0.1, 0.2, 0.3);
    const there = cubemap.Rotation.apply(rotation, [1, 2, 3]);
    cubemap.Rotation.applyBack(rotation, there).forEach((value, i) => assert.ok(Math.abs(value - (i + 1)) < 1e-14));
    const angles = cubemap.Rotation.angles(rotation);
    assert.ok(Math.abs(angles.lon - 0.1) + Math.abs(angles.lat - 0.2) + Math.abs(angles.roll - 0.3) < 1e-15);
    assert.throws(() => cubemap.Rotation.parse("north"), /LON,LAT/);
    assert.equal(cubemap.Ellipsoid.parse("6378137,298.257223563").a, 6378137);
});

test("poses: exp and log, products, quaternions", () => {
    const { Pose } = cubemap;
    const quarter = Pose.exp([1, 2, 3, 0, 0, Math.PI / 2]);
    assert.ok(Math.abs(Pose.angle(quarter) - Math.PI / 2) < 1e-15);
    Pose.log(quarter).forEach((value, i) => assert.ok(Math.abs(value - [1, 2, 3, 0, 0, Math.PI / 2][i]) < 1e-14));
    // x_camera = rotation (x_world - position), camera to world a quarter turn about z
    Pose.applyBack(quarter, [1, 0, 0]).forEach((value, i) => assert.ok(Math.abs(value - quarter.position[i] - [0, 1, 0][i]) < 1e-15));
    const back = Pose.compose(quarter, Pose.invert(quarter));
    [...back.rotation.row, ...back.position].forEach((value, i) => assert.ok(Math.abs(value - (i < 9 && i % 4 === 0 ? 1 : 0)) < 1e-15));
    const again = Pose.fromQuaternion(quarter.position, Pose.quaternion(quarter));
    again.rotation.row.forEach((value, i) => assert.ok(Math.abs(value - quarter.rotation.row[i]) < 1e-15));
    const half = Pose.interpolate(again, back, 0.5);
    assert.ok(Math.abs(Pose.angle(half) - Math.PI / 4) < 1e-15 && Pose.adjoint(half).length === 36);
    assert.throws(() => Pose.fromQuaternion([0, 0, 0], [0, 0, 0, 2]), (error) => error.code === 17);
    assert.throws(() => Pose.check({ rotation: { row: [1, 0, 0, 0, 1, 0, 0, 0, -1] }, position: [0, 0, 0] }));
});

test("random numbers are those of every other machine", () => {
    assert.deepEqual([...cubemap.randomBlock(0n, 0, 0, 0, 0)], [0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8]);
    assert.equal(cubemap.randomUniform(20n, 1, 2, 3), 0.337807109182824);
    assert.equal(cubemap.randomNormal(20n, 1, 2, 3), 0.7444203586952833);
    assert.equal(cubemap.randomPoisson(20n, 1, 2, 3, 7.5), 5);
    assert.equal(cubemap.randomPoisson(20n, 1, 2, 3, 1e6), 998833);
    assert.ok(Number.isNaN(cubemap.randomPoisson(20n, 1, 2, 3, -1)));
    assert.deepEqual(cubemap.randomUniformArray(20n, 1, 1, 3, 3), Float64Array.from([1, 2, 3], (pixel) => cubemap.randomUniform(20n, 1, pixel, 3)));
    assert.equal(cubemap.randomPoissonArray(20n, 1, 2, 3, [7.5, 7.5])[0], 5);
});

test("cells have numbers of 64 bits", () => {
    const cells = new cubemap.CellGrid(new cubemap.Grid(), "hilbert");
    const cell = cells.forwardLonlat(20, 0.2, 0.9);
    assert.equal(typeof cell, "bigint");
    assert.equal(cubemap.cellParse(cubemap.cellToken(cell)), cell);
    assert.equal(cubemap.cellLevel(cell), 20);
    assert.equal(cubemap.cellContains(cubemap.cellParent(cell, 10), cell), true);
    assert.equal(cells.edgeNeighbours(cell).length, 4);
    assert.deepEqual(cubemap.cellUnionNormalise([...Array(4).keys()].map((which) => cubemap.cellChild(cell, which))),
        BigUint64Array.of(cell));
    const cap = cubemap.Region.cap([0, 0, 1], 0.1);
    const cover = cubemap.cover(cells, cap, { levelMax: 8, cellsMost: 20 });
    assert.ok(cover.length > 0 && cover.length <= 20);
    assert.equal(cubemap.cellUnionContains(cover, cells.forward(20, 0.01, 0, 1)), true);
    assert.equal(cubemap.Region.polygon([[0, 0, 0.1, 0, 0.1, 0.1, 0, 0.1]]).contains([1, 0.05, 0.05]), true);
    assert.deepEqual(cubemap.cellToPlace("morton", cubemap.cellFromPlace("morton", { face: 2, level: 3, i: 5, j: 6 })),
        { face: 2, level: 3, i: 5, j: 6 });
});

test("pixels of HEALPix", () => {
    const healpix = new cubemap.Healpix(64, "nested");
    assert.equal(healpix.pixelCount, 49152n);
    assert.equal(healpix.pixelFromDirection(0, 0, 1), 4095n);
    assert.equal(healpix.ringFromNested(healpix.nestedFromRing(1234n)), 1234n);
    assert.deepEqual([...healpix.neighbours(5)], [4n, 6n, 7n, 18n, 16n, 23226n, 23215n, 23214n]);
    assert.equal(healpix.boundary(5, 2).x.length, 8);
    const coarse = new cubemap.Healpix(2, "nested");
    const map = Float64Array.from({ length: 192 }, (_, i) => i);
    assert.deepEqual([...new cubemap.Healpix(4, "nested").regrade(map, coarse).slice(0, 2)], [1.5, 5.5]);
});

test("how far a mapping distorts", () => {
    const mapping = new cubemap.Mapping("coupled");
    const statistics = cubemap.distortionStatistics(mapping, "area", null);
    assert.ok(Math.abs(statistics.maximumError - 0.0025037) < 1e-6);
    const { value } = cubemap.distortionPercentiles(mapping, "area", null, [50]);
    assert.ok(Math.abs(value[0] - 1) < 0.001);
});
