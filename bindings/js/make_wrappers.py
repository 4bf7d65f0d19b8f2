#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The JavaScript of a module and its types, from the one list bindings/functions and the headers.

    make_wrappers.py MODULE FOLDER    MODULE: core, image or scene. Writes MODULE.js, MODULE.d.ts, MODULE.exports (the functions that
                                 are called) and MODULE-layouts.c (what clang is to check) into the folder
"""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import function_table  # noqa: E402
import public_headers  # noqa: E402
from layouts import SCALARS, Layouts  # noqa: E402
from wrappers import Writer  # noqa: E402
from declarations import Declarations  # noqa: E402

HEADERS = {
    "core": {"catalogue.h", "cell.h", "cell_grid.h", "covering.h", "direction.h", "distortion.h", "ellipsoid.h", "frame.h",
             "grid.h", "healpix.h", "latitude.h", "mapping.h", "options.h", "orientation.h", "pose.h", "random.h", "statistics.h",
             "status.h", "version.h"},
    "image": {"image.h", "orientation.h", "status.h", "version.h"},
    "scene": {"budget.h", "camera.h", "depth.h", "mapping.h", "mesh.h", "octree.h", "options.h", "orientation.h", "pose.h", "random.h", "raster.h",
              "status.h", "store.h", "trajectory.h", "version.h", "world.h"},
}

# Of headers that a module needs little of.
ONLY = {"scene": {"mapping.h": {"cm_mapping_destroy"}, "options.h": {"cm_mapping_create_with"}}}


def main(module, folder):
    table = function_table.read(HERE.parent / "functions")
    interface = public_headers.read(ROOT)
    only = ONLY.get(module, {})
    wanted = [one for one in table.functions if one.header in HEADERS[module] and one.name in only.get(one.header, {one.name})]
    writer = Writer(wanted, interface, Layouts(interface))
    folder = pathlib.Path(folder)
    (folder / f"{module}.js").write_text(writer.text(), encoding="utf-8")
    (folder / f"{module}.d.ts").write_text(Declarations(writer).text(), encoding="utf-8")
    (folder / f"{module}.exports").write_text("\n".join(sorted(writer.called)) + "\n", encoding="utf-8")
    (folder / f"{module}-layouts.c").write_text(writer.layouts.assertions(writer.structs_used(), HEADERS[module]), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
