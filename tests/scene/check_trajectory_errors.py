#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""ATE and RPE of the library equal those of truth/trajectory_truth.py to 1e-9: for TUM's ground truth with perturbations that
are stated here, where shared/data is beside the tree or above it, and for 100 synthetic pairs in one process.

check_trajectory_errors.py TRAJECTORY-ERRORS TRAJECTORY-TRUTH.PY
"""

import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy
except ImportError:
    print("numpy is missing (apt: python3-numpy)")
    sys.exit(77)

TOLERANCE = 1e-9
EXCERPT = "shared/data/rgbd/tum_excerpt/groundtruth.txt"
SYNTHETIC = 100


def find_excerpt(start):
    """In the tree, or in one of the folders above it."""
    folder = os.path.abspath(start)
    while folder != os.path.dirname(folder):
        if os.path.exists(os.path.join(folder, EXCERPT)):
            return os.path.join(folder, EXCERPT)
        folder = os.path.dirname(folder)
    return None


def quaternion_product(a, b):
    """Of rows x y z w."""
    v, w = a[..., :3], a[..., 3:]
    p, q = b[..., :3], b[..., 3:]
    return numpy.concatenate([w * p + q * v + numpy.cross(v, p), w * q - numpy.sum(v * p, -1, keepdims=True)], -1)


def unit(rows):
    return rows / numpy.linalg.norm(rows, axis=-1, keepdims=True)


def small_turns(random, count, degrees):
    vector = numpy.radians(degrees) * random.standard_normal((count, 3))
    return unit(numpy.concatenate([0.5 * vector, numpy.ones((count, 1))], -1))


def turned(quaternion, points):
    as_rows = numpy.concatenate([points, numpy.zeros((len(points), 1))], -1)
    inverse = quaternion * [-1.0, -1.0, -1.0, 1.0]
    return quaternion_product(quaternion_product(quaternion, as_rows), inverse)[:, :3]


def moved(rows, quaternion, translation):
    """All of it by one rigid motion."""
    made = rows.copy()
    each = numpy.broadcast_to(unit(numpy.array(quaternion)), (len(rows), 4))
    made[:, 1:4] = turned(each, rows[:, 1:4]) + translation
    made[:, 4:] = quaternion_product(each, unit(rows[:, 4:]))
    return made


def noisy(random, rows, metres, degrees):
    made = rows.copy()
    made[:, 1:4] += metres * random.standard_normal((len(rows), 3))
    made[:, 4:] = quaternion_product(unit(rows[:, 4:]), small_turns(random, len(rows), degrees))
    return made


def perturbed(rows):
    """What is done to TUM's ground truth, by name."""
    random = numpy.random.default_rng(20)
    yield "itself", rows
    yield "moved rigidly", moved(rows, [0.5, -0.1, 0.3, 0.8], [1.0, -20.0, 3.0])
    yield "noise of 1 cm and 1 degree", noisy(random, rows, 0.01, 1.0)
    late = noisy(random, rows, 0.001, 0.1)
    late[:, 0] += 0.004
    yield "late by 4 ms, with noise", late
    jittered = noisy(random, rows[::3], 0.02, 2.0)
    jittered[:, 0] += random.uniform(-0.014, 0.014, len(jittered))
    yield "each third, stamps off by up to 14 ms", moved(jittered, [0.0, 0.0, 1.0, 1.0], [5.0, 0.0, 0.0])
    drifting = noisy(random, rows, 0.0, 0.0)
    drifting[:, 1:4] += numpy.cumsum(0.001 * random.standard_normal((len(rows), 3)), 0)
    yield "drift, with a gap", numpy.delete(drifting, slice(500, 900), 0)
    mirrored = rows.copy()
    mirrored[:, 1] *= -1.0
    yield "mirrored", mirrored
    straight = rows.copy()
    straight[:, 2:4] = [1.0, 2.0]
    yield "on a line", straight


def at_limit(rows):
    """Each tenth, and an estimate whose stamps are 0.02 s away or a little more, as they are written."""
    random = numpy.random.default_rng(21)
    thin = rows[::10]
    estimate = noisy(random, thin, 0.001, 0.1)
    estimate[:, 0] = numpy.round(estimate[:, 0] + random.choice([-0.02, 0.02, 0.020001], len(thin)), 6)
    return thin, estimate


def at_steps(rows):
    """Stamps a tenth of a second apart, of which many a second apart are less as doubles are subtracted."""
    random = numpy.random.default_rng(22)
    truth = rows[:400].copy()
    truth[:, 0] = [float(f"{1305031102 + k // 10}.{k % 10}") if k >= 200 else float(f"{k // 10}.{k % 10}")
                   for k in range(len(truth))]
    return truth, noisy(random, truth, 0.01, 1.0)


def synthetic(index):
    """A walk of some length and rate, and an estimate of it with other stamps; each tenth is on a line."""
    random = numpy.random.default_rng([7, index])
    count = int(random.integers(3, 220))
    stamps = random.choice([0.0, 1.3e9]) + numpy.cumsum(random.uniform(0.01, 0.2, count))
    places = numpy.cumsum(random.standard_normal((count, 3)), 0) * 10.0 ** random.uniform(-2, 1)
    if index % 10 == 9:
        places[:, 1:] = [3.0, -2.0]
    turns = unit(numpy.cumsum(random.standard_normal((count, 4)), 0) + [0.0, 0.0, 0.0, 2.0])
    truth = numpy.column_stack([stamps, places, turns])
    kept = truth[random.uniform(size=count) < 0.9] if count > 20 else truth
    estimate = noisy(random, kept, 0.0 if index % 10 == 9 else 0.05, 3.0)
    jitter = random.uniform(-0.02, 0.02, len(estimate))
    estimate[:, 0] = numpy.sort(estimate[:, 0] + jitter * (random.uniform() < 0.5))
    return truth, moved(estimate, random.standard_normal(4), random.standard_normal(3))


def write(path, rows):
    """repr brings back the same doubles."""
    with open(path, "w", encoding="ascii") as file:
        file.write("# timestamp tx ty tz qx qy qz qw\n")
        for row in rows:
            file.write(" ".join(repr(float(value)) for value in row) + "\n")


def make_pairs(folder, excerpt):
    """Names and files; the files are written."""
    pairs = []
    if excerpt is not None:
        all_rows = numpy.loadtxt(excerpt)
        for number, (name, rows) in enumerate(perturbed(all_rows)):
            path = os.path.join(folder, f"tum-{number}.txt")
            write(path, rows)
            pairs.append((f"TUM, {name}", excerpt, path))
        for name, both in (("0.02 s away", at_limit(all_rows)), ("in steps of 0.1 s", at_steps(all_rows))):
            paths = [os.path.join(folder, f"tum-{kind}-{len(pairs)}.txt") for kind in ("truth", "estimate")]
            for path, rows in zip(paths, both):
                write(path, rows)
            pairs.append((f"TUM, {name}", *paths))
    for index in range(SYNTHETIC):
        paths = [os.path.join(folder, f"{kind}-{index}.txt") for kind in ("truth", "estimate")]
        for path, rows in zip(paths, synthetic(index)):
            write(path, rows)
        pairs.append((f"synthetic {index}", *paths))
    return pairs


def answers(command, pairs):
    paths = [path for _, *both in pairs for path in both]
    text = subprocess.run(command + paths, check=True, stdout=subprocess.PIPE, text=True).stdout
    return [json.loads(line) for line in text.splitlines()]


def is_same(a, b):
    if isinstance(a, float) and isinstance(b, (int, float)) or isinstance(b, float) and isinstance(a, (int, float)):
        return abs(a - b) <= TOLERANCE
    return a == b and type(a) is type(b)


def main():
    program, truth = sys.argv[1:3]
    excerpt = find_excerpt(os.path.dirname(truth))
    if excerpt is None:
        print(f"no {EXCERPT} here or above: synthetic pairs alone")
    with tempfile.TemporaryDirectory() as folder:
        pairs = make_pairs(folder, excerpt)
        ours = answers([program], pairs)
        others = answers([sys.executable, truth], pairs)
    wrong = len(ours) != len(pairs) or len(others) != len(pairs)
    worst = 0.0
    for (name, *_), mine, other in zip(pairs, ours, others):
        for key in other:
            if not is_same(mine[key], other[key]):
                print(f"{name}: {key}: {mine[key]!r}, not {other[key]!r}")
                wrong = True
            elif isinstance(other[key], float):
                worst = max(worst, abs(mine[key] - other[key]))
    deficient = sum(other["rank_deficient"] for other in others)
    motions = sum(other["motions"] for other in others)
    if deficient < SYNTHETIC // 10 or motions < 1000:
        print(f"{deficient} on a line and {motions} motions are too few to say anything")
        wrong = True
    print(f"trajectory errors: {len(pairs)} pairs of files, {motions} motions, {deficient} on a line; at most {worst:.2g} apart")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
