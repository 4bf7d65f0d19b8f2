#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Links of documents, and the paths that documents, scripts and comments name.

check_links.py [ROOT]        check the tree; names file and line of what is not there
check_links.py --self-test   check that every kind of fault is found
"""

import fnmatch
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import house

# What a path begins with, if it is one of this tree; build/ is what meson makes.
TOPS = ["include", "libcubemap", "modules", "tools", "truth", "tests", "bench", "research", "docs", "scripts", "data",
        "bindings", "web", r"\.ci", "build"]
PATH = re.compile(r"(?<![\w/.$*-])((?:%s)/[\w.*{},/<>+-]*[\w*}>])(?![\w]|[-_.]*[$%%])" %
                  "|".join(TOPS))

# Files that are named by name alone, in comments and documents.
BARE = re.compile(r"(?<![\w/.<*{}\"'-])([a-z]\w*\.(?:c|h|hpp|cpp|inc|py|sh))\b(?![\w(/>.-])")

READ = (".md", ".c", ".h", ".cpp", ".hpp", ".inc", ".py", ".sh", ".build", ".1", ".sollya", "")
NOT_READ = ["LICENSE", "tests/vectors/*.txt", "tests/fuzz/corpus/*", "data/*.txt", "tests/house/*.py", ".clang-format",
            ".gitignore", ".editorconfig"]

# Paths that are no files here: what the list of changes says of the past, what others have, and what comes later.
ELSEWHERE = {
    "CHANGELOG.md": ["scripts/bench", "scripts/certificate", "scripts/pictures", "scripts/projection-pictures",
                     "scripts/colormap-pictures", "scripts/catalogue-table", "scripts/vectors", "scripts/fit-mapping",
                     "scripts/latitude-series"],
}


def slug(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip().lower())
    return re.sub(r"[^\w\- ]", "", text.replace("`", "")).replace(" ", "-")


def anchors(text):
    found = set()
    for heading in re.findall(r"^#+ +(.+?)\s*#*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        anchor, count = slug(heading), 0
        while anchor + (f"-{count}" if count else "") in found:
            count += 1
        found.add(anchor + (f"-{count}" if count else ""))
    return found | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def is_there(path, tree, folders):
    return path in tree or path.rstrip("/") in folders


def blank(match):
    return re.sub(r"[^\n]", " ", match[0])


def lines_of(text):
    """Line by line, without addresses of the web and what is said of a variable's folder."""
    text = re.sub(r"https?://[^\s)>\"]+", blank, text)
    text = re.sub(r"\$\{?root\}?/", "", text).replace("\\-", "-")
    return enumerate(text.split("\n"), 1)


def check_links(path, text, tree, folders, complaints):
    count = 0
    without_code = re.sub(r"^```.*?^```", blank, text, flags=re.M | re.S)
    without_code = re.sub(r"`[^`\n]*`(?!\])", blank, without_code)
    for number, line in enumerate(without_code.split("\n"), 1):
        for target in re.findall(r"\]\(([^)\s]+)\)|<(?:img|a)[^>]* (?:src|href)=\"([^\"]+)\"", line):
            target = target[0] or target[1]
            if re.match(r"[a-z]+:", target):
                continue
            count += 1
            file, _, anchor = target.partition("#")
            goal = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            if not is_there(goal, tree, folders):
                complaints.append(f"{path}:{number}: the link to {target} goes nowhere")
            elif anchor and goal.endswith(".md") and anchor not in anchors(tree[goal]):
                complaints.append(f"{path}:{number}: {goal} has no heading #{anchor}")
    return count


# ---- paths ----

def expand(text):
    """{a,b}, and {name} of a script, which stands for any."""
    braces = re.search(r"\{([^{}]*)\}", text)
    if braces:
        return [each for word in (braces[1].split(",") if "," in braces[1] else "*")
                for each in expand(text[:braces.start()] + word + text[braces.end():])]
    return [text]


def pattern_of(text):
    return re.sub(r"<[^>]*>|(?<![A-Za-z])[A-Z][A-Z_]+(?![a-z])|(?<![A-Za-z])X(?![A-Za-z])", "*", text)


def is_path(text, tree, folders):
    if is_there(text, tree, folders):
        return True
    pattern = pattern_of(text).rstrip("/")
    return "*" in pattern and any(fnmatch.fnmatchcase(each, pattern) for group in (tree, folders) for each in group)


def is_built(text, tree):
    """Does meson make build/FOLDER/NAME? The name stands in the folder's meson.build, or is put together there."""
    folder, name = os.path.split(text)
    build = tree.get(os.path.join(folder, "meson.build"))
    if folder == "" or name.startswith("meson-") or folder.startswith("meson-"):
        return folder != "" or "." in name or name in ("", "meson-logs") or os.path.join(name, "meson.build") in tree
    if build is None:
        return False
    if os.path.join(text, "meson.build") in tree or re.search(f"'{re.escape(name)}'", build):
        return True
    if re.fullmatch(r"lib[\w-]+\.(so|a)[\w.]*", name):
        return f"library('{name[3:].split('.')[0]}'" in build
    for before, after in re.findall(r"'([\w-]+-)' \+ name(?: \+ '(-\w+)')?", build):
        middle = name[len(before):len(name) - len(after)]
        if name.startswith(before) and name.endswith(after):
            words = re.findall(r"'([\w-]+)'", build + tree.get("truth/meson.build", ""))
            if middle in words or "*" in pattern_of(middle):
                return True
    return "*" in pattern_of(name) and re.search("'" + re.escape(pattern_of(name)).replace(r"\*", r"[\w-]*"), build)


def check_paths(path, text, tree, folders, complaints):
    count = 0
    for number, line in lines_of(text):
        for word in PATH.findall(line):
            for each in expand(word):
                count += 1
                each = each.rstrip(".,")
                if each in ELSEWHERE.get(path, []):
                    continue
                good = is_built(each[len("build/"):], tree) if each.startswith("build/") else is_path(each, tree, folders)
                if not good:
                    complaints.append(f"{path}:{number}: there is no {each}")
    return count


def comments_of(path, text):
    """Only the comments, with the lines where they are; all of a document."""
    if path.endswith(".md"):
        return text
    kept, end = [], 0
    marks = r"/\*.*?\*/|//[^\n]*" if path.endswith((".c", ".h", ".cpp", ".hpp", ".inc")) else r"(?m:^\s*#[^\n]*)"
    for match in re.finditer(marks, text, re.S):
        kept += ["\n" * text.count("\n", end, match.start()), match[0]]
        end = match.end()
    return " ".join(kept)


def is_named(name, names):
    pattern = pattern_of(name)
    return name in names or name in FOREIGN or ("*" in pattern and any(fnmatch.fnmatchcase(each, pattern) for each in names))


def check_names(path, text, names, complaints):
    """A file that is named without its folder is somewhere."""
    for number, line in lines_of(comments_of(path, text)):
        if "<" in line and path.endswith(".md"):
            line = re.sub(r"<[^>]*>", "", line)
        for name in BARE.findall(line):
            if not is_named(name, names):
                complaints.append(f"{path}:{number}: there is no file {name}")


# Files of others.
FOREIGN = ["example.c", "example.cpp", "program.c", "cubemap_single.h", "cubemap_kernels_single.h", "rainbow.py", "math.h", "pthread.h", "s2coords.h", "s2cell_id.h"]


def check(tree):
    complaints = []
    folders = set()
    for path in tree:
        while os.path.dirname(path):
            path = os.path.dirname(path)
            folders.add(path)
    names = {os.path.basename(path) for path in tree}
    count = 0
    for path, text in sorted(tree.items()):
        if text is None:
            continue
        if path.endswith(".md"):
            count += check_links(path, text, tree, folders, complaints)
        text = comments_of(path, text) if path.endswith("meson.build") else text
        count += check_paths(path, text, tree, folders, complaints)
        check_names(path, text, names, complaints)
    return complaints, count


GOOD = {
    "README.md": "# A house\n## Rooms & doors\n[here](docs/a.md#two-words) ![p](docs/p.png) [up](#rooms--doors)\n"
                 "`build/tests/earth/test-grid`, build/tools/cubemap-project, scripts/test, `tests/vectors/*.txt`,\n"
                 "https://example.org/tests/nothing and `include/cubemap/kernel/NAME.h`; build/tests/earth/test-grid-accuracy.\n",
    "docs/a.md": "# Two words\n[back](../README.md)\n",
    "docs/p.png": None,
    "scripts/test": "#!/bin/sh\n# see \"$root/scripts/test\"\n",
    "tests/vectors/one.txt": None,
    "include/cubemap/kernel/one.h": "/* as one.h says */\n",
    "tests/earth/meson.build": "foreach name : ['grid']\n executable('test-' + name, x)\n"
                               " executable('test-' + name + '-accuracy', x)\n",
    "tools/meson.build": "executable('cubemap-project')\n",
}
FAULTS = [
    ("docs/b.md", "\n[x](nothing.md)\n", "docs/b.md:2: the link to nothing.md goes nowhere"),
    ("docs/b.md", "![x](q.png)\n", "docs/b.md:1: the link to q.png goes nowhere"),
    ("docs/b.md", "[x](a.md#three)\n", "docs/a.md has no heading #three"),
    ("docs/b.md", "`scripts/bench` and\n", "docs/b.md:1: there is no scripts/bench"),
    ("docs/b.md", "see tests/none.txt.\n", "there is no tests/none.txt"),
    ("docs/b.md", "`build/tests/test-grid`\n", "there is no build/tests/test-grid"),
    ("docs/b.md", "`build/tests/earth/test-square`\n", "there is no build/tests/earth/test-square"),
    ("docs/b.md", "`build/tools/cubemap-none`\n", "there is no build/tools/cubemap-none"),
    ("scripts/b", "#!/bin/sh\n\"$root/research/none\"\n", "scripts/b:2: there is no research/none"),
    ("tests/b.c", "/* (tests/earth/none.c) */\n", "there is no tests/earth/none.c"),
    ("tests/b.c", "int x; /* as no_such.c has it */\n", "tests/b.c:1: there is no file no_such.c"),
]


def self_test():
    complaints, count = check(GOOD)
    if complaints or count < 8:
        house.fail_self_test(f"good texts are not good ({count} paths): {complaints}")
    for path, text, expected in FAULTS:
        complaints, _ = check({**GOOD, path: text})
        if not any(expected in complaint for complaint in complaints):
            house.fail_self_test(f"{text!r}: not found: {expected}, but {complaints}")
    print(f"self-test: {len(FAULTS)} faults, each found")
    return 0


def is_read(path):
    return path == "tests/uncovered.txt" or os.path.splitext(path)[1] in READ and not any(fnmatch.fnmatchcase(path, each) for each in NOT_READ)


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    root = arguments[0] if arguments else "."
    tree = {path: house.read(root, path) if is_read(path) else None for path in house.paths_of(root)}
    complaints, count = check(tree)
    return house.end("links", complaints, f"{count} links and paths") if count > 100 else "no tree is here"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
