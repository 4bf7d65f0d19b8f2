// SPDX-License-Identifier: MIT
//
// Renders page.js in a Chromium without a window, and says how far the picture is from the panorama it is made of: that of
// the mapped lookup, and for comparison that of the usual one, which is wrong for these faces.
// Usage: node examples/threejs/render.mjs [PICTURE.jpg]      after bindings/js/make_package and npm install in build-js

import { execFileSync } from "node:child_process";
import { readFile, writeFile } from "node:fs/promises";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.resolve(here, "../..");
const packages = path.resolve(process.env.CUBEMAP_JS ?? path.join(root, "build-js")) + path.sep;
const { chromium } = createRequire(packages)("playwright-core");

const kernels = execFileSync("cc", ["-E", "-P", "-x", "c", "-DCM_BACKEND=3", "-I", path.join(root, "include"),
    path.join(root, "include/cubemap/kernel/backend.h")]);
const page = `<!doctype html><meta charset="utf-8"><title>cubemap</title><script type="importmap">{"imports": {
    "three": "/packages/node_modules/three/build/three.module.js", "cubemap/image": "/packages/dist/image_index.js"}}</script>
    <script type="module" src="/page.js"></script>`;
const types = { ".js": "text/javascript", ".wasm": "application/wasm", ".jpg": "image/jpeg" };

async function answer(request, response) {
    const name = path.posix.normalize(new URL(request.url, "http://localhost").pathname);
    const own = { "/": page, "/favicon.ico": "", "/kernels.glsl": kernels };
    const file = name === "/earth.jpg" ? path.join(root, "data/earth-2048.jpg")
        : name.startsWith("/packages/") ? path.join(packages, name.slice(10)) : path.join(here, name);
    try {
        const body = own[name] ?? await readFile(file);
        response.writeHead(200, { "content-type": types[path.extname(name)] ?? "text/html" }).end(body);
    } catch {
        response.writeHead(404).end();
    }
}

const server = createServer(answer);
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
    const tab = await browser.newPage();
    tab.on("pageerror", (error) => console.error(error.message));
    tab.on("console", (message) => message.type() === "error" && console.error(message.text()));
    await tab.goto(`http://127.0.0.1:${server.address().port}/`);
    const { mapped, plain, picture } = await tab.evaluate(() => window.result);
    console.log(`mean difference from the panorama, of 255: ${mapped.toFixed(2)} mapped, ${plain.toFixed(2)} not`);
    if (process.argv[2] !== undefined) {
        await writeFile(process.argv[2], Buffer.from(picture.split(",")[1], "base64"));
    }
    if (!(mapped < 4 && plain > 2 * mapped)) {
        console.error("the mapped lookup is not what it should be");
        process.exitCode = 1;
    }
} finally {
    await browser.close();
    server.close();
}
