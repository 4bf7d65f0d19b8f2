// SPDX-License-Identifier: MIT
//
// Of cubemap/scene what no rule of the list describes: images and pictures, hits, keys and blobs, visits of voxels.

import { CameraError, DataError } from "./errors.js";
import { callbacksOf } from "./load.js";
import { F32, F64, U32, U8 } from "./memory.js";
import { big, present, whole } from "./numbers.js";
import { putPicture, settlePicture, takePicture } from "./pictures.js";

const STOPPED = 16;

// ---- Depth images

export function cm_depth_clean(of, nobody, picture, limits) {
    const { X, M, check, structs } = of;
    const image = structs.write_cm_image({});
    const { width, height } = present(picture, "picture");
    putPicture(of, picture, image, "picture");
    const n = width * height;
    const depth = M.room(n * F32.bytes);
    const count = structs.write_cm_depth_count({});
    check(X.cm_depth_clean(image, structs.write_cm_depth_limits(limits ?? { unit: 1 }), 1, depth, count));
    return { depth: M.result(F32, undefined, depth, n), count: structs.read_cm_depth_count(count) };
}

/** Arrays of n floats whose pointers a struct has beside each other. */
function planes(M, at, count, n) {
    return Array.from({ length: count }, (_, i) => {
        const place = M.room(n * F32.bytes);
        M.data.setUint32(at + 4 * i, place, true);
        return place;
    });
}

export function cm_depth_make_maps(of, rays, image, options) {
    const { isRange = false, gap = 0, normal = true, radius = true } = options ?? {};
    const { X, M, check, number, layouts: { cm_depth_maps: at } } = of;
    const n = rays.pixelCount;
    const p = M.zeros(at.BYTES);
    M.data.setUint32(p + at.size, at.BYTES, true);
    M.data.setInt32(p + at.isRange, isRange ? 1 : 0, true);
    M.data.setFloat64(p + at.gap, number(gap, "gap"), true);
    const vertices = planes(M, p + at.vertex, 3, n);
    const normals = normal ? planes(M, p + at.normal, 3, n) : [];
    const radii = normal && radius ? planes(M, p + at.radius, 1, n) : [];
    check(X.cm_depth_make_maps(of.own(), M.input(F32, image, n, "image"), 1, p));
    const taken = (places) => places.map((place) => M.result(F32, undefined, place, n));
    return { vertex: taken(vertices), normal: normal ? taken(normals) : null, radius: taken(radii)[0] ?? null };
}

/** The camera of an image of half the size. */
export function cm_depth_halve_camera(of, camera) {
    const { X, M, check, classes, layouts: { cm_camera_options: at } } = of;
    const half = M.zeros(at.BYTES);
    M.data.setUint32(half + at.size, at.BYTES, true);
    check(X.cm_depth_halve_camera(X.cm_camera_describe(of.own()), half));
    const made = M.zeros(4);
    check(X.cm_camera_create(half, made));
    return of.owned(classes.Camera, M.data.getUint32(made, true));
}

export function cm_depth_pyramid_level(of, pyramid, level) {
    const { X, M, check, layouts: { cm_depth_level: at } } = of;
    const p = M.zeros(at.BYTES);
    M.data.setUint32(p + at.size, at.BYTES, true);
    check(X.cm_depth_pyramid_level(of.own(), whole(present(level, "level"), "level", 0, 2 ** 31 - 1), p));
    const [width, height, least, most] = ["width", "height", "least", "most"].map((name) => M.data.getUint32(p + at[name], true));
    return { width, height, least: M.copy(F32, least, width * height), most: M.copy(F32, most, width * height) };
}

// ---- Budgets

/** What choose makes of a budget, as a new one. */
function chosen({ M, check, structs }, budget, choose) {
    const p = structs.write_cm_budget(present(budget, "budget"));
    check(choose(p));
    return structs.read_cm_budget(p);
}

export function cm_budget_limit_error(of, nobody, budget, limit) {
    return chosen(of, budget, (p) => of.X.cm_budget_limit_error(p, of.number(present(limit, "limit"), "limit")));
}

export function cm_budget_limit_cost(of, nobody, budget, limit) {
    return chosen(of, budget, (p) => of.X.cm_budget_limit_cost(p, of.number(present(limit, "limit"), "limit")));
}

export function cm_budget_sum(of, nobody, budget) {
    return chosen(of, budget, (p) => of.X.cm_budget_sum(p));
}

// ---- Worlds and trajectories

export function cm_scene_cast_array(of, scene, ...given) {
    const { X, M, layouts: { cm_hit_arrays: at } } = of;
    const names = ["originX", "originY", "originZ", "directionX", "directionY", "directionZ"];
    const n = typeof given[3] === "object" ? M.count(given[3], "directionX") : 1;
    const rays = given.map((value, i) => M.input(F64, value, n, names[i]));
    const p = M.zeros(at.BYTES);
    M.data.setUint32(p + at.size, at.BYTES, true);
    const columns = [["distance", F64, 1], ["id", U32, 1], ["triangle", U32, 1], ["normal", F64, 3], ["color", F64, 3],
        ["reflectance", F64, 1]];
    const places = columns.map(([name, kind, count]) => Array.from({ length: count }, (_, i) => {
        const place = M.room(n * kind.bytes);
        M.data.setUint32(p + at[name] + 4 * i, place, true);
        return place;
    }));
    X.cm_scene_cast_array(of.own(), n, ...rays, p);
    return Object.fromEntries(columns.map(([name, kind, count], k) => {
        const arrays = places[k].map((place) => M.result(kind, undefined, place, n));
        return [name, count === 1 ? arrays[0] : arrays];
    }));
}

/** A pointer, for the constructor. */
export function cm_trajectory_create(of, Trajectory, stamp, pose) {
    const { X, M, check, structs, layouts: { cm_pose: at } } = of;
    const n = M.count(stamp, "stamp");
    if (!Array.isArray(pose)) {
        throw new TypeError("pose is to be an array of poses");
    }
    if (pose.length !== n) {
        throw new RangeError(`pose has ${pose.length} elements, but is to have ${n}`);
    }
    const stamps = M.input(F64, stamp, n, "stamp");
    const poses = M.zeros(at.BYTES * n);
    pose.forEach((one, i) => structs.write_cm_pose(present(one, "pose"), poses + at.BYTES * i));
    const made = M.zeros(4);
    const wrong = M.zeros(4);
    try {
        check(X.cm_trajectory_create(n, stamps, poses, made, wrong));
    } catch (error) {
        if (error instanceof DataError || error instanceof CameraError) {
            error.message += `, at index ${M.data.getUint32(wrong, true)}`;
        }
        throw error;
    }
    return M.data.getUint32(made, true);
}

// ---- Stores

const bytesOf = (value, name) => {
    const bytes = typeof value === "string" ? new TextEncoder().encode(value) : value;
    if (!(bytes instanceof Uint8Array)) {
        throw new TypeError(`${name} is to be a Uint8Array`);
    }
    return bytes;
};

function putBytes(M, bytes, at) {
    const place = M.room(bytes.length);
    new Uint8Array(M.buffer, place, bytes.length).set(bytes);
    M.data.setUint32(at, place, true);
}

function putKey(of, key) {
    const { M, layouts: { cm_store_key: at } } = of;
    const bytes = bytesOf(key, "key");
    const p = M.zeros(at.BYTES);
    putBytes(M, bytes, p + at.bytes);
    M.data.setUint32(p + at.count, bytes.length, true);
    return p;
}

export function cm_store_get(of, store, key, kind, newest) {
    const { X, M, check, layouts: { cm_blob: at } } = of;
    const p = M.zeros(at.BYTES);
    M.data.setUint32(p + at.size, at.BYTES, true);
    check(X.cm_store_get(of.own(), putKey(of, key), whole(present(kind, "kind"), "kind", 0, 2 ** 32 - 1), whole(present(newest, "newest"), "newest", 0, 2 ** 32 - 1), p));
    const member = (name) => M.data.getUint32(p + at[name], true);
    const data = M.copy(U8, member("data"), member("count"));
    const blob = data && { kind: member("kind"), version: member("version"), data };
    X.cm_blob_clear(p);
    return blob;
}

export function cm_store_put(of, store, key, blob) {
    const { X, M, check, layouts: { cm_blob: at } } = of;
    const { kind = 0, version = 0, data } = present(blob, "blob");
    const bytes = bytesOf(data, "data");
    const p = M.zeros(at.BYTES);
    M.data.setUint32(p + at.size, at.BYTES, true);
    M.data.setUint32(p + at.kind, whole(kind, "kind", 0, 2 ** 32 - 1), true);
    M.data.setUint32(p + at.version, whole(version, "version", 0, 2 ** 32 - 1), true);
    M.data.setUint32(p + at.count, bytes.length, true);
    putBytes(M, bytes, p + at.data);
    check(X.cm_store_put(of.own(), putKey(of, key), p));
}

export function cm_store_remove(of, store, key) {
    of.check(of.X.cm_store_remove(of.own(), putKey(of, key)));
}

export function cm_store_next(of, store, after) {
    const { X, M, check } = of;
    const key = M.zeros(255);
    const count = M.zeros(4);
    check(X.cm_store_next(of.own(), after === undefined || after === null ? 0 : putKey(of, after), key, count));
    const n = M.data.getUint32(count, true);
    return n === 0 ? null : M.copy(U8, key, n);
}

// ---- Octrees

/** walk(pointer, job) of an octree with a job that calls visit; what visit throws is thrown after the walk's end. */
function visitVoxels(of, octree, visit, walk) {
    const { X, check, structs } = of;
    if (typeof visit !== "function") {
        throw new TypeError("visit is to be a function");
    }
    const callbacks = callbacksOf(X);
    const before = callbacks.voxel;
    let thrown;
    callbacks.voxel = (voxel) => {
        try {
            return visit(structs.read_cm_voxel(voxel)) ? 1 : 0;
        } catch (error) {
            thrown = { error };
            return 1;
        }
    };
    let status;
    try {
        status = of.whileRead((pointer) => walk(pointer, X.cubemap_voxel_job()));
    } finally {
        callbacks.voxel = before;
    }
    if (thrown !== undefined) {
        throw thrown.error;
    }
    check(status === STOPPED ? 0 : status);
}

export function cm_octree_walk_ray(of, octree, origin, direction, far, visit) {
    const { X, M, number } = of;
    const [from, along] = [M.input(F64, origin, 3, "origin"), M.input(F64, direction, 3, "direction")];
    visitVoxels(of, octree, visit, (pointer, job) => X.cm_octree_walk_ray(pointer, from, along, number(present(far, "far"), "far"), job, 0));
}

export function cm_octree_walk_box(of, octree, least, greatest, visit) {
    const { X, M } = of;
    const [from, to] = [M.input(F64, least, 3, "least"), M.input(F64, greatest, 3, "greatest")];
    visitVoxels(of, octree, visit, (pointer, job) => X.cm_octree_walk_box(pointer, from, to, job, 0));
}

export function cm_octree_walk_changes(of, octree, since, visit) {
    visitVoxels(of, octree, visit, (pointer, job) => of.X.cm_octree_walk_changes(pointer, big(present(since, "since"), "since", false), job, 0));
}

/** Arrays, since voxels are many. */
export function cm_octree_extract(of, octree, given = 0) {
    const { X, M, check, layouts: { cm_voxel: at } } = of;
    const level = whole(given, "level", -(2 ** 31), 2 ** 31 - 1);
    const counted = M.zeros(4);
    const space = X.cm_octree_extract(of.own(), level, 0, 0, counted);
    const n = M.data.getUint32(counted, true);
    if (n === 0) {
        check(space);
    }
    const p = M.room(n * at.BYTES);
    if (n > 0) {
        check(X.cm_octree_extract(of.own(), level, n, p, counted));
    }
    const voxels = { centre: new Float64Array(3 * n), edge: new Float64Array(n), alpha: new Uint8Array(n),
        hasColor: new Uint8Array(n), color: new Uint8Array(3 * n) };
    for (let i = 0, q = p; i < n; i++, q += at.BYTES) {
        for (let k = 0; k < 3; k++) {
            voxels.centre[3 * i + k] = M.data.getFloat64(q + at.x + 8 * k, true);
            voxels.color[3 * i + k] = M.data.getUint8(q + at.color + k);
        }
        voxels.edge[i] = M.data.getFloat64(q + at.edge, true);
        voxels.alpha[i] = M.data.getUint8(q + at.alpha);
        voxels.hasColor[i] = M.data.getUint8(q + at.hasColor);
    }
    return voxels;
}

export function cm_octree_save(of, octree, store, userData) {
    const { X, M, check, pointerOf, classes } = of;
    const bytes = userData === undefined || userData === null ? new Uint8Array(0) : bytesOf(userData, "userData");
    const p = bytes.length === 0 ? 0 : M.input(U8, bytes, bytes.length, "userData");
    check(X.cm_octree_save(of.ownToChange(), pointerOf(store, classes.Store, "store"), p, bytes.length));
}

export function cm_octree_user_data(of, octree) {
    const { X, M } = of;
    const count = M.zeros(4);
    const p = X.cm_octree_user_data(of.own(), count);
    return M.copy(U8, p, M.data.getUint32(count, true));
}

/** The pictures that are given in `to`; without it a color picture of four bytes a pixel and a depth picture. */
export function cm_octree_render(of, octree, camera, pose, shading, to) {
    const { X, M, check, pointerOf, structs, classes, layouts: { cm_camera_options: at } } = of;
    const pCamera = pointerOf(camera, classes.Camera, "camera");
    const options = X.cm_camera_describe(pCamera);
    const [width, height] = [M.data.getUint32(options + at.width, true), M.data.getUint32(options + at.height, true)];
    const made = to ?? { color: { data: new Uint8Array(4 * width * height), width, height, channels: 4 },
        depth: { data: new Float32Array(width * height), width, height, channels: 1 } };
    const settled = Object.fromEntries(Object.entries(made).map(([name, picture]) => [name, settlePicture(of, picture)]));
    const places = ["color", "depth"].map((name) => {
        if (made[name] === undefined || made[name] === null) {
            return { p: 0 };
        }
        const p = structs.write_cm_image({});
        return { p, place: putPicture(of, settled[name], p, name, true) };
    });
    const [color, depth] = places;
    const pShading = structs.write_cm_octree_shading(shading);
    check(X.cm_octree_render(of.own(), pCamera, structs.write_cm_pose(present(pose, "pose")), pShading, color.p, depth.p));
    places.filter(({ p }) => p !== 0).forEach(({ place }) => takePicture(of, place));
    return made;
}

export function cm_hull_carve(of, octree, masks, outsideSurvives = false) {
    const { X, M, check, structs, layouts: { cm_view: at } } = of;
    if (!Array.isArray(masks)) {
        throw new TypeError("masks is to be an array of views");
    }
    const p = M.zeros(at.BYTES * masks.length);
    masks.forEach((view, i) => structs.write_cm_view(present(view, "a view of masks"), p + at.BYTES * i));
    check(X.cm_hull_carve(of.ownToChange(), masks.length, p, outsideSurvives ? 1 : 0, 0));
}
