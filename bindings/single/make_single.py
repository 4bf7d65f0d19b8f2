#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the library one file: cubemap_kernels_single.h, the kernels alone, and cubemap_single.h, interface, kernels and,
where CUBEMAP_IMPLEMENTATION is defined, all of libcubemap.

Usage: make_single.py ROOT FOLDER

Each text stands in the file once. What is included from several places, with other words each time, is a numbered part:
where it was included the file includes itself, and shows that part alone. (Fewer and larger parts matter: compilers keep
a place in memory for every byte of every time.) Headers with guards stand before all that needs them.
Sources that are compiled apart in the library share one scope here: what is their own gets the
name of its source behind it, by macros around the source; which names those are is read from the preprocessed sources.
"""

import os
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"]+)"|<(cubemap/[^>]+)>)[ \t]*\n', re.M)
SYSTEM = re.compile(r"^[ \t]*#[ \t]*include[ \t]*<([^>]+)>[ \t]*\n", re.M)
BY_MACRO = re.compile(r"^[ \t]*#[ \t]*include[ \t]*([A-Z]\w*)[ \t]*\n", re.M)
NAMED_PART = re.compile(r'^([ \t]*#[ \t]*define[ \t]+\w+[ \t]+)"([^"\n]+\.inc)"', re.M)
MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)", re.M)

# The instruction sets beside plain C, the best first: how the compiler says that it may use them. One is taken, by what
# the program is compiled for: a file that holds all, by pragmas, is four times as long in the compiler's hands.
SETS = {
    "avx512": "defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)",
    "avx2": "defined(__AVX2__) && defined(__FMA__)",
    "sse2": "defined(__x86_64__) && !defined(_WIN32)",
    "neon": "defined(__aarch64__) && !defined(__ARM_BIG_ENDIAN)",
    "wasm128": "defined(__wasm_simd128__)",
}

# Those that this machine's compiler can read, with its options.
SETS_HERE = {"x86_64": {"sse2": [], "avx2": ["-mavx2", "-mfma"],
                        "avx512": ["-mavx512f", "-mavx512dq", "-mavx512bw", "-mavx512vl", "-mfma"]},
             "other": {"neon": []}}


class Tree:
    """The files of the tree, and who includes what."""

    def __init__(self, root):
        self.root = pathlib.Path(root).resolve()
        self.texts = {}

    def text(self, path):
        if path not in self.texts:
            text = (self.root / path).read_text(encoding="utf-8")
            self.texts[path] = re.sub(r"\A/\* SPDX[^\n]*\n \*\n", "/*\n", text) if text.startswith("/* SPDX") else text
        return self.texts[path]

    def is_part(self, path):
        """Is this text read several times?"""
        return path.endswith(".inc") or "/kernel/" in path

    def target(self, path, quoted, public):
        if public:
            return "include/" + public
        beside = os.path.normpath(os.path.join(os.path.dirname(path), quoted))
        return beside if (self.root / beside).is_file() else quoted

    def included(self, path):
        text = self.text(path)
        found = [self.target(path, match[1], match[2]) for match in INCLUDE.finditer(text)]
        return found + self.named_parts(path)

    def named_parts(self, path):
        """Those that a macro names, which somebody else includes."""
        return [match[2] for match in NAMED_PART.finditer(self.text(path))]

    def reached(self, path, parts_only=False, seen=None):
        """All that a file includes, itself first, in the order of need: a header comes behind what it includes."""
        seen = {} if seen is None else seen
        if path in seen:
            return seen
        seen[path] = None
        for target in self.included(path):
            if not parts_only or self.is_part(target):
                self.reached(target, parts_only, seen)
        return seen


class File:
    """One file that is made: its head, its numbered parts."""

    def __init__(self, tree, name, roots):
        self.tree = tree
        self.name = name
        self.numbers = {}
        self.sites = {}  # from how many places each text is included; what is from one place alone, stands there
        paths = {path for root in roots for path in tree.reached(root)}
        for path in paths:
            for target in tree.included(path):
                self.sites[target] = self.sites.get(target, 0) + 1
            for target in tree.named_parts(path):
                self.sites[target] = 2

    def number(self, path):
        if path not in self.numbers:
            self.numbers[path] = len(self.numbers) + 1
        return self.numbers[path]

    def reenter(self, what):
        return f"#undef CM_SINGLE_PART\n#define CM_SINGLE_PART {what}\n#include CM_SINGLE_FILE\n"

    def body(self, path):
        """A text of the tree with its includes replaced: parts by re-entering, headers by nothing."""
        def replaced(match):
            target = self.tree.target(path, match[1], match[2])
            if self.tree.is_part(target) and self.sites[target] == 1:
                return self.body(target)
            if self.tree.is_part(target):
                return f"/* {target} */\n" + self.reenter(self.number(target))
            return ""
        text = BY_MACRO.sub(lambda match: self.reenter(match[1]), self.tree.text(path))
        text = INCLUDE.sub(replaced, text)
        text = NAMED_PART.sub(lambda match: f"{match[1]}{self.number(match[2])} /* {match[2]} */", text)
        # vectors of the loops and those of single points are two scopes in the library
        text = text.replace("#define CM_NAME(name) name##_lanes_f64", "#define CM_NAME(name) CM_SINGLE_LANES(name, _f64)")
        text = text.replace("#define CM_NAME(name) name##_lanes_f32", "#define CM_NAME(name) CM_SINGLE_LANES(name, _f32)")
        return f"\n/* ==== {path} ==== */\n{text}"

    def headers(self, paths, done):
        """Headers with guards that these files need, each behind what it needs itself."""
        result = ""
        for path in paths:
            if path in done:
                continue
            done.add(path)
            result += self.headers(self.tree.included(path), done)
            if path.endswith(".h") and not self.tree.is_part(path):
                result += self.body(path)
        return result

    def parts(self):
        """All parts, those too that parts include."""
        texts, index = "", 0
        while index < len(self.numbers):
            path = list(self.numbers)[index]
            index += 1
            texts += f"#elif CM_SINGLE_PART == {index}\n{self.body(path)}"
        return texts

    def whole(self, comment, top):
        return f"""/* SPDX-License-Identifier: MIT
 *
{comment} */
#ifndef CM_SINGLE_FILE
#define CM_SINGLE_FILE "{self.name}"
#endif

#ifndef CM_SINGLE_PART
{top}
#undef CM_SINGLE_PART
#undef CM_SINGLE_FILE
{self.parts()}
#endif
"""


def names_at_top(text):
    """What the statements of a preprocessed text declare outside of all braces and only for their own source:
    {name: files}, from line markers."""
    text = re.sub(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)|__extension__|_Pragma\([^)]*\)", " ", text)
    names, file, depth, statement, body = {}, "", 0, [], []

    def close():
        words = " ".join(statement)
        found = re.findall(r"\b(?:struct|enum|union) (\w+) \{\}", words)
        if re.search(r"\benum (?:\w+ )?\{\}", words):
            found += re.findall(r", (\w+)", ", " + " ".join(body))
        head = re.sub(r"\b(?:struct|enum|union) (?:\w+ )?(?:\{\} )?", "", words)
        if words.startswith("typedef"):
            pointer = re.search(r"\( \* (\w+) \)", words)
            found += [pointer[1]] if pointer else re.findall(r"(\w+)(?: \[[^]]*\])* ?$", head)
        elif "static " in words:
            found += re.findall(r"(\w+)(?: \[[^]]*\])*$", re.split(r" [=(]", head, maxsplit=1)[0])
        for name in found:
            names.setdefault(name, set()).add(file)
        statement.clear()
        body.clear()

    for line in text.splitlines():
        marker = re.match(r'# \d+ "([^"]*)"', line)
        if marker:
            file = marker[1]
            continue
        if line.startswith("#"):
            continue
        for token in re.findall(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|\w+|[^\s\w]', line):
            if token == "{":
                depth += 1
            elif token == "}":
                depth -= 1
                if depth == 0 and statement and statement[-1] == ")":
                    close()  # a function
                elif depth == 0:
                    statement.append("{}")
            elif depth == 0 and token == ";":
                close()
            elif depth <= 1:
                (body if depth else statement).append(token)
    return names


def preprocessed(tree, source, words):
    command = [*os.environ.get("CC", "cc").split(), "-E", "-std=c11", *words, "-I", str(tree.root), "-I",
               str(tree.root / "include"), "-x", "c", "-"]
    return subprocess.run(command, input=source, text=True, check=True, cwd=tree.root, stdout=subprocess.PIPE).stdout


def own_names(tree, unit, words, shared):
    """The names that a source has for itself; those of vectors have its name in any case."""
    text = preprocessed(tree, f'#include "{unit}"\n', words)
    return {name for name, files in names_at_top(text).items()
            if name not in shared and any(str(tree.root / file).startswith(str(tree.root)) for file in files)
            and not name.endswith(("_lanes_f64", "_lanes_f32"))}


def names_to_change(tree, units, sets, flags):
    """{unit: those of its own names that another unit has too, or that a user's program may have}; of the sets, of which
    there is one, those that a source has with any that this compiler can read."""
    headers = {path for unit in [*units, *sets["sse2"]] for path in tree.reached(unit)
               if path.endswith(".h") and not tree.is_part(path)}
    shared = names_at_top(preprocessed(tree, "".join(f'#include "{path}"\n' for path in sorted(headers)), []))
    found = {unit: own_names(tree, unit, ["-DCM_HAVE_PTHREADS"], shared) for unit in units}
    for kind in range(2):
        names = set().union(*(own_names(tree, sets[name][kind], flags[name], shared) for name in flags))
        found.update({pair[kind]: names for pair in sets.values()})
    owners = {}
    for unit in [*units, *next(iter(sets.values()))]:
        for name in found[unit]:
            owners[name] = owners.get(name, 0) + 1
    # a macro would change members of headers' structs as well: what is named like one keeps its name if it can
    texts = {unit: " ".join(map(tree.text, tree.reached(unit, parts_only=True))) for unit in found}
    return {unit: sorted(name for name in names if owners[name] > 1 or not (
        name.startswith("cm_") or re.search(rf"(?:\.|->){name}\b", texts[unit]))) for unit, names in found.items()}


def sources_of(tree):
    """The sources of the core, as its meson.build lists them."""
    text = (tree.root / "libcubemap" / "meson.build").read_text(encoding="utf-8")
    # plain C is a library of its own there, for its flags
    listed = [re.search(opening + r"([^)]*)\)", text)[1]
              for opening in (r"libcubemap_sources = files\(", r"static_library\('cubemap-scalar',")]
    return ["libcubemap/" + name for name in re.findall(r"'([^']+\.c)'", "".join(listed))]


def system_headers(text):
    """The lines that include the system's, with the conditions around them."""
    lines, opened = [], []  # opened: where in lines a condition begins that is open
    for line in text.splitlines():
        word = re.match(r"[ \t]*#[ \t]*(if|elif|else|endif|include)\w*", line)
        if not word:
            continue
        if word[1] == "if":
            opened.append(len(lines))
        header = SYSTEM.match(line + "\n")
        if word[1] != "include" or header and not header[1].startswith("cubemap/"):
            lines.append(line)
        if word[1] == "endif" and not any("include" in one for one in lines[opened[-1]:]):
            del lines[opened[-1]:]
        if word[1] == "endif":
            opened.pop()
    return "".join(line + "\n" for line in lines)


def unit_of(tree, file, unit, own):
    """A source in the scope of all: its words and its names are taken back behind it."""
    stem = pathlib.PurePath(unit).stem
    macros = sorted({name for path in tree.reached(unit, parts_only=True) for name in MACRO.findall(tree.text(path))})
    lines = [f"#define {name} {name}_of_{stem}" for name in own]
    lines += [f"#define CM_SINGLE_LANES(name, bits) name##_{stem}##bits"]
    ends = [f"#undef {name}" for name in [*own, "CM_SINGLE_LANES", *macros]]
    systems = system_headers(tree.text(unit))
    body = SYSTEM.sub("", file.body(unit))
    return systems + "\n".join(lines) + "\n" + body + "\n".join(ends) + "\n"


KERNELS_COMMENT = """ * The kernels of libcubemap in one file: what <cubemap/kernels.h> has, for C11 and C++17, with nothing to link but the C
 * library's mathematics. Made by bindings/single/make_single.py. If the file gets another name, define CM_SINGLE_FILE as
 * that, in quotes, before it is included.
"""

COMMENT = """ * libcubemap in one file: the interface of <cubemap/cubemap.h> and the kernels of <cubemap/kernels.h>, for C11 and C++17.
 * In one source, of C11, define CUBEMAP_IMPLEMENTATION before it is included, ahead of all other headers: that source has
 * the library in it.
 *
 *     cc -O2 -ffp-contract=off -fno-math-errno -fno-trapping-math program.c -lm -pthread
 *
 * With these options, which the library is built with, the bits are those of the library with the same instruction set:
 * plain C ("scalar"), and the best that the compiler is told to use, by -mavx2 -mfma or -msimd128 say.
 * CUBEMAP_WITHOUT_THREADS leaves out POSIX threads, which other systems than POSIX's do in any case.
 * Made by bindings/single/make_single.py. If the file gets another name, define CM_SINGLE_FILE as that, in quotes.
"""


def kernels_single(tree):
    file = File(tree, "cubemap_kernels_single.h", ["include/cubemap/kernels.h"])
    return file.whole(KERNELS_COMMENT, file.body("include/cubemap/kernels.h"))


def cubemap_single(tree):
    units = sources_of(tree)
    sets = {name: [f"libcubemap/batch/set_{name}.c", f"libcubemap/batch/lone_{name}.c"] for name in SETS}
    file = File(tree, "cubemap_single.h", ["include/cubemap/cubemap.h", "include/cubemap/kernels.h", *units,
                                           *(unit for pair in sets.values() for unit in pair)])
    done = set()
    interface = file.headers(["include/cubemap/cubemap.h", "include/cubemap/kernels.h"], done)
    machine = subprocess.run([*os.environ.get("CC", "cc").split(), "-dumpmachine"], text=True, check=True,
                             stdout=subprocess.PIPE).stdout
    own = names_to_change(tree, units, sets, SETS_HERE["x86_64" if machine.startswith("x86_64") else "other"])
    headers = file.headers([path for unit in own for path in tree.reached(unit)], done)
    chosen, first = "", True
    for name, condition in SETS.items():
        chosen += f"#{'if' if first else 'elif'} {condition}\n#define CM_HAVE_{name.upper()}\n"
        first = False
    bodies = "".join(unit_of(tree, file, unit, own[unit]) for unit in units)
    for name, pair in sets.items():
        inner = "".join(unit_of(tree, file, unit, own[unit]) for unit in pair)
        bodies += f"#ifdef CM_HAVE_{name.upper()}\n{inner}#endif\n"
    top = f"""#if defined(CUBEMAP_IMPLEMENTATION) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE
#endif
#ifndef CM_STATIC
#define CM_STATIC
#endif
{interface}
#if defined(CUBEMAP_IMPLEMENTATION) && !defined(CUBEMAP_IMPLEMENTED)
#define CUBEMAP_IMPLEMENTED
#ifdef __cplusplus
#error "the implementation of libcubemap is C11: define CUBEMAP_IMPLEMENTATION in a source of C"
#endif
#if defined(__GLIBC__) && !defined(__USE_XOPEN2K8) && !defined(CUBEMAP_WITHOUT_THREADS)
#error "define CUBEMAP_IMPLEMENTATION and include this file ahead of all other headers, or compile as GNU C"
#endif
#if defined(__GNUC__)
{chosen}#endif
#endif
#if !defined(CUBEMAP_WITHOUT_THREADS) && !defined(__wasm__) && (defined(__unix__) || defined(__APPLE__))
#define CM_HAVE_PTHREADS
#endif
{headers}
{bodies}
#endif
"""
    return file.whole(COMMENT, top)


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__.strip())
    tree, folder = Tree(arguments[0]), pathlib.Path(arguments[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in [("cubemap_kernels_single.h", kernels_single(tree)), ("cubemap_single.h", cubemap_single(tree))]:
        (folder / name).write_text(text, encoding="utf-8")
        print(f"{folder / name}: {text.count(chr(10))} lines")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
