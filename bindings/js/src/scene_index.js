// SPDX-License-Identifier: MIT
//
// cubemap/scene: cameras, depth images, worlds, and maps of them as octrees.

import { bind } from "./scene.js";
import { exportsOf } from "./load.js";

export * from "./errors.js";
export { hasSimd } from "./load.js";
export { Vector } from "./memory.js";

export async function load(options) {
    return bind(await exportsOf("scene", options));
}
