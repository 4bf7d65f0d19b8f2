// SPDX-License-Identifier: MIT
//
// Every function of every module as it is not meant to be called: methods on objects of other classes, arguments left out or of
// any other kind. What is thrown says what is wrong; nothing traps. And the names are those of the types.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test from "node:test";

import * as core from "cubemap";
import * as image from "cubemap/image";
import * as scene from "cubemap/scene";

/** One object of each class. */
function coreObjects(lib) {
    const grid = new lib.Grid();
    return [new lib.Mapping("coupled"), grid, new lib.CellGrid(grid, "hilbert"), lib.Region.cap([0, 0, 1], 0.1),
        new lib.Healpix(4, "nested"), new lib.LatitudeConversion("WGS84", "geographic", "authalic")];
}

function imageObjects(lib) {
    const surface = new lib.Surface("equirect;size=8");
    return [surface, new lib.Plan(surface, new lib.Surface("cube:coupled;size=4"))];
}

function sceneObjects(lib) {
    const camera = new lib.Camera({ width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5 });
    const stamps = [0, 1, 2, 3];
    const path = new lib.Trajectory(stamps, stamps.map((x) => ({ rotation: { row: [1, 0, 0, 0, 1, 0, 0, 0, 1] }, position: [x, 0, 0] })));
    return [new lib.Mapping("coupled"), camera, new lib.Rays(camera), new lib.DepthPyramid(8, 6), lib.Scene.named("room"),
        new lib.Mesh({ position: [0, 0, 0, 1, 0, 0, 0, 1, 0], material: { color: [1, 0.5, 0], reflectance: 0.5 } }),
        new lib.Raster(camera), path, new lib.Motion(path), new lib.Store(), new lib.Octree({ edge: 0.05, levels: 9 })];
}

/** { name, arity, call(self, given) } of all of an object's or a class's own functions. */
function functionsOf(owner, label, isMethod) {
    return Object.entries(Object.getOwnPropertyDescriptors(owner)).filter(([name]) => name !== "constructor").map(([name, of]) => ({
        name: `${label}.${name}`, isGetter: of.get !== undefined,
        call: (self, given) => (of.get ?? of.value).apply(isMethod ? self : owner, given),
    })).filter(({ name }) => !/\.(prototype|length|name)$/.test(name));
}

const isClass = (value) => typeof value === "function" && value.toString().startsWith("class");

/** Functions and constructors that are called alone: [{ name, call }]. */
function loose(lib) {
    return Object.entries(lib).flatMap(([name, value]) => {
        if (isClass(value)) {
            return [{ name, call: (_, given) => new value(...given) }, ...functionsOf(value, name, false)];
        }
        if (typeof value === "function") {
            return [{ name, call: (_, given) => value(...given) }];
        }
        return name === "memory" ? [] : functionsOf(value, name, false);
    });
}

/** What is thrown is of these classes and in our words. */
function isClear(error) {
    return !(error instanceof WebAssembly.RuntimeError) && (error instanceof core.CubemapError || error instanceof image.CubemapError
        || error instanceof scene.CubemapError || [TypeError, RangeError, ReferenceError].includes(error.constructor))
        && !/Cannot|is not (a function|iterable|defined)|Invalid|undefined \(|Method |out of bounds/.test(error.message);
}

function clearly(what, call) {
    try {
        call();
    } catch (error) {
        assert.ok(isClear(error), `${what}: ${error.constructor.name}: ${error.message}`);
    }
}

/** "Mapping.forward": how many arguments the types want at least, of all that they have; constructors by the class's name. */
async function typesOf(module) {
    const text = (await readFile(new URL(`../dist/${module}.d.ts`, import.meta.url), "utf8")).replace(/\/\*[^]*?\*\//g, "");
    const wanted = new Map();
    const note = (name, given) => {
        // commas of objects and of texts are between other brackets
        const flat = given.replace(/\{[^{}]*\}/g, "").replace(/\{[^{}]*\}/g, "").replace(/\([^()]*\)/g, "").replace(/=>/g, "");
        const least = flat.split(",").filter((one) => one.includes(":") && !/^\s*\w+\?/.test(one)).length;
        wanted.set(name, Math.min(wanted.get(name) ?? Infinity, least));
    };
    for (const [, owner, body] of text.matchAll(/^export class (\w+) \{\n([^]*?)^\}/gm)) {
        for (const [, name, given] of body.matchAll(/^ {4}(?:static )?(\w+)\((.*?)\)(?::|;)/gm)) {
            note(name === "constructor" ? owner : `${owner}.${name}`, given);
        }
        for (const [, name] of body.matchAll(/^ {4}readonly (\w+):/gm)) {
            note(`${owner}.${name}`, "");
        }
    }
    const library = text.slice(text.indexOf("export interface Library"));
    for (const [, name, given] of library.matchAll(/^ {4}(\w+)\((.*?)\):/gm)) {
        note(name, given);
    }
    for (const [, owner, body] of library.matchAll(/^ {4}readonly (\w+): \{\n([^]*?)^ {4}\};/gm)) {
        for (const [, name, given] of body.matchAll(/^ {8}(\w+)\((.*?)\):/gm)) {
            note(`${owner}.${name}`, given);
        }
    }
    return wanted;
}

const kinds = (objects, freed) => [undefined, null, "x", "", 1n, 2n ** 70n, 0, -1, 0.5, NaN, Infinity, 2 ** 32, 1e308, true, Symbol("s"), {},
    Object.create(null), [], [1], [1, 2, 3], ["a"], [undefined], [[1, 2]], [1n], () => 1, new Date(0), new Map(), new ArrayBuffer(8),
    new DataView(new ArrayBuffer(8)), new Float64Array(3), new Int32Array(3), new BigUint64Array(3), { length: 3 }, { length: -1 },
    { rotation: { row: [1, 0, 0] } }, { rotation: { row: "abc" } }, { position: 3 }, { data: null }, { entry: [undefined] },
    { data: new Uint8Array(4), width: -2, height: -2 }, [{ data: new Uint8Array(4), width: 2, height: 2 }], ...objects, ...freed];

for (const [module, from, make] of [["core", core, coreObjects], ["image", image, imageObjects], ["scene", scene, sceneObjects]]) {
    const lib = await from.load();

    test(`${module}: methods refuse objects of other classes, and freed ones`, () => {
        const objects = make(lib);
        assert.deepEqual(objects.map((one) => one.constructor.name).sort(), Object.entries(lib).filter(([, value]) => isClass(value)).map(([name]) => name).sort());
        const freed = make(lib);
        freed.forEach((one) => one.free());
        const disguised = make(lib).map((_, k, all) => Object.setPrototypeOf(all[(k + 1) % all.length], Object.getPrototypeOf(objects[k])));
        let count = 0;
        for (const [k, own] of objects.entries()) {
            const { name: owner, prototype } = own.constructor;
            for (const { name, call } of functionsOf(prototype, owner, true)) {
                for (const self of [...objects.filter((one) => one !== own), disguised[k], Object.create(prototype), {}, undefined, 5]) {
                    assert.throws(() => call(self, [1, 1, 1]), (error) => error instanceof TypeError
                        && error.message.startsWith(`this is to be a ${owner}, not `), `${name} of a ${self?.constructor?.name}`);
                    count++;
                }
                assert.throws(() => call(freed[k], []), new RegExp(`^ReferenceError: the ${owner} has been freed`), name);
            }
        }
        assert.ok(count > 40);
    });

    test(`${module}: names and least arguments are those of the types`, async () => {
        const wanted = await typesOf(module);
        const objects = make(lib);
        const all = [...loose(lib), ...objects.flatMap((one) => functionsOf(Object.getPrototypeOf(one), one.constructor.name, true)
            .map((of) => ({ ...of, call: (_, given) => of.call(one, given) })))];
        const named = all.map(({ name }) => name).filter((name) => wanted.has(name) || !isClass(lib[name])); // some have no constructor
        const inherited = objects.map((one) => `${one.constructor.name}.free`);
        assert.deepEqual([...named, ...inherited].sort(), [...wanted.keys()].sort());
        let refused = 0;
        for (const { name, call } of all) {
            if ((wanted.get(name) ?? 0) > 0) {
                assert.throws(() => call(undefined, []), (error) => isClear(error) && !(error instanceof from.CubemapError)
                    && /is missing|is to be/.test(error.message), name);
                refused++;
            }
        }
        assert.ok(refused > 15, `${refused}`);
    });

    test(`${module}: arguments of any kind are taken or refused, and nothing traps`, () => {
        const objects = make(lib);
        const freed = make(lib);
        freed.forEach((one) => one.free());
        const calls = [...loose(lib), ...objects.flatMap((one, k) => functionsOf(Object.getPrototypeOf(one), one.constructor.name, true)
            .filter(({ isGetter, name }) => !isGetter && !name.endsWith(".free")).map((of) => ({ ...of, call: (_, given) => of.call(objects[k], given) })))];
        for (const { name, call } of calls) {
            const values = kinds(objects, freed);
            for (const [i, value] of values.entries()) {
                for (const given of [[value], [value, value, value, value, value, value, value], [value, values[(7 * i + 3) % values.length], values[(5 * i + 1) % values.length]]]) {
                    clearly(`${name}, ${typeof value} ${i}`, () => call(undefined, given));
                }
            }
        }
    });
}

test("arrays in structs have all their elements", async () => {
    const lib = await scene.load();
    const row = [1, 0, 0, 0, 1, 0, 0, 0, 1];
    assert.throws(() => lib.Pose.angle({ rotation: { row: [1, 0, 0] }, position: [0, 0, 0] }), /row has 3 elements, but is to have 9/);
    assert.throws(() => lib.Pose.angle({ rotation: { row: "abcdefghi" } }), /row is to be an array of 9, not 'abcdefghi'/);
    assert.throws(() => lib.Pose.invert({ rotation: { row }, position: [0, undefined, 0] }), /an element of position is missing/);
    const position = lib.float64(3);
    position.array.set([1, 2, 3]);
    assert.deepEqual(lib.Pose.invert({ rotation: { row }, position }).position, [-1, -2, -3]);
    assert.equal(new lib.Camera({ width: 4, height: 4, fx: 4, fy: 4, distortion: [0.1] }).options.distortion[0], 0.1);
});
