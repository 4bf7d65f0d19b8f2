// SPDX-License-Identifier: MIT
//
// The Earth on six faces of the mapping coupled, made here by cubemap/image, on a ball by three.js.

import { load } from "cubemap/image";
import * as three from "three";

import { mappedMaterial } from "./mapped_material.js";

const EDGE = 512;
const SIZE = 640;

async function pixelsOf(url) {
    const bitmap = await createImageBitmap(await (await fetch(url)).blob());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const { width, height, data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    return { data, width, height, channels: 4 };
}

function facesOf(image, panorama) {
    const from = new image.Surface("equirect", { width: panorama.width, height: panorama.height });
    const to = new image.Surface(`cube:coupled;frame=gl;size=${EDGE}`);
    const plan = new image.Plan(from, to, { filter: "catmull-rom", transfer: "srgb", alpha: 4 });
    return plan.resample([panorama], Array.from({ length: 6 }, () => (
        { data: new Uint8Array(EDGE * EDGE * 4), width: EDGE, height: EDGE, channels: 4 })));
}

function textureOf(faces) {
    const texture = new three.CubeTexture(faces.map(({ data }) => {
        const face = new three.DataTexture(data, EDGE, EDGE);
        face.needsUpdate = true;
        return face;
    }));
    texture.minFilter = three.LinearFilter;
    texture.magFilter = three.LinearFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
}

/** The ball's picture, and how the same pixels are in the panorama. */
function draw(renderer, material, panorama) {
    const scene = new three.Scene();
    scene.background = new three.Color(0x000000);
    scene.add(new three.Mesh(new three.SphereGeometry(1, 192, 96), material));
    const camera = new three.OrthographicCamera(-1.05, 1.05, 1.05, -1.05, 0.1, 10);
    camera.position.set(2, 2.2, 2.6);
    camera.lookAt(0, 0, 0);
    renderer.render(scene, camera);
    const context = renderer.getContext();
    const drawn = new Uint8Array(SIZE * SIZE * 4);
    context.readPixels(0, 0, SIZE, SIZE, context.RGBA, context.UNSIGNED_BYTE, drawn);
    return { drawn, difference: difference(drawn, camera, panorama) };
}

/** The mean difference from the panorama's nearest pixel, 0 to 255, inside the ball. */
function difference(drawn, camera, { data, width, height }) {
    const [right, up, back] = [0, 1, 2].map((k) => new three.Vector3().setFromMatrixColumn(camera.matrixWorld, k));
    let sum = 0;
    let count = 0;
    for (let row = 0; row < SIZE; row++) {
        for (let column = 0; column < SIZE; column++) {
            const a = 1.05 * (2 * (column + 0.5) / SIZE - 1);
            const b = 1.05 * (2 * (row + 0.5) / SIZE - 1);
            if (a * a + b * b > 0.9) {
                continue;
            }
            const n = right.clone().multiplyScalar(a).addScaledVector(up, b).addScaledVector(back, Math.sqrt(1 - a * a - b * b));
            const x = Math.floor((Math.atan2(n.x, n.z) / (2 * Math.PI) + 0.5) * width) % width;
            const y = Math.min(height - 1, Math.floor((0.5 - Math.asin(n.y) / Math.PI) * height));
            for (let k = 0; k < 3; k++) {
                sum += Math.abs(drawn[(row * SIZE + column) * 4 + k] - data[(y * width + x) * 4 + k]);
                count++;
            }
        }
    }
    return sum / count;
}

async function main() {
    const [image, panorama, kernels] = await Promise.all([load(), pixelsOf("/earth.jpg"),
        fetch("/kernels.glsl").then((answer) => answer.text())]);
    const faces = textureOf(facesOf(image, panorama));
    const renderer = new three.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
    renderer.outputColorSpace = three.LinearSRGBColorSpace; // the texture's values are the screen's
    renderer.setSize(SIZE, SIZE, false);
    document.body.append(renderer.domElement);
    const plain = draw(renderer, mappedMaterial({ faces, kernels, isMapped: false }), panorama);
    const mapped = draw(renderer, mappedMaterial({ faces, kernels }), panorama);
    return { mapped: mapped.difference, plain: plain.difference, picture: renderer.domElement.toDataURL("image/jpeg", 0.85) };
}

window.result = main();
