// SPDX-License-Identifier: MIT
//
// Pictures: from a panorama to six faces and back, by both modules alike.

import assert from "node:assert/strict";
import test from "node:test";

import { hasSimd, load } from "cubemap/image";

/** A panorama whose pixels say where they look. */
function panorama(Type, scale) {
    const [width, height, channels] = [256, 128, 3];
    const data = new Type(width * height * channels);
    for (let row = 0; row < height; row++) {
        for (let column = 0; column < width; column++) {
            const lat = Math.PI / 2 - Math.PI * (row + 0.5) / height;
            const lon = 2 * Math.PI * (column + 0.5) / width - Math.PI;
            const direction = [Math.cos(lat) * Math.cos(lon), Math.cos(lat) * Math.sin(lon), Math.sin(lat)];
            direction.forEach((value, k) => {
                data[(row * width + column) * channels + k] = scale * (0.5 + 0.5 * value);
            });
        }
    }
    return { data, width, height, channels };
}

const blank = (Type, edge) => ({ data: new Type(edge * edge * 3), width: edge, height: edge, channels: 3 });

for (const simd of hasSimd() ? [false, true] : [false]) {
    test(`a panorama to six faces and back, ${simd ? "with" : "without"} vectors`, async () => {
        const image = await load({ simd });
        for (const [Type, scale, most] of [[Uint8Array, 255, 2], [Float32Array, 1, 0.002]]) {
            const from = panorama(Type, scale);
            const flat = new image.Surface("equirect", { width: 256, height: 128 });
            const cube = new image.Surface("cube:coupled;size=96");
            assert.equal(cube.pictureCount, 6);
            const faces = Array.from({ length: 6 }, () => blank(Type, 96));
            new image.Plan(flat, cube, { filter: "catmull-rom" }).resample([from], faces);
            const again = { ...from, data: new Type(from.data.length) };
            new image.Plan(cube, flat, { filter: "catmull-rom" }).resample(faces, [again]);
            const worst = from.data.reduce((far, value, i) => Math.max(far, Math.abs(value - again.data[i])), 0);
            assert.ok(worst > 0 && worst <= most, `the worst pixel is ${worst} off`);
        }
    });
}

test("both modules make the same picture", { skip: !hasSimd() }, async () => {
    const pictures = [];
    for (const simd of [false, true]) {
        const image = await load({ simd });
        const plan = new image.Plan(new image.Surface("equirect;size=256"), new image.Surface("cube:seamless;size=64"),
            { filter: "lanczos3", transfer: "srgb" });
        pictures.push(plan.resample([panorama(Uint8Array, 255)], Array.from({ length: 6 }, () => blank(Uint8Array, 64))));
    }
    assert.deepEqual(pictures[0], pictures[1]);
});

test("surfaces, plans, samples", async () => {
    const image = await load();
    const surface = new image.Surface("equirect;size=256");
    const [value] = surface.sample([panorama(Float32Array, 1)], "bilinear", [1], [0], [0]);
    assert.ok(Math.abs(value - 1) < 0.001);
    assert.throws(() => surface.sample([panorama(Float32Array, 1)], "bilinear", 1, 0, 0), /x is to be .*an array of numbers/);
    assert.throws(() => surface.sample([], "bilinear", [1], [0], [0]), { name: "ArgumentError" });
    assert.throws(() => new image.Surface("equirect", { width: 2 ** 32 + 64, height: 32 }), /width is 4294967360/);
    const plan = new image.Plan(surface, new image.Surface("cube:coupled;size=16"));
    assert.equal(image.Plan.read(plan.text).text, plan.text);
    assert.throws(() => new image.Surface("equirekt"), /equirekt/);
    assert.throws(() => new image.Plan(surface, surface, { memory: {} }), /planOptions has no 'memory', but alpha, [^]*instructions, notFinite/);
    assert.throws(() => plan.resample([], []), { name: "ArgumentError" });
    assert.throws(() => plan.resample({}, []), TypeError);
    assert.throws(() => plan.resample([blank(Uint8Array, 8)], Array.from({ length: 6 }, () => blank(Uint8Array, 16))),
        { name: "OutOfRangeError" });
    const place = surface.positions(1, 0, 0);
    assert.deepEqual(place, { plane: 0, column: 128, row: 64 });
});

test("a picture in the module's memory is drawn onto itself as onto another", async () => {
    const image = await load();
    const upright = new image.Surface("equirect;size=64");
    const turned = new image.Surface("equirect;west=-77;east=283;size=64");
    const plan = new image.Plan(upright, turned, { filter: "bilinear" });
    const source = { data: Float32Array.from({ length: 64 * 32 }, (_, i) => Math.sin(i)), width: 64, height: 32 };
    const wanted = { ...source, data: new Float32Array(64 * 32) };
    plan.resample([source], [wanted]);
    const pixels = image.float32(64 * 32);
    pixels.array.set(source.data);
    const own = { ...source, data: pixels };
    plan.resample([own], [own]);
    assert.deepEqual([...pixels.array], [...wanted.data]);
});

test("pixels in the module's memory survive its growth in a call", async () => {
    const image = await load();
    const plan = new image.Plan(new image.Surface("equirect;size=2048"), new image.Surface("cube:coupled;size=16"),
        { filter: "bilinear" });
    const data = Array.from({ length: 6 }, () => image.float32(16 * 16));
    const from = { data: new Float32Array(2048 * 1024).fill(0.5), width: 2048, height: 1024 };
    const before = image.memory.buffer;
    plan.resample([from], data.map(({ array }) => ({ data: array, width: 16, height: 16 })));
    assert.notEqual(image.memory.buffer, before, "it has grown");
    data.forEach(({ array }) => assert.ok(array.every((value) => value === 0.5)));
});
