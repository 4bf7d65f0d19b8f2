// SPDX-License-Identifier: MIT
//
// Both modules have the native library's bits, of plain C, at the hard points and others: every mapping, every frame.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test from "node:test";

import { hasSimd, load } from "cubemap";

const bytes = await readFile(process.env.CUBEMAP_NATIVE_BITS);

/** The blocks of native_bits.c, one after the other. */
class Blocks {
    constructor(n) {
        this.n = n;
        this.at = 0;
    }

    next(Type) {
        const size = this.n * Type.BYTES_PER_ELEMENT;
        const copy = bytes.buffer.slice(bytes.byteOffset + this.at, bytes.byteOffset + this.at + size);
        assert.equal(copy.byteLength, size, "the vectors end early");
        this.at += size;
        return new Type(copy);
    }

    columns(count, Type = Float64Array) {
        return Array.from({ length: count }, () => this.next(Type));
    }
}

let compared = 0;

function same(is, wanted, what) {
    assert.equal(is.length, wanted.length, what);
    for (let i = 0; i < is.length; i++) {
        if (!Object.is(is[i], wanted[i])) {
            assert.fail(`${what}, point ${i}: ${is[i]}, but natively ${wanted[i]}`);
        }
    }
    compared += is.length;
}

function allSame(is, wanted, what) {
    is.forEach((column, k) => same(column, wanted[k], `${what}, ${k}`));
}

const fields = (object, names) => names.map((name) => object[name]);

function compareMapping(cubemap, blocks, specification, frame, [x, y, z], [face, u, v]) {
    const name = `${specification} in ${frame}`;
    const mapping = new cubemap.Mapping(specification, frame);
    const single = (array) => Float32Array.from(array);
    const types = [Uint8Array, Float64Array, Float64Array];
    const types32 = [Uint8Array, Float32Array, Float32Array];
    const wanted = () => types.map((Type) => blocks.next(Type));
    allSame(fields(mapping.forward(x, y, z), ["face", "u", "v"]), wanted(), `forward ${name}`);
    allSame(fields(mapping.forward(single(x), single(y), single(z)), ["face", "u", "v"]),
        types32.map((Type) => blocks.next(Type)), `forward in float ${name}`);
    allSame(mapping.forwardJacobian(x, y, z), blocks.columns(6), `Jacobian of forward ${name}`);
    allSame(fields(mapping.inverse(face, u, v), ["x", "y", "z"]), blocks.columns(3), `inverse ${name}`);
    allSame(fields(mapping.inverse(face, single(u), single(v)), ["x", "y", "z"]), blocks.columns(3, Float32Array),
        `inverse in float ${name}`);
    allSame(mapping.inverseJacobian(face, u, v), blocks.columns(6), `Jacobian of inverse ${name}`);
    mapping.free();
}

function compareEarth(cubemap, blocks, [x, y, z]) {
    const grid = new cubemap.Grid();
    allSame(fields(grid.forward(x, y, z), ["face", "u", "v"]),
        [Uint8Array, Float64Array, Float64Array].map((Type) => blocks.next(Type)), "grid");
    const cells = new cubemap.CellGrid(grid, "hilbert");
    const cell = blocks.next(BigUint64Array);
    same(cells.forward(30, x, y, z), cell, "cells");
    allSame(fields(cells.centre(cell), ["x", "y", "z"]), blocks.columns(3), "centres of cells");
    const healpix = new cubemap.Healpix(2 ** 20, "nested");
    const pixel = blocks.next(BigInt64Array);
    same(healpix.pixelFromDirection(x, y, z), pixel, "pixels");
    allSame(fields(healpix.directionFromPixel(pixel), ["x", "y", "z"]), blocks.columns(3), "centres of pixels");
    // tiny and huge directions go to the C library, which is another one
    const wanted = blocks.columns(2);
    fields(cubemap.lonlatFromDirection(x, y, z), ["lon", "lat"]).forEach((is, k) => is.forEach((value, i) => {
        const isSame = Object.is(value, wanted[k][i]) || Math.abs(value - wanted[k][i]) < 1e-15;
        assert.ok(isSame, `longitude or latitude, point ${i}: ${value}, but natively ${wanted[k][i]}`);
    }));
}

for (const simd of hasSimd() ? [false, true] : [false]) {
    test(`bits, ${simd ? "with" : "without"} vectors`, async () => {
        const cubemap = await load({ simd });
        assert.equal(cubemap.instructionsAt(0), simd ? "wasm128" : "scalar");
        compared = 0;
        const blocks = new Blocks(Number(process.env.CUBEMAP_NATIVE_COUNT));
        const directions = blocks.columns(3);
        const points = [Uint8Array, Float64Array, Float64Array].map((Type) => blocks.next(Type));
        for (let i = 0; i < cubemap.catalogueCount(); i++) {
            for (let k = 0; k < cubemap.Frame.count(); k++) {
                compareMapping(cubemap, blocks, cubemap.catalogueAt(i).identifier, cubemap.Frame.at(k).identifier, directions,
                    points);
            }
        }
        compareEarth(cubemap, blocks, directions);
        assert.equal(blocks.at, bytes.length, "the vectors have more");
        assert.ok(compared > 1e5);
    });
}
