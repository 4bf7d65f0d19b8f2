# SPDX-License-Identifier: MIT
"""What the list and the headers do not say of functions, and JavaScript must know."""

# what says in words why an object cannot be made: its function, and which of the arguments it takes
CHECKS = {"cm_mapping_create_with": ("cm_specification_check", ["specification"]),
          "cm_surface_create": ("cm_surface_check", ["specification", "options"]),
          "cm_healpix_create": ("cm_healpix_check", ["nside", "order"])}

FINDERS = {"cm_frame": "cm_frame_find", "cm_ellipsoid": "cm_ellipsoid_find"}  # structs that a text may stand for
FINDERS_ERRORS = {"cm_frame": 6, "cm_ellipsoid": 10}  # as cm_status has them, of a text that names none

# Structs that are results, though they are read and written: their size is to be set before.
RESULTS = {"cm_evaluation", "cm_motion_state"}

# Functions that say whether there is what they write: without it the result is null. And those whose own result stands in what
# they write.
SEEKERS = {"cm_octree_ray", "cm_octree_nearest"}
TELLERS = {"cm_octree_at"}

# What may be left out, beside options.
NULLABLE = {("cm_octree_update_points", "rgb"), ("cm_octree_merge", "pose"), ("cm_raster_triangles", "pose"),
            ("cm_raster_discs", "pose"), ("cm_raster_points", "pose"), ("cm_raster_weights", "pose"),
            ("cm_octree_at", "level"), ("cm_octree_load", "options"), ("cm_raster_create", "nearest")}

# What may not be left out, though options elsewhere may.
REQUIRED = {("cm_camera_create", "options"), ("cm_motion_inertial", "options"), ("cm_frame_check", "frame")}

# Arrays in structs of which the first elements are enough.
FEWER = {("cm_camera_options", "distortion")}

# Objects that must outlive what is made, or what they are added to, as JavaScript.
NEEDS = {"cm_raster_create": ["camera"], "cm_octree_create": ["options?.pages"], "cm_octree_load": ["options?.pages"],
         "cm_scene_add": ["primitive?.mesh", "primitive?.motion"]}

# Structs whose texts may be none, also in what is read; and what is given where not all of a struct's members must be.
TEXTS_OR_NULL = {"cm_budget", "cm_budget_entry"}
GIVEN = {"cm_budget": "BudgetGiven"}

# Members that are whole numbers in C and have an enumeration.
WORDS = {("cm_octree_options", "rule"): "cm_octree_rule", ("cm_voxel", "state"): "cm_voxel_state"}

# Arrays that structs point to: how many elements, as the member that counts and how many of them are one, or as JavaScript of
# the object o. The counting members follow from the arrays.
EXTENTS = {
    "cm_budget": {"entry": ("count", 1)},
    "cm_mesh_options": {"position": ("vertex_count", 3), "normal": ("vertex_count", 3), "uv": ("vertex_count", 2),
                        "color": ("vertex_count", 3), "index": ("triangle_count", 3)},
    "cm_triangles": {"position": ("vertex_count", 3), "index": ("triangle_count", 3)},
    "cm_discs": {"centre": ("count", 1), "normal": ("count", 1), "radius": ("count", 1)},
    "cm_points": {"position": ("count", 3)},
    "cm_octree_shading": {"mesh_color": "3 * (o.mesh?.pixelCount ?? 0)"},
}

# Of a count without an array: triangles without indices have their vertices in a row.
COUNTED = {("cm_triangles", "triangle_count"): "vertexCount / 3"}

# Written by hand (src/by_hand.js, src/scene_by_hand.js): the arguments there, their types and the result's, and what they
# need: other functions, structs that they write, that they read (<), and whose layout they have (@).
BY_HAND = {
    "cm_resample": ("from, to", "(from: readonly Picture[], to: Picture[]): Picture[]", ["cm_image"]),
    "cm_sample": ("pictures, filter, x, y, z",
                  "(pictures: readonly Picture[], filter: Filter, x: Reals, y: Reals, z: Reals): Float32Array", ["cm_image"]),
    "cm_region_polygon": ("rings", "(rings: readonly ArrayLike<number>[]): Region", []),
    "cm_healpix_regrade": ("map, to, options",
                           "(map: Reals, to: Healpix, options?: HealpixRegradeOptions | null): Float64Array",
                           ["cm_healpix_regrade_options"]),
    "cm_depth_clean": ("picture, limits",
                       "(picture: Picture, limits?: Partial<DepthLimits>): { depth: Float32Array; count: DepthCount }",
                       ["cm_image", "cm_depth_limits", "cm_depth_count", "<cm_depth_count"]),
    "cm_depth_make_maps": ("image, options",
                           "(image: Floats, options?: { isRange?: boolean; gap?: number; normal?: boolean; radius?: boolean } | null): DepthMapArrays",
                           ["@cm_depth_maps"]),
    "cm_depth_halve_camera": ("", "(): Camera", ["@cm_camera_options", "cm_camera_describe", "cm_camera_create"]),
    "cm_depth_pyramid_level": ("level", "(level: number): DepthLevelArrays", ["@cm_depth_level"]),
    "cm_scene_cast_array": ("originX, originY, originZ, directionX, directionY, directionZ",
                            "(originX: Reals, originY: Reals, originZ: Reals, directionX: Reals, directionY: Reals, directionZ: Reals): HitArrays",
                            ["@cm_hit_arrays"]),
    "cm_budget_limit_error": ("budget, limit", "(budget: BudgetGiven, limit: number): Budget", ["cm_budget", "<cm_budget"]),
    "cm_budget_limit_cost": ("budget, limit", "(budget: BudgetGiven, limit: number): Budget", ["cm_budget", "<cm_budget"]),
    "cm_budget_sum": ("budget", "(budget: BudgetGiven): Budget", ["cm_budget", "<cm_budget"]),
    "cm_trajectory_create": ("stamp, pose", "(stamp: Reals, pose: readonly Pose[])", ["cm_pose", "@cm_pose"]),
    "cm_store_get": ("key, kind, newest", "(key: Key, kind: number, newest: number): StoredBlob | null",
                     ["@cm_store_key", "@cm_blob", "cm_blob_clear"]),
    "cm_store_put": ("key, blob", "(key: Key, blob: StoredBlob): void", ["@cm_store_key", "@cm_blob"]),
    "cm_store_remove": ("key", "(key: Key): void", ["@cm_store_key"]),
    "cm_store_next": ("after", "(after?: Key | null): Uint8Array | null", ["@cm_store_key"]),
    "cm_octree_walk_ray": ("origin, direction, far, visit",
                           "(origin: Reals, direction: Reals, far: number, visit: (voxel: Voxel) => unknown): void",
                           ["<cm_voxel", "cubemap_voxel_job"]),
    "cm_octree_walk_box": ("least, greatest, visit",
                           "(least: Reals, greatest: Reals, visit: (voxel: Voxel) => unknown): void",
                           ["<cm_voxel", "cubemap_voxel_job"]),
    "cm_octree_walk_changes": ("since, visit", "(since: bigint, visit: (voxel: Voxel) => unknown): void",
                               ["<cm_voxel", "cubemap_voxel_job"]),
    "cm_octree_extract": ("level", "(level?: number): VoxelArrays", ["@cm_voxel"]),
    "cm_octree_save": ("store, userData", "(store: Store, userData?: Uint8Array | null): void", []),
    "cm_octree_user_data": ("", "(): Uint8Array | null", []),
    "cm_octree_render": ("camera, pose, shading, to",
                         "(camera: Camera, pose: Partial<Pose>, shading?: Partial<OctreeShading> | null, to?: RenderedPictures): RenderedPictures",
                         ["cm_image", "cm_pose", "cm_octree_shading", "cm_camera_describe", "@cm_camera_options"]),
    "cm_hull_carve": ("masks, outsideSurvives", "(masks: readonly Partial<View>[], outsideSurvives?: boolean): void", ["cm_view", "@cm_view"]),
}

# Static in the list, since no object of theirs is an argument, but methods.
METHODS = {"cm_depth_halve_camera"}
