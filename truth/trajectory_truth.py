#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Errors of trajectories, made apart from the library: what it says is held against this.

trajectory_truth.py TRUTH ESTIMATE [TRUTH ESTIMATE...]     one line of JSON for each two files as TUM writes them

Association looks at all pairs of stamps, whose distance is that of their decimals; the alignment is by singular values
(Umeyama 1991, scale 1); the pairs of RPE are looked for from the beginning each time, their distance of decimals, too. Poses are 4 x 4 matrices from camera to world.
"""

import decimal
import json
import sys

import numpy


def matrix_of(row):
    """Of tx ty tz qx qy qz qw."""
    x, y, z, w = row[3:] / numpy.linalg.norm(row[3:])
    cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    pose = numpy.eye(4)
    pose[:3, :3] += 2.0 * w * cross + 2.0 * cross @ cross
    pose[:3, 3] = row[:3]
    return pose


def read(path):
    rows = numpy.loadtxt(path, comments="#", ndmin=2, dtype=float)
    return rows[:, 0], [matrix_of(row) for row in rows[:, 1:]]


def is_within(a, b, apart):
    """Of the decimals, the shortest that are these numbers."""
    return abs(decimal.Decimal(repr(float(a))) - decimal.Decimal(repr(float(b)))) <= decimal.Decimal(repr(apart))


def is_after(begin, end, interval):
    """At least so long after, of the decimals."""
    return decimal.Decimal(repr(float(end))) - decimal.Decimal(repr(float(begin))) >= decimal.Decimal(repr(interval))


def associate(first, second, apart=0.02):
    """Pairs of indices: of all pairs the closest, then the closest of those that are left."""
    candidates = sorted((abs(a - second[k]), i, k) for i, a in enumerate(first)
                        for k in numpy.nonzero(abs(second - a) <= 2 * apart)[0] if is_within(a, second[k], apart))
    taken_first, taken_second, pairs = set(), set(), []
    for _, i, k in candidates:
        if i not in taken_first and k not in taken_second:
            taken_first.add(i)
            taken_second.add(k)
            pairs.append((i, k))
    return sorted(pairs)


def align(source, target):
    """The rotation and translation that take source to target, points by rows; and is there but one?"""
    source_mean, target_mean = source.mean(axis=0), target.mean(axis=0)
    u, s, v = numpy.linalg.svd((target - target_mean).T @ (source - source_mean))
    sign = numpy.sign(numpy.linalg.det(u) * numpy.linalg.det(v))
    rotation = u @ numpy.diag([1.0, 1.0, sign]) @ v
    is_determined = s[1] + sign * s[2] > 1e-11 * s[0] and s[0] > 1e-20
    return rotation, target_mean - rotation @ source_mean, bool(is_determined)


def root_mean_square(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values)))) if len(values) else None


def angle_of(rotation):
    """In degrees, of the sine and of the cosine, so that small angles keep their digits."""
    sine = 0.5 * numpy.linalg.norm([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
                                    rotation[1, 0] - rotation[0, 1]])
    return numpy.degrees(numpy.arctan2(sine, 0.5 * (numpy.trace(rotation) - 1.0)))


def motion_errors(stamps, truth, estimate, interval=1.0):
    """Lengths and angles of E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), j the first at least an interval after i."""
    lengths, angles = [], []
    for i, begin in enumerate(stamps):
        near = numpy.nonzero(stamps - begin >= 0.5 * interval)[0]
        later = next((k for k in near if is_after(begin, stamps[k], interval)), None)
        if later is not None:
            right = numpy.linalg.inv(truth[i]) @ truth[later]
            guess = numpy.linalg.inv(estimate[i]) @ estimate[later]
            error = numpy.linalg.inv(right) @ guess
            lengths.append(numpy.linalg.norm(error[:3, 3]))
            angles.append(angle_of(error[:3, :3]))
    return lengths, angles


def evaluate(truth_path, estimate_path):
    truth_stamps, truth = read(truth_path)
    estimate_stamps, estimate = read(estimate_path)
    pairs = associate(truth_stamps, estimate_stamps)
    truth = [truth[i] for i, _ in pairs]
    estimate = [estimate[k] for _, k in pairs]
    target = numpy.array([pose[:3, 3] for pose in truth])
    source = numpy.array([pose[:3, 3] for pose in estimate])
    rotation, translation, is_determined = align(source, target)
    errors = numpy.linalg.norm(source @ rotation.T + translation - target, axis=1)
    lengths, angles = motion_errors(truth_stamps[[i for i, _ in pairs]], truth, estimate)
    return {"pairs": len(pairs), "motions": len(lengths), "ate_rmse": root_mean_square(errors),
            "rpe_translation_rmse": root_mean_square(lengths), "rpe_rotation_rmse_degrees": root_mean_square(angles),
            "rank_deficient": not is_determined}


def main():
    paths = sys.argv[1:]
    if not paths or len(paths) % 2:
        sys.exit(__doc__)
    for truth, estimate in zip(paths[::2], paths[1::2]):
        print(json.dumps(evaluate(truth, estimate)))


if __name__ == "__main__":
    main()
