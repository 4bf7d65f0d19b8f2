// SPDX-License-Identifier: MIT
//
// The few functions whose arguments no rule of the list describes: pictures, rings of polygons, whole maps of HEALPix.

import { F32, F64 } from "./memory.js";

const PIXELS = [[Uint8Array, "u8"], [Uint8ClampedArray, "u8"], [Uint16Array, "u16"], [Float32Array, "float"]];

/** No surface has more pictures; what is missing of them the library refuses, as it sees zeros. */
const MOST_PICTURES = 6;

/** Pictures as structs beside each other, their pixels in the module's memory. */
function putPictures(of, pictures, name) {
    const { M, structs } = of;
    if (!Array.isArray(pictures) || pictures.length > MOST_PICTURES) {
        throw new TypeError(`${name} is to be an array of at most ${MOST_PICTURES} pictures`);
    }
    const places = [];
    const all = M.zeros(32 * MOST_PICTURES);
    pictures.forEach((picture, i) => {
        const { data, width, height, channels } = picture;
        const array = data.array ?? data;
        const pair = PIXELS.find(([Type]) => array instanceof Type);
        if (pair === undefined) {
            throw new TypeError(`${name}: pixels are to be a Uint8Array, a Uint16Array or a Float32Array`);
        }
        if (array.length !== width * height * channels) {
            throw new RangeError(`${name}: ${array.length} numbers are not ${width} x ${height} pixels of ${channels}`);
        }
        const isHere = array.buffer === M.buffer;
        const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
        const place = isHere ? array.byteOffset : M.room(bytes.length);
        if (!isHere) {
            new Uint8Array(M.buffer, place, bytes.length).set(bytes);
        }
        structs.write_cm_image({ type: pair[1], width, height, channels }, all + 32 * i);
        M.data.setUint32(all + 32 * i + 4, place, true);
        places.push({ place, isHere, bytes, type: pair[1] });
    });
    return { all, places };
}

export function cm_resample(of, plan, from, to) {
    const { X, M, check } = of;
    const sources = putPictures(of, from, "from");
    const targets = putPictures(of, to, "to");
    check(X.cm_resample(plan.pointer, sources.all, targets.all, M.zeros(20)));
    for (const { place, isHere, bytes } of targets.places) {
        if (!isHere) {
            bytes.set(new Uint8Array(M.buffer, place, bytes.length));
        }
    }
    return to;
}

export function cm_sample(of, surface, pictures, filter, x, y, z) {
    const { X, M, check, code, enumerations } = of;
    const { all } = putPictures(of, pictures, "pictures");
    const n = x.length;
    const [px, py, pz] = [[x, "x"], [y, "y"], [z, "z"]].map(([values, name]) => M.input(F64, values, n, name));
    const size = n * pictures[0].channels;
    const out = M.room(size * F32.bytes);
    check(X.cm_sample(surface.pointer, all, code(enumerations.E_cm_filter, filter, "filter"), n, px, py, pz, out));
    return M.result(F32, undefined, out, size);
}

/** Rings of longitude, latitude, longitude, latitude ..., radians. */
export function cm_region_polygon(of, nobody, rings) {
    const { X, M, check, classes } = of;
    const lengths = M.room(4 * Math.max(1, rings.length));
    rings.forEach((ring, i) => M.data.setUint32(lengths + 4 * i, ring.length / 2, true));
    const all = rings.flatMap((ring) => Array.from(ring));
    const lonlat = M.input(F64, all, all.length, "rings");
    const made = M.zeros(4);
    check(X.cm_region_polygon(rings.length, lengths, lonlat, made));
    return classes.Region.owned(M.data.getUint32(made, true));
}

/** A map of one resolution and order as one of another. */
export function cm_healpix_regrade(of, healpix, map, to, options) {
    const { X, M, check, pointerOf, structs, classes } = of;
    const from = M.input(F64, map, Number(healpix.pixelCount), "map");
    const target = pointerOf(to, classes.Healpix, "to");
    const n = Number(to.pixelCount);
    const result = M.room(n * F64.bytes);
    check(X.cm_healpix_regrade(healpix.pointer, from, target, result, structs.write_cm_healpix_regrade_options(options)));
    return M.result(F64, undefined, result, n);
}
