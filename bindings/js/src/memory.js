// SPDX-License-Identifier: MIT
//
// What lies in a module's memory: arrays that live there, arguments that are put there for one call, texts.

import { big, shown, whole } from "./numbers.js";

/** What an array holds: the typed array of it and how large an element is. */
function kind(Type, name, viewed) {
    const isBig = viewed.startsWith("Big");
    return { Type, bytes: Type.BYTES_PER_ELEMENT, name, isBig, get: `get${viewed}`, set: `set${viewed}` };
}

export const F64 = kind(Float64Array, "float64", "Float64");
export const F32 = kind(Float32Array, "float32", "Float32");
export const U8 = kind(Uint8Array, "uint8", "Uint8");
export const U32 = kind(Uint32Array, "uint32", "Uint32");
export const I64 = kind(BigInt64Array, "int64", "BigInt64");
export const U64 = kind(BigUint64Array, "uint64", "BigUint64");

const ARENA = 1 << 16;

/** "Float64Array" of one, of a class that extends it, as Node's Buffer, and of one from another window or context. */
export function typeOf(value) {
    return ArrayBuffer.isView(value) ? value[Symbol.toStringTag] : undefined;
}

/** Where an array in the memory is. */
export class Place {
    constructor(type, pointer, length) {
        this.type = type;
        this.pointer = pointer;
        this.length = length;
    }
}

/** An array in the module's memory, until free() or until nobody has it. `array` is a view of it that is good until the
 *  memory grows: ask for it anew after a call that may allocate. */
export class Vector {
    #memory;
    #view;
    #pointer;

    constructor(memory, of, length) {
        if (!Number.isInteger(length) || length < 0) {
            throw new RangeError(`the length of an array is ${shown(length)}, but is to be a whole number, 0 or more`);
        }
        this.kind = of;
        this.length = length;
        this.#memory = memory;
        this.#pointer = memory.allocate(Math.max(1, length * of.bytes));
        memory.keep(this, this.#pointer, "free");
        this.array.fill(of.isBig ? 0n : 0);
    }

    isIn(memory) {
        return this.#memory === memory;
    }

    get pointer() {
        if (this.#pointer === 0) {
            throw new ReferenceError("the array has been freed");
        }
        return this.#pointer;
    }

    get array() {
        const buffer = this.#memory.buffer;
        if (this.#view === undefined || this.#view.buffer !== buffer) {
            this.#view = new this.kind.Type(buffer, this.pointer, this.length);
        }
        return this.#view;
    }

    free() {
        if (this.#pointer !== 0) {
            this.#memory.give(this, this.#pointer, "free");
            this.#pointer = 0;
            this.#view = undefined;
        }
    }
}

export class Memory {
    #exports;
    #data;
    #arena;
    #used = 0;
    #more = [];
    #read = []; // places of a call's inputs, [begin, end]
    #aside = []; // places of its outputs that lie on inputs, [where it writes, where that belongs, bytes]
    #registry;

    constructor(exports) {
        this.#exports = exports;
        this.#arena = exports.malloc(ARENA);
        this.#registry = new FinalizationRegistry(({ pointer, how }) => exports[how](pointer));
    }

    get buffer() {
        return this.#exports.memory.buffer;
    }

    get data() {
        if (this.#data === undefined || this.#data.buffer !== this.buffer) {
            this.#data = new DataView(this.buffer);
        }
        return this.#data;
    }

    allocate(bytes) {
        const pointer = bytes < 2 ** 31 ? this.#exports.malloc(bytes) >>> 0 : 0;
        if (pointer === 0) {
            throw new RangeError(`no memory for ${bytes} bytes`);
        }
        return pointer;
    }

    /** Gives a pointer back by the function `how` when nobody has the owner any more. */
    keep(owner, pointer, how) {
        this.#registry.register(owner, { pointer, how }, owner);
    }

    /** The same now. */
    give(owner, pointer, how) {
        this.#registry.unregister(owner);
        this.#exports[how](pointer);
    }

    // ---- Room for the arguments of one call

    mark() {
        return { used: this.#used, more: this.#more.length, read: this.#read.length, aside: this.#aside.length };
    }

    release(mark) {
        this.#used = mark.used;
        this.#read.length = mark.read;
        this.#aside.length = mark.aside;
        while (this.#more.length > mark.more) {
            this.#exports.free(this.#more.pop());
        }
    }

    /** So many bytes, aligned to 16, of any value. */
    room(bytes) {
        const size = (bytes + 15) & ~15;
        if (bytes < ARENA && this.#used + size <= ARENA) {
            const pointer = this.#arena + this.#used;
            this.#used += size;
            return pointer;
        }
        const pointer = this.allocate(Math.max(1, bytes));
        this.#more.push(pointer);
        return pointer;
    }

    /** For the library to judge, if a length from which that follows is negative. */
    zeros(size) {
        const bytes = Math.max(0, size);
        const pointer = this.room(bytes);
        new Uint8Array(this.buffer, pointer, bytes).fill(0);
        return pointer;
    }

    // ---- Texts

    text(value, name) {
        if (value === undefined || value === null) {
            return 0;
        }
        if (typeof value !== "string") {
            throw new TypeError(`${name} is to be a text`);
        }
        if (value.includes("\0")) {
            throw new TypeError(`${name} has a character of code 0, which would end it`);
        }
        const bytes = new TextEncoder().encode(value);
        const pointer = this.zeros(bytes.length + 1);
        new Uint8Array(this.buffer, pointer, bytes.length).set(bytes);
        return pointer;
    }

    string(pointer) {
        if (pointer === 0) {
            return null;
        }
        const all = new Uint8Array(this.buffer);
        return new TextDecoder().decode(all.subarray(pointer, all.indexOf(0, pointer)));
    }

    // ---- Places that are the caller's own

    /** Notes that a call reads there. */
    reads(pointer, bytes) {
        this.#read.push([pointer, pointer + bytes]);
        return pointer;
    }

    /** Where a call may write what belongs there: aside if it reads there, which few functions allow. */
    writes(pointer, bytes) {
        if (!this.#read.some(([begin, end]) => pointer < end && begin < pointer + bytes)) {
            return pointer;
        }
        const aside = this.room(bytes);
        new Uint8Array(this.buffer).copyWithin(aside, pointer, pointer + bytes);
        this.#aside.push([aside, pointer, bytes]);
        return aside;
    }

    /** Where it belongs, and is now. */
    written(pointer) {
        const [from, to, bytes] = this.#aside.find(([aside]) => aside === pointer) ?? [pointer, pointer, 0];
        new Uint8Array(this.buffer).copyWithin(to, from, from + bytes);
        return to;
    }

    // ---- Arrays

    /** An array in this memory by its place, before a call asks for memory, which may grow and end all views. */
    settle(value) {
        if (value instanceof Vector) {
            return value.isIn(this) ? new Place(value.kind.Type.name, value.pointer, value.length) : value.array;
        }
        const isHere = ArrayBuffer.isView(value) && value.buffer === this.buffer;
        return isHere ? new Place(typeOf(value), value.byteOffset, value.length) : value;
    }

    /** The same of all members. */
    settleAll(values) {
        return values && Object.fromEntries(Object.entries(values).map(([name, value]) => [name, this.settle(value)]));
    }

    /** How many elements. */
    count(value, name) {
        if (!Number.isInteger(value?.length) || value.length < 0) {
            throw new TypeError(`${name} is to be a number or an array of numbers`);
        }
        return value.length;
    }

    /** Where n elements are, for a function to read: the array's own place if it is in this memory, else a copy. */
    input(of, value, n, name) {
        let given = this.settle(value);
        if (typeof given !== "object" || given === null) {
            if (n > 1) {
                throw new TypeError(`${name} is to be an array of ${n}`);
            }
            const pointer = this.room(of.bytes);
            this.data[of.set](pointer, this.#number(of, given, name), true);
            return pointer;
        }
        if (given.length !== n) {
            throw new RangeError(`${name} has ${given.length} elements, but is to have ${n}`);
        }
        const type = given.type ?? typeOf(given);
        if (type !== undefined && type !== of.Type.name && !(type === "Float32Array" && of === F64)) {
            throw new TypeError(`${name} is to be a ${of.Type.name}`);
        }
        if (given instanceof Place && type === of.Type.name) {
            return this.reads(given.pointer, n * of.bytes);
        }
        const pointer = this.room(n * of.bytes);
        if (given instanceof Place) {
            given = new Float32Array(this.buffer, given.pointer, n);
        }
        const view = new of.Type(this.buffer, pointer, n);
        if (type !== undefined) {
            view.set(given);
        } else {
            for (let i = 0; i < n; i++) {
                view[i] = this.#number(of, given[i], name);
            }
        }
        return pointer;
    }

    /** Where a copy of n elements is, for a function to change. */
    copied(of, value, n, name) {
        const given = this.settle(value);
        const from = this.input(of, given, n, name);
        if (!(given instanceof Place)) {
            return from; // a copy
        }
        const pointer = this.room(n * of.bytes);
        new Uint8Array(this.buffer).copyWithin(pointer, from, from + n * of.bytes);
        return pointer;
    }

    /** Where a function is to write n elements. */
    output(of, value, n, name) {
        if (value === undefined || value === null) {
            return this.room(n * of.bytes);
        }
        const given = this.settle(value);
        if ((given instanceof Place ? given.type : typeOf(given)) !== of.Type.name) {
            throw new TypeError(`${name} is to be a ${of.Type.name}`);
        }
        if (given.length !== n) {
            throw new RangeError(`${name} has ${given.length} elements, but is to have ${n}`);
        }
        return given instanceof Place ? this.writes(given.pointer, n * of.bytes) : this.room(n * of.bytes);
    }

    /** What the function has written: in the caller's array if that is given. */
    result(of, value, pointer, n) {
        const place = this.written(pointer);
        if (value instanceof Vector) {
            return value.isIn(this) ? value.array : this.result(of, value.array, place, n);
        }
        const view = new of.Type(this.buffer, place, n);
        if (value === undefined || value === null) {
            return view.slice();
        }
        if (value.buffer === this.buffer || value.length !== n) {
            return view; // in this memory; without a length if that has grown
        }
        value.set(view);
        return value;
    }

    /** n elements that are there, as an array of the caller's; null where there are none. */
    copy(of, pointer, n) {
        return pointer === 0 ? null : new of.Type(this.buffer, pointer, n).slice();
    }

    first(of, pointer) {
        return this.data[of.get](pointer, true);
    }

    isFloat(value) {
        return (value instanceof Place ? value.type : typeOf(value)) === "Float32Array";
    }

    #number(of, value, name) {
        if (of.isBig) {
            return big(value, name, of === I64);
        }
        if (typeof value !== "number") {
            throw new TypeError(`${name} is to be of numbers`);
        }
        return of === U8 || of === U32 ? whole(value, name, 0, of === U8 ? 255 : 2 ** 32 - 1) : value;
    }
}
