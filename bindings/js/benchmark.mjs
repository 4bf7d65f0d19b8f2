// SPDX-License-Identifier: MIT
//
// Nanoseconds a point, beside other packages for JavaScript, in one run: forward and inverse of mappings, pixels of
// HEALPix, cells. The least of many rounds, taken in turns, and how often it goes into that of the package beside: that
// ratio changes little with what else the machine does. No two packages compute the same: what each does is named.
// Usage: node benchmark.mjs [SECONDS]

import * as healpixOf from "@hscmap/healpix";
import { cpus } from "node:os";
import { geoAzimuthalEqualArea } from "d3-geo";
import { geoHealpix } from "d3-geo-projection";
import * as h3 from "h3-js";
import proj4 from "proj4";

import { hasSimd, load } from "cubemap";

const N = 4096;
const seconds = Number(process.argv[2] ?? 10);

/** Directions all over the sphere, the same in every run. */
function directions() {
    let state = 1;
    const random = () => (state = (Math.imul(state, 1103515245) + 12345) & 0x7fffffff) / 0x7fffffff;
    return Array.from({ length: N }, () => {
        const z = 2 * random() - 1;
        const lon = 2 * Math.PI * random() - Math.PI;
        return { x: Math.sqrt(1 - z * z) * Math.cos(lon), y: Math.sqrt(1 - z * z) * Math.sin(lon), z, lon, lat: Math.asin(z) };
    });
}

/** What others do, and what of ours is nearest. */
const BESIDE = {
    "qsc of one face: lon, lat to x, y": "qsc: direction to face, u, v",
    "qsc of one face: x, y to lon, lat": "qsc: face, u, v to direction",
    "azimuthal, equal area: lon, lat to x, y": "coupled: lon, lat to face, u, v",
    "healpix as a map: lon, lat to x, y": "coupled: lon, lat to face, u, v",
    "healpix, nside 1024: angles to pixel": "healpix, nside 1024: direction to pixel",
    "healpix, nside 1024: pixel to direction": "healpix, nside 1024: pixel to direction",
    "hexagons, resolution 9: lat, lon to cell": "cells, WGS84, level 17: lon, lat to cell",
};

const points = directions();
const degrees = points.map(({ lon, lat }) => [lon * 180 / Math.PI, lat * 180 / Math.PI]);
const rows = [];

/** A row of the table: run computes N points, or another count. */
function add(what, who, run, count = N) {
    run();
    rows.push({ what, who, run, count, best: Infinity });
}

function addOurs(cubemap, who) {
    const put = (array, key) => (points.forEach((point, i) => { array.array[i] = point[key]; }), array);
    const [x, y, z] = ["x", "y", "z"].map((key) => put(cubemap.float64(N), key));
    const [x32, y32, z32] = ["x", "y", "z"].map((key) => put(cubemap.float32(N), key));
    const [lon, lat] = ["lon", "lat"].map((key) => put(cubemap.float64(N), key));
    const out = { face: cubemap.uint8(N), u: cubemap.float64(N), v: cubemap.float64(N) };
    const out32 = { face: cubemap.uint8(N), u: cubemap.float32(N), v: cubemap.float32(N) };
    const back = { x: cubemap.float64(N), y: cubemap.float64(N), z: cubemap.float64(N) };
    const back32 = { x: cubemap.float32(N), y: cubemap.float32(N), z: cubemap.float32(N) };
    for (const name of ["gnomonic", "coupled", "qsc"]) {
        const mapping = new cubemap.Mapping(name);
        add(`${name}: direction to face, u, v`, who, () => mapping.forward(x, y, z, out));
        add(`${name}: face, u, v to direction`, who, () => mapping.inverse(out.face, out.u, out.v, back));
        add(`${name}, float: direction to face, u, v`, who, () => mapping.forward(x32, y32, z32, out32));
        add(`${name}, float: face, u, v to direction`, who, () => mapping.inverse(out32.face, out32.u, out32.v, back32));
    }
    const coupled = new cubemap.Mapping("coupled");
    add("coupled: lon, lat to face, u, v", who, () => coupled.forwardLonlat(lon, lat, out));
    const typed = ["x", "y", "z"].map((key) => Float64Array.from(points, (point) => point[key]));
    add("coupled: arrays outside, new results", who, () => coupled.forward(...typed));
    add("coupled: a point a call, with its object", who, () => points.forEach((point) => coupled.forward(point.x, point.y, point.z)));
    const healpix = new cubemap.Healpix(1024, "nested");
    const pixel = cubemap.int64(N);
    add("healpix, nside 1024: direction to pixel", who, () => healpix.pixelFromDirection(x, y, z, { pixel }));
    add("healpix, nside 1024: pixel to direction", who, () => healpix.directionFromPixel(pixel, back));
    const cells = new cubemap.CellGrid(new cubemap.Grid(), "hilbert");
    const cell = cubemap.uint64(N);
    add("cells, WGS84, level 17: lon, lat to cell", who, () => cells.forwardLonlat(17, lon, lat, { cell }));
}

addOurs(await load({ simd: false }), "cubemap, scalar");
if (hasSimd()) {
    addOurs(await load({ simd: true }), "cubemap, SIMD128");
}

const qsc = proj4("+proj=qsc +lat_0=0 +lon_0=0 +ellps=WGS84 +units=m +no_defs");
const onFace = degrees.map(([lon, lat]) => [lon / 4.1, lat / 2.1]);
add("qsc of one face: lon, lat to x, y", "proj4", () => onFace.forEach((point) => qsc.forward(point)));
const flat = onFace.map((point) => qsc.forward(point));
add("qsc of one face: x, y to lon, lat", "proj4", () => flat.forEach((point) => qsc.inverse(point)));
const azimuthal = geoAzimuthalEqualArea().clipAngle(null);
add("azimuthal, equal area: lon, lat to x, y", "d3-geo", () => degrees.forEach((point) => azimuthal(point)));
const square = geoHealpix();
add("healpix as a map: lon, lat to x, y", "d3-geo-projection", () => degrees.forEach((point) => square(point)));
add("healpix, nside 1024: angles to pixel", "@hscmap/healpix",
    () => points.forEach(({ lon, z }) => healpixOf.ang2pix_nest(1024, Math.acos(z), lon < 0 ? lon + 2 * Math.PI : lon)));
const numbers = points.map(({ lon, z }) => healpixOf.ang2pix_nest(1024, Math.acos(z), lon < 0 ? lon + 2 * Math.PI : lon));
add("healpix, nside 1024: pixel to direction", "@hscmap/healpix",
    () => numbers.forEach((number) => healpixOf.pix2vec_nest(1024, number)));
const few = degrees.slice(0, N / 16); // all would take 10 ms, in which other programs come in between
add("hexagons, resolution 9: lat, lon to cell", "h3-js", () => few.forEach(([lon, lat]) => h3.latLngToCell(lat, lon, 9)), few.length);

for (const end = performance.now() + 1000 * seconds; performance.now() < end;) {
    for (const row of rows) {
        const begin = performance.now();
        row.run();
        row.best = Math.min(row.best, (performance.now() - begin) * 1e6 / row.count);
    }
}

console.log(`${cpus()[0].model}, node ${process.version}, ${N} points a call, ns a point, the least of rounds in ${seconds} s\n`);
console.log("| what | package | ns |\n|---|---|--:|");
for (const { what, who, best } of rows) {
    console.log(`| ${what} | ${who} | ${best.toFixed(1)} |`);
}

console.log("\n| what | package | beside | times as long as without vectors | with |\n|---|---|---|--:|--:|");
const ours = (what, who) => rows.find((row) => row.what === what && row.who === who);
for (const { what, who, best } of rows.filter((row) => !row.who.startsWith("cubemap"))) {
    const times = ["cubemap, scalar", "cubemap, SIMD128"].map((mine) => ours(BESIDE[what], mine))
        .map((row) => row ? (best / row.best).toPrecision(2) : "");
    console.log(`| ${what} | ${who} | ${BESIDE[what]} | ${times.join(" | ")} |`);
}
