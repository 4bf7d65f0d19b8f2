#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The rooms of the house and the arrows between them, read from every #include of the tree.

check_rooms.py [ROOT]        check the tree; names file and line of each include that breaks a rule
check_rooms.py --self-test   check that every rule finds the fault that is made for it
check_rooms.py --table       print the table of rooms
"""

import collections
import fnmatch
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import house

# A room: its folder, and the rooms whose files its own may include, beside its own. What is true of every folder
# below another is said once, with a star. "public" is include/cubemap with its kernels, which everybody may use, ".." the
# folder that a room is in.
Room = collections.namedtuple("Room", "folder uses")
ROOMS = [
    # the core, from the bottom up
    Room("include/cubemap/kernel", []),
    Room("include/cubemap", ["include/cubemap/kernel"]),
    Room("libcubemap/batch", ["public"]),
    Room("libcubemap/mapping", ["public", "libcubemap/batch"]),
    Room("libcubemap/earth", ["public", "libcubemap/batch", "libcubemap/mapping"]),
    Room("libcubemap/cells", ["public", "libcubemap/batch", "libcubemap/mapping", "libcubemap/earth"]),
    Room("libcubemap/healpix", ["public", "libcubemap/batch", "libcubemap/mapping", "libcubemap/earth"]),
    Room("libcubemap/measure", ["public", "libcubemap/batch", "libcubemap/mapping", "libcubemap/earth"]),
    Room("libcubemap/advise", ["public", "libcubemap/batch", "libcubemap/mapping", "libcubemap/earth",
                               "libcubemap/measure"]),
    Room("libcubemap/orient", ["public", "libcubemap/batch", "libcubemap/mapping", "libcubemap/earth",
                               "libcubemap/measure"]),
    # who uses it
    Room("modules/memory", []),
    Room("modules/image", ["public", "modules/memory"]),
    Room("modules/image/io", ["public", "modules/image"]),
    Room("modules/*", ["public", "modules/memory"]),
    Room("modules/*/io", ["public", "..", "modules/image/io"]),
    Room("truth", ["public"]),
    Room("bench/harness", ["public", "truth"]),
    Room("bench/*", ["public", "modules/*", "truth", "bench/harness"]),
    Room("tools/cli", ["public", "modules/*/io"]),
    Room("tools/image", ["public", "modules/*/io", "tools/cli"]),
    Room("tools/bench", ["public", "tools/cli", "truth", "bench/harness"]),
    Room("tools/*", ["public", "modules/*/io", "tools/cli", "tools/image"]),
    Room("bindings/*", ["public"]),
    Room("bindings/*/tests", ["public", "truth", ".."]),
    Room("web", ["public"]),
    Room("examples/*", ["public"]),
    # who judges it: a folder of tests may look into everything below, and into what all tests share
    Room("tests", ["public", "truth"]),
    Room("tests/*", ["public", "libcubemap/*", "modules/*", "truth", "bench/*", "tools/*", "tests"]),
]
PUBLIC = ["include/cubemap", "include/cubemap/kernel"]

# What is not ours, and slow to compile and to load: only these rooms include it.
KEPT = {"OpenImageIO/": ["modules/image/io"], "gdal": ["modules/image/io"], "sqlite3": ["modules/scene/io", "tests/scene"],
        "zstd": ["modules/scene/io"], "OpenEXR/": ["modules/sim/io"], "opencv2/": ["modules/sim/io", "bench/sim"], "tiny_gltf": ["modules/scene/io"], "tiny_obj_loader": ["modules/scene/io"],
        "cjson/": ["modules/scene/io", "tools/cli", "tools/tof"]}

# Texts of numbers are read by one function alone, in every locale the same: <cubemap/number.h>. Tests have another judge, and
# an example is as short as a user's program.
READS_NUMBERS = re.compile(r"\b(?:strto(?:d|f|ld)|atof|sto(?:d|f|ld))\s*\(|scanf\s*\([^;]*%\*?\d*(?:l|L)?[aefg]")
MAY_READ_NUMBERS = ["tests/*", "bindings/*/tests/*", "examples/*"]

# Products of sizes wrap where size_t has 32 bits: <modules/memory/checked_size.h> counts memory for modules.
ALLOCATES = re.compile(r"\b(?:malloc|realloc|aligned_alloc|cm_large_allocate|cm_huge_allocate)\(")
COUNTS_MEMORY = "modules/*.c"
MAY_MULTIPLY = ["modules/*/io/*"]

SOURCES = (".c", ".cpp")
HEADERS = (".h", ".hpp")
TEXTS = (".inc",)

# Kernels are read once for each precision and instruction set, as shaders too: they are the texts that keep the
# name of headers, since users include them. So is what fuzzers are built with.
WITHOUT_GUARDS = ["include/cubemap/kernel/*.h"]

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<(cubemap/[^>]+)>)', re.M)
NAMED_IN_MACRO = re.compile(r'^[ \t]*#[ \t]*define[ \t]+\w+[ \t]+"([^"\n]+\.(?:inc|h|hpp))"', re.M)
Include = collections.namedtuple("Include", "path line text quoted is_macro")


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def is_folder_of(folder, pattern):
    """Does a star of the pattern stand for one folder?"""
    parts, wanted = folder.split("/"), pattern.split("/")
    return len(parts) == len(wanted) and all(map(fnmatch.fnmatchcase, parts, wanted))


def room_of(path):
    """The room of a file: the longest folder of the table that it is in. A star is one folder."""
    folder = os.path.dirname(path)
    while folder:
        for room in ROOMS:
            if folder == room.folder:
                return Room(folder, room.uses)
        for room in ROOMS:
            if is_folder_of(folder, room.folder):
                return Room(folder, [os.path.dirname(folder) if use == ".." else use for use in room.uses])
        folder = os.path.dirname(folder)
    return None


def may_use(room, other):
    if room.folder == other.folder:
        return True
    uses = [each for use in room.uses for each in (PUBLIC if use == "public" else [use])]
    return any(fnmatch.fnmatchcase(other.folder, use) for use in uses)


def includes_of(path, text):
    for match in INCLUDE.finditer(text):
        yield Include(path, line_of(text, match.start()), match[1] or match[2], match[1] is not None, False)
    for match in NAMED_IN_MACRO.finditer(text):
        yield Include(path, line_of(text, match.start()), match[1], True, True)


def target_of(include, tree):
    """The file that is meant, or None if the tree has no such file."""
    beside = os.path.normpath(os.path.join(os.path.dirname(include.path), include.text)).replace(os.sep, "/")
    public = "include/" + include.text
    if not include.quoted:
        return public if public in tree else None
    for path in (beside, include.text):
        if path in tree:
            return path
    return None


def check_kept(path, text, complaints):
    """What others made that is for one room alone."""
    for match in re.finditer(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)', text, re.M):
        for begin, folders in KEPT.items():
            if match[1].startswith(begin) and os.path.dirname(path) not in folders:
                complaints.append(f"{path}:{line_of(text, match.start())}: {match[1]} is for {', '.join(folders)} alone")


def check_numbers(path, text, complaints):
    """The one reader of numbers."""
    if any(fnmatch.fnmatchcase(path, pattern) for pattern in MAY_READ_NUMBERS):
        return
    for match in READS_NUMBERS.finditer(text):
        complaints.append(f"{path}:{line_of(text, match.start())}: {match[0]} reads a number; cm_number_parse does in every locale")


def arguments_at(text, begin):
    """What stands between the bracket before `begin` and the one that closes it."""
    depth, end = 1, begin
    while depth > 0 and end < len(text):
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        end += 1
    return text[begin:end - 1]


def check_sizes(path, text, complaints):
    """Nothing is asked for by a product that may wrap."""
    if not fnmatch.fnmatchcase(path, COUNTS_MEMORY) or any(fnmatch.fnmatchcase(path, other) for other in MAY_MULTIPLY):
        return
    for match in ALLOCATES.finditer(text):
        if re.search(r"[\w)\]] \* \S", arguments_at(text, match.end())):
            complaints.append(f"{path}:{line_of(text, match.start())}: {match[0]} of a product, which may wrap: cm_array_of, "
                              "or cm_size_product")


def check_include(include, target, complaints):
    """One include: is it named as it should be, and may the one room use the other?"""
    def complain(why):
        complaints.append(f'{include.path}:{include.line}: "{include.text}": {why}')

    room = room_of(include.path)
    is_beside = "/" not in include.text
    if target is None:
        if include.quoted:
            complain("there is no such file, neither in the same folder nor from the top of the tree")
        else:
            complain("there is no such public header")
        return
    if include.quoted and not is_beside and include.text != target and not include.path.startswith("include/"):
        complain("neither a file of the same folder nor a path from the top of the tree")
    if target.endswith(SOURCES):
        complain("a source is compiled, not included; a text that others include ends in .inc")
    if include.path.startswith("include/") and not target.startswith("include/"):
        complain("a public header includes what users do not have")
    other = room_of(target)
    if room is None or other is None:
        complain(f"{include.path if room is None else target} is in no room of the table")
    elif not may_use(room, other):
        complain(f"{room.folder} may not use {other.folder}")


# ---- circles ----

def unit_of(path):
    """A header and the source beside it of the same name are one."""
    stem, ending = os.path.splitext(path)
    return stem + ".[ch]" if ending in SOURCES + HEADERS else path


def circles(edges):
    """One way round each circle among {from: {to: include}}, as lists of includes."""
    found = []
    state = {}
    for start in sorted(edges):
        way = [(start, iter(sorted(edges.get(start, {}))))]
        if start in state:
            continue
        state[start] = 1
        while way:
            here, rest = way[-1]
            for there in rest:
                if state.get(there) == 1:
                    ring = [name for name, _ in way]
                    ring = ring[ring.index(there):] + [there]
                    found.append([edges[a][b] for a, b in zip(ring, ring[1:])])
                elif there not in state:
                    state[there] = 1
                    way.append((there, iter(sorted(edges.get(there, {})))))
                    break
            else:
                state[here] = 2
                way.pop()
    return found


def check_circles(includes, complaints):
    units = collections.defaultdict(dict)
    rooms = collections.defaultdict(dict)
    for include, target in includes:
        if unit_of(target) != unit_of(include.path):
            units[unit_of(include.path)].setdefault(unit_of(target), include)
        here, there = room_of(include.path), room_of(target)
        if here is not None and there is not None and here.folder != there.folder:
            rooms[here.folder].setdefault(there.folder, include)
    for what, edges in (("files", units), ("rooms", rooms)):
        for ring in circles(edges):
            places = ", ".join(f"{i.path}:{i.line} includes {i.text}" for i in ring)
            complaints.append(f"{ring[0].path}:{ring[0].line}: a circle of {what}: {places}")


# ---- files ----

def top_comment(text):
    return text[2:text.find("*/")] if text.startswith("/*") else ""


def check_text(path, text, readers, tree, complaints):
    """A text that is compiled several times: says who reads it, and those do."""
    comment = top_comment(text)
    said = re.search(r"\b(?:[Rr]ead|[Ii]ncluded)\b[^.]*?\bby\b", comment)
    if said is None:
        complaints.append(f'{path}:1: does not say at its top who includes it ("Read by ...")')
        return
    named = re.findall(r"[\w*]+(?:/[\w*]+)*\.(?:cpp|c|hpp|h|inc)\b", comment)
    for reader in sorted(readers):
        if not any(fnmatch.fnmatchcase("/" + reader, "*/" + name) for name in named):
            complaints.append(f"{path}:1: {reader} includes it, which its top does not say")
    for name in named:
        if not any(fnmatch.fnmatchcase("/" + other, "*/" + name) for other in tree):
            complaints.append(f"{path}:{line_of(text, text.find(name))}: there is no {name}")
    if not readers:
        complaints.append(f"{path}:1: nobody includes it")


def check_guard(path, text, guards, complaints):
    if any(fnmatch.fnmatchcase(path, pattern) for pattern in WITHOUT_GUARDS):
        return
    guard = re.search(r"^#ifndef (\w+)\n#define (\w+)$", text, re.M)
    if guard is None or guard[1] != guard[2]:
        complaints.append(f"{path}:1: no include guard; a text that is read several times ends in .inc")
    elif guard[1] in guards:
        complaints.append(f"{path}:{line_of(text, guard.start())}: the guard {guard[1]} is that of {guards[guard[1]]}")
    else:
        guards[guard[1]] = path


def check_main(path, text, complaints):
    """What has main is called by nobody: a program's parts may not need its main file."""
    if re.search(r"^int main\(", text, re.M) is None:
        return
    for match in re.finditer(r"^(?!.*\bstatic\b|typedef|int main\()[A-Za-z][\w *]*\b(\w+)\([^;{}]*\)\n\{", text, re.M):
        if match[1].startswith("__wrap_"):
            continue # what the linker puts in the place of another
        complaints.append(f"{path}:{line_of(text, match.start())}: {match[1]} is not static, in a file with main")


DECLARED = re.compile(r"^(?!typedef|static|return)[A-Za-z][\w *]*?[ *](\w+)\([^;{}]*\);", re.M)
DEFINED = re.compile(r"^(?!.*\bstatic\b|typedef)[A-Za-z][\w *]*?[ *](\w+)\([^;{}]*\)\n\{", re.M)


def homes_of(tree):
    """{function: the rooms that define one of that name}"""
    homes = collections.defaultdict(set)
    for path, text in tree.items():
        if path.endswith(SOURCES + TEXTS) and room_of(path) is not None:
            for match in DEFINED.finditer(text):
                homes[match[1]].add(room_of(path).folder)
    return homes


def check_homes(tree, homes, complaints):
    """What a room's own header declares, that room defines; or a header hides an arrow that points up."""
    for path, text in sorted(tree.items()):
        if not path.endswith(HEADERS) or path.startswith("include/") or room_of(path) is None:
            continue
        for match in DECLARED.finditer(text):
            if homes[match[1]] and room_of(path).folder not in homes[match[1]]:
                complaints.append(f"{path}:{line_of(text, match.start())}: {match[1]} is declared here, but is of "
                                  f"{', '.join(sorted(homes[match[1]]))}")


def check_calls(tree, homes, complaints):
    """Within the library public headers hide who is called: so functions are looked for, too."""
    for path, text in sorted(tree.items()):
        if not path.startswith("libcubemap/") or not path.endswith(SOURCES + TEXTS) or room_of(path) is None:
            continue
        code = re.sub(r"/\*.*?\*/", lambda match: re.sub(r"[^\n]", " ", match[0]), text, flags=re.S)
        for match in re.finditer(r"\b(cm_\w+)\(", code):
            rooms = homes.get(match[1], set())
            if rooms and not any(may_use(room_of(path), Room(room, [])) for room in rooms):
                complaints.append(f"{path}:{line_of(text, match.start())}: calls {match[1]} of {', '.join(sorted(rooms))}, "
                                  f"which {room_of(path).folder} may not use")


def check_build(path, text, complaints):
    for match in re.finditer(r"'[^'\n]*\.inc'", text):
        complaints.append(f"{path}:{line_of(text, match.start())}: {match[0]} is compiled; it is only to be included")


def check_table(complaints):
    """The table itself: only known rooms, no circle."""
    names = [room.folder for room in ROOMS]
    edges = collections.defaultdict(dict)
    for room in ROOMS:
        for use in room.uses:
            for name in PUBLIC if use == "public" else [os.path.dirname(room.folder) if use == ".." else use]:
                if not any(fnmatch.fnmatchcase(other, name) or other == name for other in names):
                    complaints.append(f"the table: {room.folder} may use {name}, which is no room")
                edges[room.folder][name] = Include(f"the table, {room.folder}", 0, name, True, False)
    for ring in circles(edges):
        complaints.append("the table: a circle: " + " -> ".join(i.text for i in ring))


def check_document(path, text, complaints):
    """The table of the core's own document is that of this file."""
    said = {match[1]: set(re.findall(r"\w+", match[2]))
            for match in re.finditer(r"^\| `(\w+)/` \|[^|]*\| ([\w, ]+) \|$", text, re.M)}
    for room in ROOMS:
        parent, name = os.path.split(room.folder)
        if parent != os.path.dirname(path):
            continue
        uses = {"kernels" if use == "public" else os.path.basename(use) for use in room.uses}
        uses = uses - {"kernels"} or uses
        if said.get(name) != uses:
            complaints.append(f"{path}:1: {name} may use {', '.join(sorted(uses))}, which is not what is said here")


def check(tree):
    """Complaints about a tree {path: text}, and how many includes there are."""
    complaints = []
    check_table(complaints)
    includes = []
    readers = collections.defaultdict(set)
    guards = {}
    for path, text in sorted(tree.items()):
        if path.endswith(SOURCES + HEADERS + TEXTS):
            for include in includes_of(path, text):
                target = target_of(include, tree)
                if include.is_macro and target is None:
                    continue # a text, not a file's name
                check_include(include, target, complaints)
                if target is not None:
                    includes.append((include, target))
                    readers[target].add(path)
            check_kept(path, text, complaints)
            check_numbers(path, text, complaints)
            check_sizes(path, text, complaints)
        if path.endswith(HEADERS):
            check_guard(path, text, guards, complaints)
        if path.endswith(".c"):
            check_main(path, text, complaints)
        if path == "libcubemap/README.md":
            check_document(path, text, complaints)
        if path.endswith("meson.build"):
            check_build(path, text, complaints)
    for path, text in sorted(tree.items()):
        if path.endswith(TEXTS):
            check_text(path, text, readers[path], tree, complaints)
    check_circles(includes, complaints)
    homes = homes_of(tree)
    check_homes(tree, homes, complaints)
    check_calls(tree, homes, complaints)
    return complaints, len(includes)


# ---- the check of the check ----

def guarded(name, body):
    return f"/* x */\n#ifndef {name}\n#define {name}\n{body}\n#endif\n"


GOOD = {
    "include/cubemap/mapping.h": guarded("M", '#include <cubemap/kernel/coupled.h>'),
    "include/cubemap/kernel/coupled.h": "CM_FN\n",
    "include/cubemap/colormap.h": guarded("C", ""),
    "libcubemap/batch/batch.h": guarded("B", "#include <cubemap/mapping.h>"),
    "libcubemap/batch/set.inc": '/* Loops. Read by set_one.c, with words. */\n#include "batch.h"\n',
    "libcubemap/batch/set_one.c": '#include "set.inc"\n',
    "libcubemap/mapping/object.h": guarded("O", '#include "libcubemap/batch/batch.h"'),
    "libcubemap/mapping/object.c": '#include "object.h"\n',
    "libcubemap/earth/grid.c": '#include "libcubemap/mapping/object.h"\n',
    "libcubemap/cells/cell.c": "#include <cubemap/mapping.h>\n",
    "modules/colormap/plan.h": guarded("P", "#include <cubemap/colormap.h>"),
    "modules/scene/view.h": guarded("V", ""),
    "modules/scene/io/scene_file.h": guarded("SF", '#include "modules/scene/view.h"'),
    "modules/image/io/image_io.cpp": "#include <OpenImageIO/imageio.h>\n",
    "tools/cli/scene_reader.h": guarded("SR", '#include "modules/scene/io/scene_file.h"'),
    "truth/sphere.h": guarded("S", ""),
    "bench/harness/harness.h": guarded("H", ""),
    "bench/grids/time_grids.c": '#include "bench/harness/harness.h"\n#include "truth/sphere.h"\n'
                                "static void run(void)\n{\n}\nint main(void)\n{\n}\n",
    "tools/cli/number.h": guarded("N", ""),
    "tools/image/face.hpp": guarded("F", '#include "tools/cli/number.h"'),
    "tools/project/chain.h": guarded("CH", '#include "tools/cli/number.h"'),
    "tools/reproject/reproject.cpp": '#include "tools/image/face.hpp"\n',
    "tools/bench/bench.c": '#include "bench/harness/harness.h"\n#include "truth/sphere.h"\n',
    "tests/suite.h": guarded("SU", '#include "truth/sphere.h"'),
    "tests/cells/test_cells.c": '#include "tests/suite.h"\n#include "libcubemap/mapping/object.h"\n',
    "tests/fuzz/fuzz.h": guarded("FU", ""),
}

# what is put into the good tree, and what must be said of it
FAULTS = [
    ("libcubemap/batch/x.c", '\n#include "libcubemap/mapping/object.h"\n',
     'libcubemap/batch/x.c:2: "libcubemap/mapping/object.h": libcubemap/batch may not use libcubemap/mapping'),
    ("libcubemap/earth/x.c", '#include "libcubemap/cells/cell.h"\n', "there is no such file"),
    ("libcubemap/cells/cell.h", guarded("CE", ""), None),
    ("libcubemap/mapping/x.c", '#include "libcubemap/cells/cell.h"\n', "libcubemap/mapping may not use libcubemap/cells"),
    ("modules/colormap/x.c", '#include "libcubemap/batch/batch.h"\n', "modules/colormap may not use libcubemap/batch"),
    ("modules/colormap/x.c", '#include "modules/scene/view.h"\n', "modules/colormap may not use modules/scene"),
    ("modules/colormap/io/x.c", '#include "modules/scene/view.h"\n', "modules/colormap/io may not use modules/scene"),
    ("modules/scene/x.c", '#include "modules/scene/io/scene_file.h"\n', "modules/scene may not use modules/scene/io"),
    ("tools/cli/x.c", '#include "modules/scene/view.h"\n', "tools/cli may not use modules/scene"),
    ("tools/cli/x.cpp", "\n#include <OpenImageIO/imageio.h>\n",
     "tools/cli/x.cpp:2: OpenImageIO/imageio.h is for modules/image/io alone"),
    ("tools/cli/x.c", '#include "tools/image/face.hpp"\n', "tools/cli may not use tools/image"),
    ("tools/reproject/x.cpp", '#include "tools/project/chain.h"\n', "tools/reproject may not use tools/project"),
    ("tools/project/x.c", '#include "truth/sphere.h"\n', "tools/project may not use truth"),
    ("tools/bench/x.c", '#include "tests/suite.h"\n', "tools/bench may not use tests"),
    ("bench/grids/x.c", '#include "tests/suite.h"\n', "bench/grids may not use tests"),
    ("truth/x.h", guarded("X", '#include "libcubemap/mapping/object.h"'), "truth may not use libcubemap/mapping"),
    ("tests/cells/x.c", '#include "tests/fuzz/fuzz.h"\n', "tests/cells may not use tests/fuzz"),
    ("include/cubemap/x.h", guarded("X", '#include "libcubemap/batch/batch.h"'),
     "include/cubemap/x.h:4: \"libcubemap/batch/batch.h\": a public header includes what users do not have"),
    ("include/cubemap/kernel/x.h", "#include <cubemap/mapping.h>\n", "kernel may not use include/cubemap"),
    ("libcubemap/cells/x.c", '#include "../batch/batch.h"\n', "neither a file of the same folder nor a path"),
    ("libcubemap/cells/x.c", '#include <cubemap/nothing.h>\n', "no such public header"),
    ("libcubemap/cells/x.c", '#include "cell.c"\n', "a source is compiled, not included"),
    ("libcubemap/x.c", "#include <cubemap/mapping.h>\n", "in no room"),
    ("somewhere/x.c", "#include <cubemap/mapping.h>\n", "in no room"),
    ("libcubemap/batch/x.inc", "/* Words. */\n", "does not say at its top who includes it"),
    ("libcubemap/batch/x.inc", "/* Words. Read by set_one.c. */\n", "nobody includes it"),
    ("libcubemap/batch/x.c", '#include "set.inc"\n', "libcubemap/batch/x.c includes it, which its top does not say"),
    ("libcubemap/batch/set.inc", "/* Loops. Read by set_one.c and set_two.c. */\n", "there is no set_two.c"),
    ("libcubemap/batch/x.c", '#define CM_LANES "libcubemap/mapping/object.h"\n', "batch may not use libcubemap/mapping"),
    ("modules/colormap/plan.h", "#include <cubemap/colormap.h>\n", "modules/colormap/plan.h:1: no include guard"),
    ("modules/colormap/x.h", guarded("P", ""), "the guard P is that of modules/colormap/plan.h"),
    ("modules/colormap/plan.h", guarded("P", '#include "gamut.h"'), None),
    ("modules/colormap/gamut.h", guarded("G", ""), None),
    ("modules/colormap/gamut.c", '#include "plan.h"\n', "a circle of files"),
    ("bench/grids/x.c", "void run(void)\n{\n}\nint main(void)\n{\n}\n", "bench/grids/x.c:1: run is not static"),
    ("libcubemap/mapping/x.h", guarded("X", "void cm_cell_area(double *area);"), None),
    ("libcubemap/cells/cell.c", "void cm_cell_area(double *area)\n{\n}\n",
     "libcubemap/mapping/x.h:4: cm_cell_area is declared here, but is of libcubemap/cells"),
    ("libcubemap/cells/cell.c", "void cm_cell_area(double *area)\n{\n}\n", None),
    ("libcubemap/mapping/x.c", "/* not cm_cell_area() */\nint x = cm_cell_area(NULL);\n",
     "libcubemap/mapping/x.c:2: calls cm_cell_area of libcubemap/cells, which libcubemap/mapping may not use"),
    ("libcubemap/README.md", "| `orient/` | where | measure, earth, mapping, batch |\n| `batch/` | loops | cells |\n",
     "libcubemap/README.md:1: batch may use kernels"),
    ("bench/grids/x.c", "\ndouble x = strtod(word, NULL);\n", "bench/grids/x.c:2: strtod( reads a number"),
    ("tools/cli/x.cpp", "\n\nconst double x = std::stod(word);\n", "tools/cli/x.cpp:3: stod( reads a number"),
    ("modules/scene/io/x.c", 'sscanf(text, "%d %lf", &i, &x);\n', "modules/scene/io/x.c:1: scanf"),
    ("modules/scene/x.c", "\nlong *x = malloc(n * sizeof *x);\n", "modules/scene/x.c:2: malloc( of a product"),
    ("modules/scene/x.c", "int *x = realloc(at(1), (n + 1) * 4);\n", "modules/scene/x.c:1: realloc( of a product"),
    ("tools/meson.build", "files('a.c',\n  'b.inc')\n", "tools/meson.build:2: 'b.inc' is compiled"),
]


def self_test():
    complaints, count = check(GOOD)
    if complaints or count == 0:
        house.fail_self_test(f"the good tree is not good: {complaints}")
    kept = {}
    for path, text, expected in FAULTS:
        tree = {**GOOD, **kept, path: text}
        if expected is None: # a part of the next faults
            kept[path] = text
            continue
        complaints, _ = check(tree)
        if not any(expected in complaint for complaint in complaints):
            house.fail_self_test(f"{path} with {text!r}: not found: {expected}\n  but: {complaints}")
    print(f"self-test: {sum(fault[2] is not None for fault in FAULTS)} faults, each found")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if arguments == ["--table"]:
        for room in ROOMS:
            print(f"{room.folder:24} {', '.join(room.uses)}")
        return 0
    root = arguments[0] if arguments else "."
    tree = {path: house.read(root, path) if path.endswith(SOURCES + HEADERS + TEXTS + ("meson.build", "libcubemap/README.md")) else ""
            for path in house.paths_of(root)}
    complaints, count = check(tree)
    return house.end("rooms", complaints, f"{count} includes") if count > 100 else "no tree is here"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
