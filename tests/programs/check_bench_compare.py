#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks cubemap-bench compare: the figures of its table against the same computed here, its gate, and what it says to
files that are no results of cubemap-bench.

Usage: check_bench_compare.py CUBEMAP-BENCH
"""

import copy
import itertools
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROW = re.compile(r"(\S+) +(double|float|fast) +(array|single) +(forward|inverse)"
                 r" +(\S+) +(inf|\d+%) +(\S+) +(inf|\d+%) +(~|[-+][\d.]+%) +p=(\d\.\d{3}) n=(\d+)(?:\+(\d+))?")


def check(condition, *what):
    if not condition:
        sys.exit("not so: " + " ".join(str(each) for each in what))


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def call(self, *words, **more):
        return subprocess.run([self.program, *map(str, words)], text=True, errors="replace", stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False, **more)

    def file(self, name, results):
        path = self.folder / name
        path.write_text(json.dumps(results), encoding="utf-8")
        return path

    def compare(self, old, new, *words):
        return self.call("compare", *words, self.file("old.json", old), self.file("new.json", new))

    def refuses(self, content, *wanted):
        """One line that names the file and says what is wrong, whichever of the two it is."""
        bad = self.folder / "bad.json"
        if isinstance(content, bytes):
            bad.write_bytes(content)
        else:
            self.file("bad.json", content)
        good = self.folder / "good.json"
        for files in ([bad, good], [good, bad]):
            done = self.call("compare", *files)
            check(done.returncode == 1 and done.stdout == "", wanted, done)
            line = done.stderr
            check(line.startswith("cubemap-bench: ") and line.count("\n") == 1 and line.endswith("\n"), done)
            check(all(ord(c) >= 32 for c in line[:-1]) and "bad.json" in line, done)
            check(all(word in line for word in wanted), wanted, done)


def counted(one, other):
    """The two-sided probability of the U test, by going through every choice."""
    pool = one + other

    def won(chosen):
        rest = [i for i in range(len(pool)) if i not in chosen]
        return sum((pool[i] > pool[j]) + (pool[i] >= pool[j]) for i in chosen for j in rest)
    here = won(range(len(one)))
    all_of_them = [won(chosen) for chosen in itertools.combinations(range(len(pool)), len(one))]
    least = min(sum(w <= here for w in all_of_them), sum(w >= here for w in all_of_them))
    return min(1.0, 2.0 * least / len(all_of_them))


def rows_of(text):
    return {found[1] + " " + " ".join(found.group(2, 3, 4)): found for found in map(ROW.match, text.splitlines()) if found}


def with_samples(results, *lists):
    """The same with other samples: one list a way, the last for all others."""
    made = copy.deepcopy(results)
    ways = [row for mapping in made["mappings"] for row in mapping["speed"]]
    for i, row in enumerate(ways):
        row["ns_samples"] = lists[min(i, len(lists) - 1)]
    return made


def check_figures(bench, results):
    old = [[5.0, 4.0, 6.0, 4.5, 5.5, 5.25], [1.0, 1.0, 2.0, 2.0], [100.0], [3.0, 3.125, 3.25, 3.5, 3.0625, 3.375, 3.4375]]
    new = [[6.5, 7.0, 7.5, 6.25, 5.75], [1.0, 2.0, 2.0, 3.0, 3.0], [90.0], [2.0, 2.5, 2.25, 2.125, 2.0625, 2.03125, 2.25]]
    done = bench.compare(with_samples(results, *old), with_samples(results, *new))
    check(done.returncode == 0 and done.stderr == "", done)
    rows = list(rows_of(done.stdout).values())
    check(len(rows) == sum(len(m["speed"]) for m in results["mappings"]), done.stdout)
    for i, row in enumerate(rows):
        one, other = old[min(i, 3)], new[min(i, 3)]
        medians = [statistics.median(one), statistics.median(other)]
        probability = counted(one, other)
        for column, median in ((5, medians[0]), (7, medians[1])):
            check(math.isclose(float(row[column]), median, rel_tol=6e-4), row[0], median)
        check(abs(float(row[10]) - probability) <= 0.000501, row[0], probability)
        check([int(row[11]), int(row[12] or row[11])] == [len(one), len(other)], row[0])
        check((row[9] == "~") == (probability > 0.05), row[0], probability)
        if row[9] != "~":
            check(abs(float(row[9][:-1]) - 100.0 * (medians[1] / medians[0] - 1.0)) <= 0.00501, row[0], medians)
    # six samples: their ends; fewer: no interval
    check([rows[0][6], rows[0][8], rows[1][6], rows[2][6]] == [f"{100 * 1.125 / 5.125:.0f}%", "inf", "inf", "inf"], rows[0][0])
    check("3 with too few samples for an interval" in done.stdout, done.stdout)
    check("1 with too few samples for any difference" in done.stdout, done.stdout)
    mean = re.search(r"^geometric mean +(\S+) +(\S+) +(\S+)%$", done.stdout, re.M)
    count = len(rows)
    for column, lists in ((1, old), (2, new)):
        logs = sum(math.log(statistics.median(lists[min(i, 3)])) for i in range(count))
        check(math.isclose(float(mean[column]), math.exp(logs / count), rel_tol=6e-4), mean[0])


def check_gate(bench, results):
    level, slower = [10.0, 10.1, 10.2, 10.3, 10.4, 10.5], [11.0, 11.1, 11.2, 11.3, 11.4, 11.5] # by 9.76 %
    old, new = with_samples(results, level), with_samples(results, level, slower, level)
    for words, status in (([], 0), (["--gate", "9.7"], 1), (["--gate", "9.8"], 0), (["--gate", "0"], 1),
                          (["--gate", "5", "--alpha", "0.003"], 1)):
        done = bench.compare(old, new, *words)
        check(done.returncode == status and done.stderr.count("\n") == status, words, done)
        check(status == 0 or "by 9.76 %" in done.stderr and "1 of" in done.stderr, done)
        check(len(rows_of(done.stdout)) > 3, done)
    # faster is not past the gate, nor is what differs by chance
    check(bench.compare(new, old, "--gate", "0").returncode == 0, "faster")
    check(bench.compare(with_samples(results, [10.0, 12.0, 14.0, 16.0]), with_samples(results, [11.0, 13.0, 15.0, 17.0]),
                        "--gate", "0").returncode == 0, "by chance")
    # a gate that nothing could be past is no gate; without one there is a table
    for some, words in (([10.0, 12.0, 14.0], []), (level, ["--alpha", "0.001"])):
        few, slow = with_samples(results, some), with_samples(results, [100.0 * ns for ns in some])
        done = bench.compare(few, slow, "--gate", "0", *words)
        check(done.returncode == 1 and done.stderr.count("\n") == 1 and "too few samples" in done.stderr, words, done)
        check(bench.compare(few, slow, *words).returncode == 0, words)


def check_ways(bench, results):
    """What only one has is told, not compared; runs that differ in what they are of say so."""
    old, new = copy.deepcopy(results), copy.deepcopy(results)
    del old["mappings"][0]["speed"][0]
    del new["mappings"][1]
    new["machine"]["compiler"] = "another 1.0"
    done = bench.compare(old, new)
    check(done.returncode == 0 and "only in new: s2 double array forward\n" in done.stdout, done)
    check("only in old: tanh float single inverse\n" in done.stdout and "tanh double" in done.stdout, done)
    check("compiler, not the same: " in done.stdout and " -> another 1.0\n" in done.stdout, done)
    check("s2 double array forward" not in rows_of(done.stdout), done)
    for commit, date in ((each["commit"], each["date"]) for each in (old, new)):
        check(commit in done.stdout and date in done.stdout, done)
    new["mappings"] = []
    done = bench.compare(old, new)
    check(done.returncode == 1 and done.stderr.count("\n") == 1 and "nothing can be compared" in done.stderr, done)


def check_files(bench, results):
    text = json.dumps(results).encode()
    bench.file("good.json", results)
    bench.refuses(b"", "line 1")
    for end in (1, 20, len(text) // 2, len(text) - 1):
        bench.refuses(text[:end], "line ")
    bench.refuses(text + b"}", "end of file")
    bench.refuses(b"\x00\xff\x1b[31m\n\n\x7f")
    bench.refuses(b"not JSON\x1b[2J", "line 1")
    bench.refuses(b"[" * 100000, "depth")
    bench.refuses(b'{"a":' * 100000, "depth")
    bench.refuses(b'{"program": "cubemap-bench", "program": "cubemap-bench"}', "duplicate")
    for word in (b"NaN", b"Infinity", b"-Infinity", b"1e999", b"0x10", b"01"):
        bench.refuses(re.sub(rb'"ns_samples": \[[^,\]]*', b'"ns_samples": [' + word, text, count=1), "line 1")
    for word in ("0", "-1", "null", '"1"', "[1]", "1e-300", "1e300", "true"):
        bench.refuses(re.sub(rb'"ns_samples": \[[^,\]]*', b'"ns_samples": [' + word.encode(), text, count=1),
                      "mappings[0].speed[0].ns_samples", "times")
    for foreign in ([], {}, [results], {"program": "side-by-side"}, {"fruit": {"size": "large"}}):
        bench.refuses(foreign)
    for path in (["program"], ["format"], ["date"], ["commit"], ["version"], ["machine"], ["machine", "cpu"],
                 ["settings"], ["settings", "points"], ["mappings"], ["mappings", 0, "specification"],
                 ["mappings", 0, "speed"], ["mappings", 1, "speed", 2, "precision"], ["mappings", 0, "speed", 0, "ns_samples"]):
        for wrong in (None, 7.5, [], {}, "\x1b[31m", "\x9b31m", "line\nline"):
            made = copy.deepcopy(results)
            inner = made
            for key in path[:-1]:
                inner = inner[key]
            inner[path[-1]] = wrong
            if not (path == ["mappings"] and wrong == [] or path[-1] == "speed" and wrong == []):
                bench.refuses(made)
    twice = copy.deepcopy(results)
    twice["mappings"].append(twice["mappings"][0])
    bench.refuses(twice, "twice")
    done = bench.call("compare", bench.folder / "nothing.json", bench.folder / "good.json")
    check(done.returncode == 1 and "cannot open" in done.stderr and done.stderr.count("\n") == 1, done)
    done = bench.call("compare", bench.folder / "good.json", bench.folder)
    check(done.returncode == 1 and "cannot read" in done.stderr and done.stderr.count("\n") == 1, done)


def check_itself(bench, results):
    """A run is no faster than itself; it may come from standard input; and the table may have nowhere to go."""
    good = bench.file("good.json", results)
    with good.open(encoding="utf-8") as text:
        done = bench.call("compare", "--gate", "0", "-", good, stdin=text)
    check(done.returncode == 0 and done.stderr == "", done)
    rows = rows_of(done.stdout)
    check(len(rows) > 3 and all(row[9] == "~" and row[10] == "1.000" for row in rows.values()), done.stdout)
    if pathlib.Path("/dev/full").is_char_device():
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([bench.program, "compare", good, good], stdout=full, stderr=subprocess.PIPE, check=False)
        check(done.returncode == 1 and b"standard output" in done.stderr, done)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(sys.argv[1], pathlib.Path(folder))
        done = bench.call("--quick", "--points", "64", "--repetitions", "7", "--random", "9", "--hard", "9", "--json", "-",
                          "s2", "tanh")
        check(done.returncode == 0, done)
        results = json.loads(done.stdout)
        for each in (check_itself, check_figures, check_gate, check_ways, check_files):
            each(bench, results)


if __name__ == "__main__":
    main()
