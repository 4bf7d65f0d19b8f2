// SPDX-License-Identifier: MIT
//
// Pictures as structs of the library, with their pixels in the module's memory.

import { Place, typeOf } from "./memory.js";

const PIXELS = { Uint8Array: "u8", Uint8ClampedArray: "u8", Uint16Array: "u16", Float32Array: "float" };
const BYTES = { u8: 1, u16: 2, float: 4 };

/** A picture whose pixels, if they are in this memory, are known by their place, before a call asks for memory, which may grow and
 *  end all views. */
export function settlePicture(of, picture) {
    return picture && typeof picture === "object" ? { ...picture, data: of.M.settle(picture.data) } : picture;
}

/** A picture, { data, width, height, channels }, at a place where 32 bytes are zero: where its pixels are then. */
export function putPicture(of, picture, at, name, isTarget = false) {
    const { M, structs } = of;
    if (typeof picture !== "object" || picture === null || picture.data === undefined || picture.data === null) {
        throw new TypeError(`${name} is to be a picture: { data, width, height, channels }`);
    }
    const { data, width, height, channels = 1 } = picture;
    const array = M.settle(data);
    const isHere = array instanceof Place;
    const type = PIXELS[isHere ? array.type : typeOf(array)];
    if (type === undefined) {
        throw new TypeError(`${name}: pixels are to be a Uint8Array, a Uint16Array or a Float32Array`);
    }
    if (array.length !== width * height * channels) {
        throw new RangeError(`${name}: ${array.length} numbers are not ${width} x ${height} pixels of ${channels}`);
    }
    const bytes = isHere ? undefined : new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    const size = array.length * BYTES[type];
    const place = isHere ? M[isTarget ? "writes" : "reads"](array.pointer, size) : M.room(size);
    if (!isHere) {
        new Uint8Array(M.buffer, place, bytes.length).set(bytes);
    }
    structs.write_cm_image({ type, width, height, channels }, at);
    M.data.setUint32(at + 4, place, true);
    return { place, isHere, bytes };
}

/** What the library has written, into the caller's picture. */
export function takePicture(of, { place, isHere, bytes }) {
    if (isHere) {
        of.M.written(place);
    } else {
        bytes.set(new Uint8Array(of.M.buffer, place, bytes.length));
    }
}
