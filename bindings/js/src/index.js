// SPDX-License-Identifier: MIT
//
// cubemap: mappings between the sphere and the six faces of a cube. Nothing happens at import; load() instantiates.

import { bind } from "./core.js";
import { exportsOf } from "./load.js";

export * from "./errors.js";
export { hasSimd } from "./load.js";
export { Vector } from "./memory.js";

export async function load(options) {
    return bind(await exportsOf("core", options));
}
