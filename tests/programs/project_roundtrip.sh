#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# N random points through "cubemap-project -m M | cubemap-project -m M -I", for every mapping of the
# catalogue: how far from where they were do they come back? Exit status 1 if some are more than
# 5 nm on Earth away, or if a program fails.
#
# usage: project_roundtrip.sh PROGRAMS N [CHECKER [SEED]]
#   PROGRAMS  folder with the built programs
#   N         points for each mapping; 10000000 take five minutes and 1 GB in TMPDIR
#   CHECKER   the program that tests/programs/test_roundtrip.c makes; default: PROGRAMS/../tests/roundtrip
set -u -o pipefail
LC_ALL=C
export LC_ALL

usage='usage: project_roundtrip.sh PROGRAMS N [CHECKER [SEED]]'
program=${1:?$usage}/cubemap-project
count=${2:?$usage}
checker=${3:-$1/../tests/programs/roundtrip}
seed=${4:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$checker" points "$count" "$seed" >"$work/points" || exit 1
names=$("$program" --list=json |
    sed -n '/^  "mappings"/,/^  ]/s/^ *"identifier": "\(.*\)",$/\1/p') || exit 1
status=0
tested=0

for name in $names; do
    tested=$((tested + 1))
    printf '%-12s ' "$name"
    if ! "$program" -m "$name" "$work/points" | "$program" -m "$name" -I >"$work/back"; then
        echo 'cubemap-project failed'
        status=1
    elif ! "$checker" compare "$work/points" "$work/back"; then
        status=1
    fi
done
if [ "$tested" -eq 0 ]; then
    echo 'no mapping was tested'
    status=1
fi
exit "$status"
