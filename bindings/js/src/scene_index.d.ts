// SPDX-License-Identifier: MIT

import type { Library } from "./scene.js";

export * from "./scene.js";
export * from "./errors.js";
export { Vector } from "./memory.js";

export interface LoadOptions {
    /** With vectors; without a word where the engine knows them. */
    simd?: boolean;
    /** The module, its bytes, or where it is. */
    source?: WebAssembly.Module | ArrayBuffer | ArrayBufferView | URL | string;
}

/** Does the engine know vectors? */
export function hasSimd(): boolean;

/** A new instance of the module, with a memory of its own. */
export function load(options?: LoadOptions): Promise<Library>;
