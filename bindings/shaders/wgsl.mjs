// SPDX-License-Identifier: MIT
//
// wgsl.mjs NAGA FILE...: each GLSL 4.50 compute shader FILE.comp as FILE.wgsl, by naga as the folder of the npm package
// web-naga has it, which also checks the result by reading it again.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, ...files] = process.argv.slice(2);
const naga = await import(pathToFileURL(join(folder, "web_naga.js")));
await naga.default({ module_or_path: readFileSync(join(folder, "web_naga_bg.wasm")) });

let failed = 0;
for (const file of files) {
    try {
        const made = naga.GlslFrontend.new().parse(readFileSync(file, "utf8"), naga.ShaderStage.Compute).to_wgsl();
        naga.WgslFrontend.new().parse(made).to_wgsl();
        writeFileSync(file.replace(/\.comp$/, ".wgsl"), made);
    } catch (error) {
        failed++;
        console.error(`${file}: ${error?.message ?? error}`);
    }
}
console.log(`${files.length - failed} texts in WGSL, ${failed} not`);
process.exitCode = failed === 0 ? 0 : 1;
