#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The compiler's own report on the batch loops for AVX2: which loop over which mapping's kernel became
# vector code. Fails if the loops over algebraic, coupled, qsc, outerra or the face selection did not.
# Usage: vectorisation.sh REPOSITORY C_COMPILER
set -eu
root=$1 cc=$2
if [ "$(uname -m)" != x86_64 ]; then
    echo "not an x86-64 machine"
    exit 77
fi
flags="-std=c11 -O3 -mavx2 -ffp-contract=off -fno-math-errno -fno-trapping-math"
if $cc --version | grep -qi clang; then
    report="-Rpass=loop-vectorize"
    pattern='vectorized loop (vectorization width: [48],'
else
    report="-fopt-info-vec-optimized"
    pattern='loop vectorized using 32 byte vectors'
fi
status=0
for precision in double float; do
    # shellcheck disable=SC2086
    lines=$($cc $flags $report -I "$root/include" -c "$root/libcubemap/$precision.c" -o /dev/null 2>&1)
    # the selection of the face is where the loops over cube.h are made
    faces=$(grep -n '^CM_PROJECTION(cube)' "$root/libcubemap/precision.h" | cut -d: -f1)
    test -n "$faces"
    for room in kernel/algebraic.h kernel/coupled.h kernel/qsc.h kernel/outerra.h kernel/healpix.h \
        "precision.h:$faces"; do
        found=$(printf '%s\n' "$lines" | grep -c "$room:.*$pattern" || true)
        echo "$precision $room: $found loops of AVX2 vectors"
        # forward and inverse
        if [ "$found" -lt 2 ]; then
            status=1
        fi
    done
done
exit $status
