// SPDX-License-Identifier: MIT
//
// cubemap/image: pictures of the sphere from one surface to another.

import { bind } from "./image.js";
import { exportsOf } from "./load.js";

export * from "./errors.js";
export { hasSimd } from "./load.js";
export { Vector } from "./memory.js";

export async function load(options) {
    return bind(await exportsOf("image", options));
}
