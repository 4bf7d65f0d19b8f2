// SPDX-License-Identifier: MIT
//
// Whole numbers for the library: what does not fit is refused, where WebAssembly would cut off bits.

/** A value in a message: a text in quotes, an object by its class. */
export function shown(value) {
    if (typeof value === "string") {
        return `'${value}'`;
    }
    if (typeof value === "object" && value !== null) {
        return `a ${typeof value.constructor === "function" ? value.constructor.name : "Object"}`;
    }
    return typeof value === "function" ? "a function" : String(value);
}

/** What must not be left out: zero would stand for it, and for a struct what is at address zero. */
export function present(value, name) {
    if (value === undefined || value === null) {
        throw new TypeError(`${name} is missing`);
    }
    return value;
}

function refuse(value, name, least, most) {
    throw new RangeError(`${name} is ${shown(value)}, but is to be of the whole numbers from ${least} to ${most}`);
}

/** A whole number of at most 32 bits, also from a boolean; 0 for none. */
export function whole(value, name, least, most) {
    if (value === undefined || value === null) {
        return 0;
    }
    if (typeof value !== "number" && typeof value !== "boolean") {
        throw new TypeError(`${name} is to be a number`);
    }
    const number = Number(value);
    if (!Number.isInteger(number) || number < least || number > most) {
        refuse(value, name, least, most);
    }
    return number;
}

/** A whole number of 64 bits; unsigned ones may be the signed ones of the same bits, as which databases have cells. */
export function big(value, name, isSigned) {
    if (typeof value !== "bigint" && typeof value !== "number") {
        throw new TypeError(`${name} is to be a whole number`);
    }
    const least = -(2n ** 63n);
    const most = isSigned ? 2n ** 63n - 1n : 2n ** 64n - 1n;
    if (typeof value === "number" && !Number.isInteger(value)) {
        refuse(value, name, least, most);
    }
    const number = BigInt(value);
    if (number < least || number > most) {
        refuse(value, name, least, most);
    }
    return number;
}
