#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The commands of README, of the guides and of --help run as they are printed, on small files of the names that they have.

    guide_commands.py REPOSITORY BUILD_FOLDER [FEATURE]...     features that were built: sim, gdal, jansson

A command stands in a block of the language sh, on indented lines, between backquotes, or behind "Example:" of --help. What the
programs of the build and a shell can do is run, page by page, each in a folder of its own: CHANGED says which for a shorter
time or as a whole command, NEEDS what is left out where something is not there, ELSEWHERE what is not run here. Of scripts and
of programs that measure it is asked that they are there. An output that a page shows behind commands is compared. An entry of
these tables that no command has fails.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

FEW = " --points 64 --repetitions 8 --random 100 --hard 100 --largest 0 --map 0 --tolerance 0.01"
# what is changed in a command
CHANGED = [
    # less of the same
    (r"^cubemap-bench (--quick|--json).*", rf"\g<0>{FEW}"),
    (r"^(cubemap-bench (?:--quick|--json \w+\.json)) --points", r"\1 gnomonic --points"),
    (r"'co\*' qsc", "'gnom*' tangent"),
    (r"^cubemap-bench advise --.*", r"\g<0> coupled qsc"),
    (r"^cubemap-orient (?!.*--evaluate).*", r"\g<0> --boxes 100 --resolution 10"),
    (r"^cubemap-octree integrate room -o room.map --edge 0.01 ", "cubemap-octree integrate seen -o room.map --edge 0.1 "),
    (r"^cubemap-tof reproduce -o made$", "cubemap-tof reproduce exact -o made"),
    # two runs on a busy machine differ
    (r"^(cubemap-bench compare .*) \S+\.json$", r"\1 old.json"),
    (r"^(cubemap-bench compare .*--gate .*) \S+\.json (\S+\.json)$", r"\1 \2 \2"),
    # pictures of other files than those before
    (r"^(cubemap-tof evaluate) made/distance_0000.exr made/", r"\1 taken/distance_0000.exr taken/"),
    (r"^cubemap-compare --max-rmse 2.5 ", "cubemap-compare --max-rmse 25 "),
    (r" out\.mp4$", " -y out.mp4"),
    # words of a command
    (r"^cubemap-project -m s2 --frame s2 --cell 30:s2$", r"echo 13.4 52.5 | \g<0>"),
    (r"^cubemap-colormap MODEL ", "cubemap-colormap uniform-blue "),
    (r"^cubemap-reproject --(mapping auto|mips|memory 2G)$", r"\g<0> earth.jpg face_%f.png"),
    (r"^cubemap-octree hull$", "cubemap-octree hull --help"),
    (r"^cubemap-compare --measure$", "cubemap-compare --measure psnr a.png b.png"),
    (r"^cubemap-bench (compare|advise)$", r"\g<0> --help"),
    (r"^cubemap-tof simulate --environment sky.exr$", r"\g<0> room sensor.json path.txt -o made"),
    (r"^cubemap-tof reproduce exact$", r"\g<0> -o made"),
    # of the repository
    (r"(^|[ |;{] ?)(bindings/shaders/generate|docs/renew/catalogue-table)\b", r'\1"$ROOT"/\2'),
]
# what a command needs, and what has it: a program of the PATH, or a feature
NEEDS = {
    r"\bffmpeg\b": "ffmpeg",
    r"\bgdal_translate\b|part\.tif\b": "gdal_translate",
    r"\butm33\.tif\b|earth\.tif\b|part\.tif\b": "gdal",
    r"^cubemap-tof |\"cubemap-tof\"": "sim",
    r"^cubemap-bench compare\b": "jansson",
    r'^"\$PYTHON" - ': "numpy",
}
FEATURES = ("sim", "gdal", "jansson")
# what is not run here, and who does it, or why nobody can
ELSEWHERE = {
    r"^scripts/(demo|test)\b": "a fresh machine",
    r"^(python3 -m venv|environment/bin/|sudo apt-get|bindings/js/make_package|npm |node examples/)":
        "bindings/python/test, bindings/js/test",
    r"^(sudo )?meson (setup|install|compile)\b": "cmake.sh, readme.sh, dll.sh",
    r"^(cc|find_package|target_link_libraries)\b": "readme.sh, cmake.sh",
    r"^python3 bindings/(single/make_single|cpp/tests/test_cost).py": "bindings/single/test; the tests of C++",
    r"^(glslangValidator|node bindings/shaders/wgsl.mjs)": "bindings/shaders/test",
    r"^cubemap-tof reproduce (lens|motion)\b": "minutes; tof cases run parts of it",
    r"bench/charts/bench-table|^cubemap-bench papers\b": "check_pictures.py, check_bench.py",
}
# what a printed command must not have, and why
NEVER = {"--max-ns ": "finds no mapping where the machine is slow"}
# what must be there, and takes minutes: scripts, programs that measure
THERE = re.compile(r"^((scripts|build|research|docs/renew)/|meson test )")
COMMAND = re.compile(r"^(\{ )?(cubemap-\w+|echo|printf|cat|head|cc|sudo|python3|npm|node|meson|find_package|\w+_libraries|ffmpeg"
                     r"|gdal_translate|glslangValidator|environment/bin/\w+|(scripts|build|bindings|docs|research)/[-\w/]+)(\.\w+)?( |$|\()")
NUMBERED = ["places", "points", "stars", "squares", "latitudes"]
CAMERA = {"width": 32, "height": 24, "fx": 16, "fy": 16, "cx": 15.5, "cy": 11.5}
PICTURES = """cubemap-reproject --to equirect "$GOLDEN" earth.jpg
cubemap-reproject --to azimuthal:equidistant:fov=185,lat=0 "$GOLDEN" fisheye.jpg
cubemap-reproject --to fisheye:fov=190 "$GOLDEN" lens.jpg
cubemap-reproject --to equirect "$GOLDEN" sky.exr
cubemap-reproject --to equirect "$GOLDEN" sky.hdr
cubemap-reproject --to cube --layout cross "$GOLDEN" cross.png
cubemap-reproject "$GOLDEN" face_%f.png
for name in sky land a b earth earth-again frame_0001 frame_0002; do cp "$GOLDEN" $name.png; done
mkdir data
cp earth.jpg data/earth-2048.jpg
cp earth.jpg in.jpg
cp "$GOLDEN" data/land-1440.png
cubemap-bench --json old.json gnomonic $FEW
cp old.json new.json
cp old.json results.json
cubemap-scene render room camera.json path.txt -o seen --quiet
cubemap-octree integrate seen -o room.map --edge 0.1 --quiet
cp room.map a.map
cp room.map b.map"""
# what is asked of the files at the end of a page
FILES = {"docs/guide/octree.md": """test -s view.png -a -s depth.exr -a -s probe_0.exr -a -s probe_5.exr -a -s room.ply
cubemap-octree info room.map --json | grep -q '"edge": 0.02, "levels": 16, .*"views": 4, "complete": true'
"""}
# what an example of Python that starts a program takes for granted
PYTHON = "\"$PYTHON\" - <<'END'\nimport subprocess, types\nimport numpy"
FILM = "ffmpeg -nostdin -v error -f lavfi -i testsrc2=size=1920x960:rate=5:duration=0.4 -c:v mpeg4 in.mp4"
RASTER = "gdal_translate -q -a_srs EPSG:32633 -a_ullr 300000 6000000 700000 5600000 \"$GOLDEN\" utm33.tif"


class Unit:
    """Commands that stand together, and what is shown of their output."""

    def __init__(self, place, commands, output=None):
        self.place, self.commands, self.output = place, commands, output


def commands_of(lines):
    """Joins what goes on in the next line, and what is read up to a word; without remarks."""
    commands, until = [], None
    for line in lines:
        if commands and (until or re.search(r"(\||\\)$", commands[-1])):
            joined = commands[-1].removesuffix("\\").rstrip() + " " + line.strip()
            commands[-1] = joined if commands[-1].endswith("\\") else commands[-1] + "\n" + line
            until = None if line == until else until
            continue
        line = re.sub(r"\s+# .*$", "", line)
        if line.strip():
            commands.append(line.strip())
            heredoc = re.search(r"<<(\w+)", line)
            until = heredoc[1] if heredoc else None
    return commands


def indented(lines, at):
    """The indented lines from there, and the number behind them."""
    end = at
    while end < len(lines) and lines[end].startswith("    "):
        end += 1
    return [line[4:] for line in lines[at:end]], end


def units_of_indented(place, block):
    """Of "$ " a command and what it prints, else commands."""
    if block[0].startswith("$ "):
        return [Unit(place, [block[0][2:]], "\n".join(block[1:]) + "\n")]
    return [Unit(place, commands_of(block))] if COMMAND.match(block[0].strip()) else []


def units_of_page(name, text):
    """In the order of the page."""
    units, lines, at, before = [], text.split("\n"), 0, None
    while at < len(lines):
        line, place = lines[at], f"{name}:{at + 1}"
        at += 1
        if line.startswith("```"):
            end = lines.index("```", at)
            fence, block = line[3:], lines[at:end]
            at = end + 1
            if fence == "sh":
                units.append(Unit(place, commands_of(block)))
            elif fence == "python" and "cubemap-" in block[0]:
                units.append(Unit(place, ["\n".join([PYTHON, *block, "END"])]))
            elif fence == "output" and before == "sh":
                units[-1].output = "\n".join(block) + "\n"
            before = fence
        elif line.startswith("    ") and (at < 2 or not lines[at - 2].strip()):
            block, at = indented(lines, at - 1)
            units += units_of_indented(place, block)
        else:
            units += [Unit(place, [code]) for code in re.findall(r"(?<!`)`([^`]+)`(?!`)", line)
                      if COMMAND.match(code) and (" " in code or THERE.match(code))]
    return units


def units_of_help(text):
    """Behind "Example:" of what a program prints."""
    for part in re.split(r"^## ", text, flags=re.M)[1:]:
        name = part.split("\n", 1)[0]
        for block in re.findall(r"^Examples?:\n((?:  .*\n)+)", part, re.M):
            yield Unit(f"{name} --help", commands_of([line[2:] for line in block.split("\n")]))


class Runner:
    """Runs what can be run, and counts."""

    def __init__(self, root, build, features, work):
        self.root, self.build, self.features, self.work = root, build, features, work
        self.used, self.run, self.left, self.complaints, self.done = set(), 0, set(), [], set()
        self.environment = {**os.environ, "PATH": f"{build / 'tools'}:{os.environ['PATH']}", "ROOT": str(root),
                            # the one that Debian has packages for
                            "PYTHON": shutil.which("/usr/bin/python3") or sys.executable, "FEW": FEW, "GOLDEN": str(root / "tests/programs/golden/earth-64.png"), "TMPDIR": str(work)}
        for name in ("CUBEMAP_IMAGE_GDAL", "CUBEMAP_INSTRUCTIONS"):
            self.environment.pop(name, None)
        targets, tests = (json.loads((build / f"meson-info/intro-{one}.json").read_text(encoding="utf-8"))
                          for one in ("targets", "tests"))
        self.tests = {word for test in tests for word in (test["name"], *(suite.split(":")[-1] for suite in test["suite"]))}
        self.targets = {os.path.relpath(one, build) for target in targets for one in target["filename"]}

    def matches(self, patterns, command):
        found = [pattern for pattern in patterns if re.search(pattern, command)]
        self.used.update(found)
        return found

    def has(self, need):
        if need == "numpy":
            return subprocess.run([self.environment["PYTHON"], "-c", "import numpy"], capture_output=True, check=False).returncode == 0
        return need in self.features if need in FEATURES else shutil.which(need) is not None

    def is_there(self, command):
        """What of a script, a test or a program that measures is not as the command says."""
        path, *arguments = shlex.split(command)
        if path == "meson":
            names = shlex.split(re.sub(r"(^| )(meson test|-C \S+|--setup \S+|--suite|-v)(?= |$)", " ", command))
            wrong = [name for name in names if name not in self.tests and "peers" not in name]
            return f"no test is called {', '.join(wrong)}" if wrong else None
        if path.startswith("build/tools") or "NAME" in path:
            return None
        if path.startswith("build/"):
            folder, _, name = path.removeprefix("build/").rpartition("/")
            rules = self.root / folder / "meson.build"
            named = rules.exists() and re.search(rf"'{re.escape(name)}'", rules.read_text(encoding="utf-8"))
            return None if path.removeprefix("build/") in self.targets or named else "no meson.build makes it"
        if not os.access(self.root / path, os.X_OK):
            return "is no program"
        if path == "scripts/renew" and arguments:
            usage = subprocess.run([self.root / path], capture_output=True, text=True, check=False)
            if not re.search(rf"^    {re.escape(arguments[0])} ", usage.stdout + usage.stderr, re.M):
                return "scripts/renew does not know that"
        return None

    def script_of(self, unit):
        """What is run of a unit: nothing of it where a part is not there."""
        script = []
        for command in unit.commands:
            self.complaints += [f"{unit.place}: '{command}': {NEVER[word]}" for word in NEVER if word in command]
            if self.matches(ELSEWHERE, command):
                continue
            if THERE.match(command):
                wrong = self.is_there(command)
                self.complaints += [f"{unit.place}: '{command}': {wrong}"] if wrong else []
                continue
            for pattern, instead in CHANGED:
                if self.matches([pattern], command):
                    command = re.sub(pattern, instead, command)
            missing = [NEEDS[pattern] for pattern in self.matches(NEEDS, command) if not self.has(NEEDS[pattern])]
            self.left.update(missing)
            if not missing:
                script.append(command)
        return script

    def shell(self, folder, script):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=self.environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, timeout=240, check=False)

    def run_unit(self, unit, folder):
        script = self.script_of(unit)
        if not script:
            return
        for text in ["\n".join(script)] if unit.output is not None else script:
            if text in self.done:
                continue
            self.done.update([text] if ">" not in text else [])
            begun = time.monotonic()
            ended = self.shell(folder, text)
            print(f"{time.monotonic() - begun:6.2f} s  {text}", flush=True)
            self.run += 1
            if ended.returncode != 0:
                self.complaints.append(f"{unit.place}: status {ended.returncode}\n{text}\n{ended.stderr[-1500:]}")
            elif unit.output is not None and len(script) == len(unit.commands) and ended.stdout != unit.output:
                self.complaints.append(f"{unit.place}: prints\n{ended.stdout}instead of\n{unit.output}")

    def make_stock(self):
        stock = self.work / "stock"
        stock.mkdir()
        for name in NUMBERED:
            (stock / f"{name}.txt").write_text("0.25 0.5 A\n-0.5 0.25 B\n", encoding="utf-8")
        (stock / "path.txt").write_text("0 -2 0.3 1.4 0.5 -0.5 0.5 -0.5\n1 -1.9 0.3 1.4 0.5 -0.5 0.5 -0.5\n"
                                        "2.1 -1.8 0.2 1.4 0.5 -0.5 0.5 -0.5\n", encoding="utf-8")
        (stock / "camera.json").write_text(json.dumps(CAMERA), encoding="utf-8")
        page = (self.root / "docs/guide/sim.md").read_text(encoding="utf-8")
        sensor = json.loads(re.search(r"^```json\n(.*?)^```$", page, re.S | re.M)[1])
        (stock / "sensor.json").write_text(json.dumps({**sensor, "camera": CAMERA}), encoding="utf-8")
        (stock / "my-main.glsl").write_text("layout(local_size_x = 1) in;\nvoid main() {}\n", encoding="utf-8")
        script = PICTURES
        script += f"\n{FILM}" if self.has("ffmpeg") else ""
        script += f"\n{RASTER}" if self.has("gdal_translate") else ""
        if self.has("sim"):
            script += "\ncubemap-tof simulate --truth room sensor.json path.txt -o taken --quiet"
        ended = self.shell(stock, script)
        if ended.returncode != 0:
            sys.exit(f"the files that commands need are not made:\n{ended.stderr}")
        return stock


def pages_of(root):
    """Name and units of each page."""
    paths = [root / "README.md", root / "docs/README.md", *sorted((root / "docs/guide").glob("*.md")),
             *sorted((root / "docs/measured").glob("*.md"))]
    for path in paths:
        name = str(path.relative_to(root))
        yield name, units_of_page(name, path.read_text(encoding="utf-8"))
    yield "--help", list(units_of_help((root / "docs/reference/programs.md").read_text(encoding="utf-8")))


def main(root, build, *features):
    with tempfile.TemporaryDirectory() as work:
        runner = Runner(pathlib.Path(root), pathlib.Path(build), features, pathlib.Path(work))
        stock = runner.make_stock()
        for name, units in pages_of(runner.root):
            folder = pathlib.Path(work) / name.replace("/", "-")
            shutil.copytree(stock, folder)
            for unit in units:
                runner.run_unit(unit, folder)
            if name in FILES:
                runner.run_unit(Unit(f"{name}: files", [FILES[name]]), folder)
            shutil.rmtree(folder)
    unused = {*NEEDS, *ELSEWHERE, *(one for one, _ in CHANGED)} - runner.used
    runner.complaints += [f"no command is as the table's {pattern}" for pattern in sorted(unused)]
    print("\n".join(runner.complaints))
    print(f"{runner.run} commands run, {len(runner.complaints)} complaints" +
          (f"; not here: {', '.join(sorted(runner.left))}" if runner.left else ""))
    return len(runner.complaints) > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
