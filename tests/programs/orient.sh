#!/bin/bash
# SPDX-License-Identifier: MIT
#
# orient.sh PROGRAMS ROOT: tests cubemap-orient in the folder PROGRAMS from the outside. ROOT is the top of the
# source tree. A line a case, "ok N - NAME" or "not ok N - NAME"; exit status 1 if any is not.

set -u
here=$(cd "$(dirname "$0")" && pwd)
programs=$(cd "$1" && pwd)
root=$(cd "$2" && pwd)
# shellcheck source-path=SCRIPTDIR source=cases.sh
. "$here/cases.sh" "$programs"
land=$root/data/land-1440.png

orient()
{
    "$programs/cubemap-orient" "$@"
}

# fails NAME STATUS PATTERN ARGUMENT...: this exit status, nothing on stdout, one line on stderr with the pattern.
fails()
{
    local name=$1 wanted=$2 pattern=$3 status=0
    shift 3
    orient "$@" >out.txt 2>err.txt || status=$?
    if [ "$status" -eq "$wanted" ] && [ ! -s out.txt ] && [ "$(wc -l <err.txt)" -eq 1 ] &&
        grep -q "^cubemap-orient: .*$pattern" err.txt; then
        result 0 "$name"
    else
        result 1 "$name" "status $status: $(cat out.txt err.txt)"
    fi
}

# prints NAME PATTERN ARGUMENT...: success, the pattern on stdout, nothing on stderr.
prints()
{
    local name=$1 pattern=$2 status=0
    shift 2
    orient "$@" >out.txt 2>err.txt || status=$?
    if [ "$status" -ne 0 ] || [ -s err.txt ] || ! grep -Eq -e "$pattern" out.txt; then
        result 1 "$name" "status $status: $(cat out.txt err.txt)"
    else
        result 0 "$name"
    fi
}

# A grey picture, 72 x 36, light in a disc about row 18, column 45 (longitude 47.5, latitude -2.5).
draw_mask()
{
    {
        echo 'P2 72 36 255'
        for ((row = 0; row < 36; row++)); do
            for ((column = 0; column < 72; column++)); do
                echo $(((row - 18) * (row - 18) + (column - 45) * (column - 45) <= 6 ? $1 : $2))
            done
        done
    } >"$3"
}

draw_mask 255 0 disc.pgm
draw_mask 0 255 dark.pgm
draw_mask 0 0 none.pgm
printf 'P2 5 2 255 0 0 0 0 0 1 1 1 1 1\n' >odd.pgm
printf 'no image\n' >text.png

prints 'help' '^Usage: cubemap-orient' --help
prints 'version' '^cubemap-orient [0-9]' --version
prints 'list' '^land-coupled coupled deformation 17.15 9.09 31.98 ' --list
fails 'no mask' 2 'one mask is needed, 0 are given'
fails 'two masks' 2 'one mask is needed, 2 are given' a b
fails 'unknown option' 2 "no option '--best'" --best disc.pgm
fails 'wrong mapping' 2 "no mapping is called 'cube'" -m cube disc.pgm
fails 'one face' 2 'has one face' -m octahedral disc.pgm
fails 'wrong measure' 2 "'size' is not deformation" --measure size disc.pgm
fails 'wrong orientation' 2 'LAT must be in' --evaluate 1,91 disc.pgm
fails 'unknown orientation' 2 "no orientation is called 'sea'" --evaluate sea disc.pgm
fails 'wrong resolution' 2 'from 0.01 to 10' --resolution 0.001 disc.pgm
fails 'wrong threshold' 2 'from 0 to 1' --threshold 2 disc.pgm
fails 'image without picture' 2 'picture says where' --image disc.pgm disc.pgm
fails 'no such file' 1 "'missing.png'" missing.png
fails 'no image' 1 "'text.png'" text.png
fails 'wrong shape' 1 'twice as wide as high' odd.pgm
fails 'nothing counts' 1 'no pixel that counts' none.pgm
fails 'picture of no known format' 2 'out.xyz' --evaluate 0,0 --picture out.xyz disc.pgm
leftovers=$(find . -name "*out.xyz*")
[ -z "$leftovers" ]
result $? "no part of a picture is left" "$leftovers"

# the disc goes to the middle of a face, and how bright it is and which sign it has is no matter
coarse=(-q --boxes 6000) # what is asked here is not how sure the result is
prints 'a disc' '^mean angular deformation: 22.*-> 0?.?[0-9.]+ degrees$' "${coarse[@]}" disc.pgm
orient "${coarse[@]}" --json --threshold 0.5 disc.pgm >bright.json
orient "${coarse[@]}" --json --invert --threshold 0.5 dark.pgm >inverted.json
orient "${coarse[@]}" --json --invert --threshold 0.5 --threads 1 dark.pgm >thread.json
cmp -s bright.json inverted.json
result $? 'inverted' "$(cat bright.json inverted.json)"
cmp -s bright.json thread.json
result $? 'one thread' "$(cat bright.json thread.json)"
python3 - bright.json <<'END'
import json, math, sys
found = json.load(open(sys.argv[1]))
def direction(lon, lat):
    lon, lat = math.radians(lon), math.radians(lat)
    return math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat)
lon, lat, roll = (math.radians(found[name]) for name in ("lon", "lat", "roll"))
front = direction(found["lon"], found["lat"])
east = (-math.sin(lon), math.cos(lon), 0.0)
north = (-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat))
axes = [front, [math.cos(roll) * e + math.sin(roll) * n for e, n in zip(east, north)],
        [math.cos(roll) * n - math.sin(roll) * e for e, n in zip(east, north)]]
middle = direction(47.5, -2.5)
nearest = max(abs(sum(a * b for a, b in zip(axis, middle))) for axis in axes)
sys.exit(math.degrees(math.acos(min(1.0, nearest))) > 0.5 or found["after"] > 3.0)
END
result $? 'the disc is in the middle of a face' "$(cat bright.json)"

# what --evaluate says is what the search says
value=$(python3 -c 'import json, sys; f = json.load(open(sys.argv[1])); print("%.9f,%.9f,%.9f" % (f["lon"], f["lat"], f["roll"]))' bright.json)
orient --json "--evaluate=$value" disc.pgm >again.json
python3 -c 'import json, sys; a, b = (json.load(open(n)) for n in sys.argv[1:]); sys.exit(abs(a["after"] - b["value"]) > 1e-4)' bright.json again.json
result $? 'evaluated' "$(cat bright.json again.json)"
prints 'edges' 'edges over the mask: 2[0-9.]+ -> 0 km' "${coarse[@]}" --measure edges disc.pgm

# the picture: its size, and the same pixels again
orient --evaluate 10,20,30 --size 32 --picture one.png disc.pgm >/dev/null &&
    orient --evaluate 10,20,30 --size 32 --picture two.png --threads 1 disc.pgm >/dev/null &&
    "$programs/cubemap-compare" --max 0 --quiet one.png two.png
result $? 'picture'
orient --evaluate 0,0 --size 32 --picture three.png --image "$root/data/earth-2048.jpg" disc.pgm >/dev/null
result $? 'picture of an image'

"$root/research/earth/orientations" "$programs/cubemap-orient" "$land" land-coupled land-tangent land-slice land-edges --check >out.txt 2>&1
result $? 'named orientations' "$(cat out.txt)"

finish
