// SPDX-License-Identifier: MIT
//
// browser.mjs FOLDER POINTS STEP: the programs of tests/programs in a headless Chromium, as fragment shaders of WebGL 2
// and as compute shaders of WebGPU, both by its own processor (SwiftShader). page.html runs them and sends their results
// here, from where they go to FOLDER/run-pipe, which compares them with C.
//
// CUBEMAP_CHROMIUM   the browser; default: chromium

import { spawn } from "node:child_process";
import { createReadStream, existsSync, mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [folder, points, step] = process.argv.slice(2);
const here = import.meta.dirname ?? new URL(".", import.meta.url).pathname;
const own = mkdtempSync(join(tmpdir(), "cubemap-browser-"));
const pointsFile = join(own, "points");
let browser;
let server;
let status = 1;

const judge = spawn(join(folder, "run-pipe"), [folder, points, step], {
    stdio: ["pipe", "inherit", "pipe"],
    env: { ...process.env, CUBEMAP_POINTS: pointsFile },
});

function end() {
    server?.close();
    server?.closeAllConnections();
    browser?.kill();
}

// a browser that does not come to an end is one that failed
const patience = setTimeout(() => {
    console.error("the browser has sent nothing for too long");
    judge.stdin.end();
    end();
}, 600_000);

judge.on("exit", (code) => {
    status = code ?? 1;
    clearTimeout(patience);
    end();
    setTimeout(() => {
        rmSync(own, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
        process.exit(status);
    }, 300);
});
judge.stdin.on("error", () => {});
judge.stderr.on("data", (data) => {
    if (String(data).startsWith("points")) {
        serve();
    } else {
        process.stderr.write(data);
    }
});

function take(request, response) {
    request.on("data", (data) => {
        if (!judge.stdin.write(data)) {
            request.pause();
            judge.stdin.once("drain", () => request.resume());
        }
    });
    request.on("end", () => response.end());
}

function say(request, response) {
    let text = "";
    request.on("data", (data) => { text += data; });
    request.on("end", () => {
        console.error(text);
        response.end();
        if (text.startsWith("failed")) {
            judge.stdin.end();
        }
    });
}

function serve() {
    server = createServer((request, response) => {
        const name = request.url.slice(1);
        const path = name === "" ? join(here, "page.html") : name === "points" ? pointsFile : join(folder, name);
        if (request.method === "POST") {
            (name === "say" ? say : take)(request, response);
        } else if (/^[\w.]*$/.test(name) && existsSync(path)) {
            response.setHeader("Content-Type", name === "" ? "text/html" : "application/octet-stream");
            createReadStream(path).pipe(response);
        } else {
            response.writeHead(404).end();
        }
    });
    server.requestTimeout = 0;
    server.listen(0, "127.0.0.1", () => {
        browser = spawn(process.env.CUBEMAP_CHROMIUM ?? "chromium", [
            "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", `--user-data-dir=${own}`,
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
            "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
            `http://127.0.0.1:${server.address().port}/`,
        ], { stdio: "ignore" });
        browser.on("error", (error) => {
            console.error(`no browser: ${error.message}`);
            judge.stdin.end();
        });
    });
}
