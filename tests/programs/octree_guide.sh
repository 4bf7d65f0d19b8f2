#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The commands of docs/guide/octree.md run as printed, and print what the guide says.
# Usage: octree_guide.sh REPOSITORY FOLDER_OF_PROGRAMS
set -eu
root=$1 programs=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

block() { # block FENCE NUMBER: that block of code of the guide
    awk -v fence="\`\`\`$1" -v number="$2" '$0 == fence { inside = ++count == number; next }
        $0 == "```" { inside = 0 }
        inside' "$root/docs/guide/octree.md"
}
block sh 1 >"$work/first.sh"
block sh 2 >"$work/second.sh"
block output 1 >"$work/expected"
test -s "$work/first.sh"
test -s "$work/second.sh"
test -s "$work/expected"
cd "$work"
export PATH=$programs:$PATH
bash -eu first.sh >got
diff expected got
bash -eu second.sh >told
grep -q '"edge": 0.02, "levels": 16, .*"views": 4, "complete": true' told
test -s view.png -a -s depth.exr -a -s probe_0.exr -a -s probe_5.exr -a -s room.ply
echo "ok: the guide to maps"
