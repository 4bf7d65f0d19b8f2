/* SPDX-License-Identifier: MIT
 *
 * One pixel alone: WebAssembly with SIMD128.
 */
#include <wasm_simd128.h>

#define CM_LANES "libcubemap/batch/lanes/wasm128.inc"
#define CM_SET wasm128
#include "lone.inc"
