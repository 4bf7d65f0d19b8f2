#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One C file of the fragments in the guides, each a function among the declarations that its page takes for granted.

    guide_code.py REPOSITORY OUTPUT DEPENDENCIES [sim]     DEPENDENCIES: for ninja, what it has read; sim: with what needs that

What is told of a fragment's results in its comments is checked behind it. A fragment that is not in the table fails, so that
each of a new page is compiled, too; whole programs of README, images and comparing are run by readme.sh.
"""

import pathlib
import re
import sys

LINKED_ELSEWHERE = {("comparing", 0), ("images", 0)}

MAPPING = "cm_mapping *mapping = NULL;\nREQUIRE(cm_mapping_create(\"coupled\", NULL, &mapping) == CM_OK);"
PICTURES = """static float pixels[6][16 * 16 * 3];
cm_image {0}[6];
for (int i = 0; i < 6; i++) {{ {0}[i] = (cm_image){{sizeof(cm_image), pixels[i], CM_PIXEL_FLOAT, 16, 16, 3, 0, 0}}; }}"""

# (page, which): what stands before it and what behind, in a function; or, of what has functions itself, what calls them, main as
# program_PAGE_WHICH
FRAGMENTS = {
    ("advice", 0): ("const double pi = 3.14159265358979323846;\n" + MAPPING,
                    "REQUIRE(face.pixels > 1000 && face.cheaper > 0);\ncm_mapping_destroy(mapping);"),
    ("cells", 0): ("", "REQUIRE(cm_cell_level(cm_cell_forward_lonlat(cells, 12, 0.234, 0.916)) == 12);\n"
                       "cm_cell_grid_destroy(cells);\ncm_grid_destroy(grid);"),
    ("colormaps", 0): "REQUIRE(program_colormaps_0() == 0);",
    ("environments", 0): (MAPPING + "\n" + PICTURES.replace("pixels", "given").format("faces")
                          + PICTURES.replace("pixels", "drawn").format("level")
                          + "cm_mapping *const target = mapping;",
                          "REQUIRE(pixels[0] > 0.0f);\ncm_environment_destroy(environment);\ncm_mapping_destroy(mapping);"),
    ("grids", 0): ("", ""),
    ("images", 1): ("cm_status status;\ncm_surface *cube = NULL;\n" + PICTURES.format("faces")
                    + "\nREQUIRE(cm_surface_create(\"cube:gnomonic;size=16\", NULL, &cube) == CM_OK);",
                    "REQUIRE(status == CM_OK && uploaded == 6 * 5);\ncm_surface_destroy(cube);"),
    ("images", 2): ("cm_status status;\nconst uint32_t width = 64, height = 32;\nconst char *xmp = \"no photo sphere\";\n"
                    "const size_t length = strlen(xmp);\ncm_surface *surface = NULL;", "REQUIRE(status == CM_ERROR_UNSUPPORTED);"),
    ("latitudes", 0): ("enum { n = 1 };\ndouble x[n] = {1.0}, y[n] = {0.0}, z[n] = {1.0}, to_x[n], to_y[n], to_z[n];",
                       "REQUIRE(latitude < 0.5 && latitude > 0.49 && to_z[0] < 1.0);\ncm_latitude_conversion_destroy(authalic);"),
    ("octree", 0): ("const cm_view view = {.size = sizeof view};", ""),
    ("scene", 0): ("", ""),
    ("scene", 1): ("", ""),
    ("scene", 2): ("", "REQUIRE(half.position[0] != pose.position[0]);"),
    ("scene", 3): "float values[] = {2.0f, 4.0f, 6.0f};\nhalve(values, 3);\nREQUIRE(values[0] == 1.0f && values[2] == 3.0f);",
    ("scene", 4): """const double stamp[] = {0.0, 1.0, 2.0};
cm_pose pose[3] = {0};
cm_trajectory *path = NULL;
for (int i = 0; i < 3; i++)
{
    pose[i].rotation.row[0][0] = pose[i].rotation.row[1][1] = pose[i].rotation.row[2][2] = 1.0;
    pose[i].position[i] = 1.0;
}
REQUIRE(cm_trajectory_create(3, stamp, pose, &path, NULL) == CM_OK);
const double error = ate_of(path, path);
REQUIRE(error >= 0.0 && error < 1e-12);
cm_trajectory_destroy(path);""",
    ("scene", 5): ("", "REQUIRE(effects[0].is_kept && !effects[1].is_kept);"),
    ("scene", 6): ("", "REQUIRE(distance == 2.5);"),
    ("scene", 7): "REQUIRE(program_scene_7() == 0);",
    ("scene", 8): ("", ""),
    ("sim", 0): """const cm_camera_options options = {.size = sizeof options, .width = 8, .height = 6, .fx = 8.0, .fy = 8.0, .cx = 3.5, .cy = 2.5};
cm_camera *camera = NULL;
cm_scene *world = NULL;
float distance[48];
REQUIRE(cm_camera_create(&options, &camera) == CM_OK && cm_scene_create_named("room", &world) == CM_OK);
REQUIRE(measure(world, camera, distance) == CM_OK);
REQUIRE(distance[20] > 0.0f);
cm_camera_destroy(camera);
cm_scene_destroy(world);""",
    ("sim-lens", 0): ("""cm_camera *camera = NULL, *pinhole = NULL;
cm_pool *pool = NULL;
cm_lens_map *map = NULL;
static float drawn_depth[1 << 20], depth[64 * 48];
static uint32_t drawn_id[1 << 20], id[64 * 48];
const uint32_t nothing = 0;
const cm_camera_options lens = {.size = sizeof lens, .width = 64, .height = 48, .fx = 40.0, .fy = 40.0, .cx = 31.5, .cy = 23.5,
                                .distortion = {-0.1}};
REQUIRE(cm_camera_create(&lens, &camera) == CM_OK);""",
                      "REQUIRE(map != NULL);\ncm_lens_map_destroy(map);\ncm_camera_destroy(pinhole);\ncm_camera_destroy(camera);"),
    ("sim-motion", 0): ("""enum { PIXELS = 320 * 240 };
static float now[4 * PIXELS], before[4 * PIXELS], flow[3 * 2 * PIXELS], corrected[4 * PIXELS];""", "REQUIRE(flows == 3);"),
}

HEAD = """/* Made by tests/programs/guide_code.py. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cubemap/cubemap.h>
#include <cubemap/colormap.h>
#include <cubemap/environment.h>
#include <cubemap/image.h>
#include <cubemap/mips.h>
#include <cubemap/octree.h>
#include <cubemap/panorama.h>
#include <cubemap/scene.h>
"""

REQUIRE = """
#define REQUIRE(what)                                                                                                            \\
    do                                                                                                                           \\
    {                                                                                                                            \\
        if (!(what))                                                                                                             \\
        {                                                                                                                        \\
            fprintf(stderr, "%s: %s\\n", __func__, #what);                                                                        \\
            exit(1);                                                                                                             \\
        }                                                                                                                        \\
    } while (0)

static int uploaded;

static void upload(uint32_t level, uint32_t face, const cm_image *image)
{
    uploaded += image->data != NULL && face < 6 && level < 32;
}
"""


def blocks(text):
    return re.findall(r"^```c\n(.*?)^```$", text, re.S | re.M)


def functions_of(page, which, code):
    """(includes, text of functions, what is called)."""
    name = f"{page}_{which}".replace("-", "_")
    includes = re.findall(r"^#include .*$", code, re.M)
    code = re.sub(r"^#include .*\n", "", code, flags=re.M)
    around = FRAGMENTS[page, which]
    if isinstance(around, str):
        code = re.sub(r"^(void|double|int|cm_status) (\w+\()", r"static \1 \2", code, flags=re.M)
        code = code.replace(" main(void)", f" program_{name}(void)")
        return includes, f"{code}\nstatic void {name}(void)\n{{\n{around}\n}}\n", f"{name}()"
    return includes, f"static void {name}(void)\n{{\n{around[0]}\n{code}\n{around[1]}\n}}\n", f"{name}()"


def main(root, output, dependencies, *options):
    includes, functions, calls, found = [], [], [], set()
    pages = sorted((pathlib.Path(root) / "docs/guide").glob("*.md"))
    pathlib.Path(dependencies).write_text(f"{output}: {' '.join(map(str, pages))}\n", encoding="utf-8")
    for path in pages:
        for which, code in enumerate(blocks(path.read_text(encoding="utf-8"))):
            page = path.stem
            if (page, which) in LINKED_ELSEWHERE or (page.startswith("sim") and "sim" not in options):
                continue
            if (page, which) not in FRAGMENTS:
                sys.exit(f"docs/guide/{page}.md: the {which + 1}. fragment of C is not in the table of tests/programs/guide_code.py")
            found.add((page, which))
            more, text, call = functions_of(page, which, code)
            includes += more
            functions.append(f"/* ---- docs/guide/{page}.md ---- */\n\n{text}")
            calls.append(call)
    missing = {one for one in FRAGMENTS if not one[0].startswith("sim") or "sim" in options} - found
    if missing:
        sys.exit(f"fragments of C that no guide has: {sorted(missing)}")
    sim = "#include <cubemap/sim.h>\n#include <cubemap/lens.h>\n" if "sim" in options else ""
    body = "\n".join(f"    {call};" for call in calls)
    pathlib.Path(output).write_text("\n".join([HEAD + sim + "\n".join(sorted(set(includes))), REQUIRE, *functions,
                                               f"int main(void)\n{{\n{body}\n    return 0;\n}}\n"]), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
