// SPDX-License-Identifier: MIT
//
// A module's bytes from beside this file, in Node and in browsers; the one with vectors where the engine knows them.

import { present, shown } from "./numbers.js";

/** A function whose body is i32.const 0, i8x16.splat, drop. */
const VECTORS = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 9, 1, 7, 0, 65, 0, 253,
    15, 26, 11]);

export function hasSimd() {
    return WebAssembly.validate(VECTORS);
}

async function bytesOf(url) {
    if (url.protocol === "file:" && globalThis.process?.versions?.node !== undefined) {
        const { readFile } = await import("node:fs/promises");
        return readFile(url);
    }
    const answer = await fetch(url);
    if (!answer.ok) {
        throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
    }
    return answer.arrayBuffer();
}

/** The functions of JavaScript that the library calls, while it is called itself: by the exports of each instance. */
const callbacks = new WeakMap();

export function callbacksOf(exports) {
    return callbacks.get(exports);
}

/** The library writes and reads no files: what its C library would ask the system for is refused, ENOSYS. */
function importsOf(module, called) {
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
        imports[from] ??= {};
        imports[from][name] = from === "cubemap" ? (...given) => called[name](...given) : () => 52;
    }
    return imports;
}

/** What is to be compiled: bytes, or what is at an address, which in a page or a worker may be one beside it. */
async function bytesFrom(source) {
    if (Object.prototype.toString.call(source).endsWith("ArrayBuffer]") || ArrayBuffer.isView(source)) {
        return source;
    }
    const address = typeof source === "string" ? source : source.href;
    const base = globalThis.document?.baseURI ?? globalThis.location?.href;
    try {
        return bytesOf(new URL(present(address, "source"), base));
    } catch {
        throw new TypeError(`source is to be a WebAssembly.Module, its bytes or its address, not ${shown(source)}`);
    }
}

/** The exports of a module. source: a WebAssembly.Module, bytes, or a URL; else the file beside this one. */
export async function exportsOf(name, options) {
    const { simd, source } = options ?? {};
    let module = source;
    if (!(module instanceof WebAssembly.Module)) {
        const beside = new URL(`./${name}-${simd ?? hasSimd() ? "simd128" : "scalar"}.wasm`, import.meta.url);
        module = await WebAssembly.compile(await bytesFrom(source ?? beside));
    }
    const called = {};
    const instance = await WebAssembly.instantiate(module, importsOf(module, called));
    callbacks.set(instance.exports, called);
    return instance.exports;
}
