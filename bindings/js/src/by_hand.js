// SPDX-License-Identifier: MIT
//
// The few functions whose arguments no rule of the list describes: pictures, rings of polygons, whole maps of HEALPix.

import { F32, F64 } from "./memory.js";
import { putPicture, settlePicture, takePicture } from "./pictures.js";

/** No surface has more pictures; what is missing of them the library refuses, as it sees zeros. */
const MOST_PICTURES = 6;

/** Pictures as structs beside each other, their pixels in the module's memory. */
function putPictures(of, pictures, name, isTarget = false) {
    if (!Array.isArray(pictures) || pictures.length > MOST_PICTURES) {
        throw new TypeError(`${name} is to be an array of at most ${MOST_PICTURES} pictures`);
    }
    const all = of.M.zeros(32 * MOST_PICTURES);
    return { all, places: pictures.map((picture, i) => putPicture(of, picture, all + 32 * i, name, isTarget)) };
}

/** Each with its pixels settled; what are no pictures stays, for putPictures to refuse. */
const settlePictures = (of, pictures) => (Array.isArray(pictures) ? pictures.map((one) => settlePicture(of, one)) : pictures);

export function cm_resample(of, plan, from, to) {
    const { X, M, check } = of;
    const [settledFrom, settledTo] = [settlePictures(of, from), settlePictures(of, to)];
    const sources = putPictures(of, settledFrom, "from");
    const targets = putPictures(of, settledTo, "to", true);
    check(X.cm_resample(of.own(), sources.all, targets.all, M.zeros(20)));
    targets.places.forEach((place) => takePicture(of, place));
    return to;
}

export function cm_sample(of, surface, pictures, filter, x, y, z) {
    const { X, M, check, code, enumerations } = of;
    const settled = settlePictures(of, pictures);
    const places = [x, y, z].map((values) => M.settle(values)); // before pictures, for which the memory may grow
    const n = M.count(places[0], "x");
    const { all } = putPictures(of, settled, "pictures");
    const [px, py, pz] = ["x", "y", "z"].map((name, i) => M.input(F64, places[i], n, name));
    const size = n * (pictures[0]?.channels ?? 1);
    const out = M.room(size * F32.bytes);
    check(X.cm_sample(of.own(), all, code(enumerations.E_cm_filter, filter, "filter"), n, px, py, pz, out));
    return M.result(F32, undefined, out, size);
}

/** Rings of longitude, latitude, longitude, latitude ..., radians. */
export function cm_region_polygon(of, nobody, rings) {
    const { X, M, check, classes } = of;
    if (!Array.isArray(rings) || !rings.every((ring) => Number.isInteger(ring?.length) && ring.length >= 0)) {
        throw new TypeError("rings is to be an array of arrays of longitude, latitude, ...");
    }
    const lengths = M.room(4 * Math.max(1, rings.length));
    rings.forEach((ring, i) => M.data.setUint32(lengths + 4 * i, ring.length / 2, true));
    const all = rings.flatMap((ring) => Array.from(ring));
    const lonlat = M.input(F64, all, all.length, "rings");
    const made = M.zeros(4);
    check(X.cm_region_polygon(rings.length, lengths, lonlat, made));
    return of.owned(classes.Region, M.data.getUint32(made, true));
}

/** A map of one resolution and order as one of another. */
export function cm_healpix_regrade(of, healpix, map, to, options) {
    const { X, M, check, pointerOf, structs, classes } = of;
    const from = M.input(F64, map, Number(healpix.pixelCount), "map");
    const target = pointerOf(to, classes.Healpix, "to");
    const n = Number(to.pixelCount);
    const result = M.room(n * F64.bytes);
    check(X.cm_healpix_regrade(of.own(), from, target, result, structs.write_cm_healpix_regrade_options(options)));
    return M.result(F64, undefined, result, n);
}
