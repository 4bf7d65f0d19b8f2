#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Two builds on the same inputs: the library's bits for every mapping and instruction set, and the eight programs' exit
# statuses, standard output and files, byte by byte (files that differ in bytes: pixel by pixel). Of what fails the status
# is compared, and that there is one line on standard error; its words may differ. For changes that no user should see.
# Usage: compare_builds.sh OLD_BUILD NEW_BUILD [SOURCE_TREE]
#   SOURCE_TREE  with data/; default: that of this script
# The last line is "N runs, M differ".
set -u
root=$(CDPATH='' cd -- "${3:-$(dirname -- "$0")/../..}" && pwd) || exit 2
# new is read by its name
# shellcheck disable=SC2034
old=$(cd "$1/tools" && pwd) && new=$(cd "$2/tools" && pwd) || exit 2
old_library=$(cd "$1/libcubemap" && pwd) && bits=$(cd "$2/tests/mapping" && pwd)/test-bits || exit 2
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
mkdir "$work/in"; cd "$work/in" || exit 1
"$old/cubemap-reproject" --quiet --to equirect --size 256 "$root/data/earth-2048.jpg" earth.png
"$old/cubemap-reproject" --quiet --to cube --layout cross --size 64 earth.png cross.png
"$old/cubemap-reproject" --quiet --to equirect --size 360 "$root/data/land-1440.png" land.png
"$old/cubemap-reproject" --quiet --to azimuthal:equidistant --size 128 earth.png disc.tif
printf '12.5 41.9 Rome\n-58.4 -34.6\n0 90\n180 0\n# a comment\n\n2.35 48.85 Paris\n' >lonlat
printf '1 0 0\n0 1 0\n-0.3 0.4 0.5\n1 1 1\n' >xyz
printf '0 0.25 -0.5\n4 0.1 0.2\n5 -1 1\n' >faces
printf '0 1\n41.9 Rome\n-90\n45\n' >latitudes
runs=0
differ=0

# every mapping, set and precision: the table of the new build's test, and the library of the old one
if ! LD_LIBRARY_PATH=$old_library "$bits" "$root/tests/bits.txt" || ! "$bits" "$root/tests/bits.txt"; then
    echo 'DIFFERS: the bits of mappings'
    differ=$((differ + 1))
fi
# try PROGRAM ARGUMENT...: standard input is the file named by $input
input=/dev/null
try()
{
    local program=$1 side; shift
    for side in old new; do
        rm -rf "${work:?}/$side"; cp -r "$work/in" "$work/$side"
        (cd "$work/$side" && "${!side}/cubemap-$program" "$@" <"$input" >"$work/$side.out" 2>"$work/$side.err"; echo $? >"$work/$side.rc")
    done
    local wrong=
    [ "$(cat "$work/old.rc")" = "$(cat "$work/new.rc")" ] || wrong="status $(cat "$work/old.rc") and $(cat "$work/new.rc")"
    cmp -s "$work/old.out" "$work/new.out" || wrong="$wrong; standard output"
    if [ "$(cat "$work/old.rc")" = 0 ]; then
        cmp -s "$work/old.err" "$work/new.err" || wrong="$wrong; standard error"
    else
        [ "$(wc -l <"$work/old.err")" = "$(wc -l <"$work/new.err")" ] || wrong="$wrong; lines of standard error"
    fi
    [ "$(ls -A "$work/old")" = "$(ls -A "$work/new")" ] || wrong="$wrong; names of files"
    for file in "$work/old"/*; do
        if [ -f "$file" ] && ! cmp -s "$file" "$work/new/${file##*/}"; then
            if "$old/cubemap-compare" --quiet --max 0 "$file" "$work/new/${file##*/}" 2>/dev/null; then
                echo "note: $program $*: the bytes of ${file##*/} differ, its pixels do not (dates)"
            else
                wrong="$wrong; ${file##*/}"
            fi
        fi
    done
    runs=$((runs + 1))
    if [ -n "$wrong" ]; then
        differ=$((differ + 1)); echo "DIFFERS: $program $*: $wrong"; diff "$work/old.out" "$work/new.out" | head -3
        cat "$work/old.err" "$work/new.err" | head -4
    fi
}
# points
for mapping in coupled tangent qsc healpix continuous cobe azimuthal:lambert peirce; do
    input=$work/in/lonlat; try project -m $mapping
    input=$work/in/xyz; try project -m $mapping --digits 17
done
input=$work/in/faces; try project -I -m coupled; try project -I -m qsc --frame gl --output xyz
input=$work/in/lonlat; try project -m nonesuch; try project --bogus
input=/dev/null; try project --list; try project --list=json; try project --version
input=$work/in/latitudes; try latitude --to authalic; try latitude --from authalic --to geographic -e Mars
try latitude --to conformal --exact --digits 9; try latitude; try latitude --to nonesuch
input=/dev/null; try latitude --list; try latitude --version
# images
try reproject earth.png 'f%f.png'
try reproject --to cube:qsc --layout cross --frame gl --size 40 earth.png a.png
try reproject --to cube:tangent:c=1.1823 --layout strip --frame fits earth.png a.tif
try reproject --to cube:healpix --layout cross:north=0,south=3 earth.png a.exr
try reproject --to cube --frame s2 --layout strip --filter nearest earth.png a.png
try reproject cross.png b.png; try reproject --to equirect --size 100 cross.png b.jpg
try reproject --from azimuthal:equidistant disc.tif a.png
for chart in peirce octahedral rhealpix azimuthal:stereographic quincuncial:lambert,shirley border:equidistant,radial; do
    try reproject --to $chart --size 99 earth.png a.png
done
try reproject --to cube:gnomonic --graticule 15 --indicatrices 5 --grid 4 --layout cross --size 120 earth.png a.png
try reproject --graticule 30 --line-width 3 --line-color ff8000 --to equirect --quiet earth.png a.png
try reproject --size 0 earth.png a.png; try reproject --sise 4 earth.png a.png; try reproject none.png a.png
try reproject earth.png; try reproject --layout row earth.png a.png; try reproject --to mercator earth.png a.png
try reproject --version; try compare --version; try distortion --version; try orient --version; try colormap --version
try compare earth.png earth.png; try compare --max 1 earth.png land.png; try compare land.png land.png --quiet; try compare x
try distortion -m gnomonic --size 64 a.png; try distortion -m qsc --quantity deformation --face 0 --isolines 5 --size 100 a.png
try distortion --values --layout strip --size 32 a.exr; try distortion -m peirce --size 64 --graticule 15 --legend l.png a.png
try distortion -m healpix --quantity isotropy --range 1.1:1.5 --reverse --colors sequential-single:hue=140 --size 50 a.tif
try distortion --layout faces --size 16 'd%f.png'; try distortion --face 9 a.png; try distortion --range 2:1 a.png
try orient --list; try orient -q --boxes 2000 land.png; try orient --json --evaluate 10,20,30 land.png
try orient --evaluate land-coupled --size 32 --picture p.png land.png; try orient --measure sea land.png; try orient
for format in json csv matplotlib gimp; do try colormap rainbow --format $format; done
try colormap --list; try colormap diverging --samples 9 -o d.json; try colormap qualitative --size 50x4 -o q.png
try colormap single:saturation=4 --fit; try colormap single:saturation=4; try colormap viridis; try colormap single --size 5 -o a.png
try colormap single --test-pattern --size 160x20 -o t.png
# the benchmark: what does not depend on time
try bench --list; try bench --version; try bench papers optima; try bench nonesuch
echo "$runs runs, $differ differ"
[ "$differ" -eq 0 ]
