#!/bin/bash
# SPDX-License-Identifier: MIT
#
# reproject.sh PROGRAMS ROOT [HELPER [SUBJECT...]]: tests cubemap-reproject and cubemap-compare in the
# folder PROGRAMS from the outside. ROOT is the top of the source tree; HELPER is the program made of
# direction_image.cpp (without it, PROGRAMS/direction_image); the subjects are those at the end of
# this file (without them, all). A line a case, "ok N - NAME" or "not ok N - NAME"; exit status 1 if any is
# not.

set -u
here=$(cd "$(dirname "$0")" && pwd)
programs=$(cd "$1" && pwd)
root=$(cd "$2" && pwd)
helper=${3:-$programs/direction_image}
helper=$(cd "$(dirname "$helper")" && pwd)/$(basename "$helper")
# shellcheck source-path=SCRIPTDIR source=cases.sh
. "$here/cases.sh" "$programs"

reproject()
{
    "$programs/cubemap-reproject" "$@"
}

compare()
{
    "$programs/cubemap-compare" "$@"
}

# passes NAME COMMAND...: the command must succeed and say nothing on stderr.
passes()
{
    local name=$1 status=0
    shift
    "$@" >out.txt 2>err.txt || status=$?
    [ ! -s err.txt ] || status=1
    result "$status" "$name" "$(cat out.txt err.txt)"
}

# fails NAME STATUS WORDS COMMAND...: the command must end with that status and one line on stderr
# that matches the words, write nothing to stdout, and leave nothing in the folder "made".
fails()
{
    local name=$1 wanted=$2 words=$3 status=0
    shift 3
    mkdir -p made
    "$@" >out.txt 2>err.txt || status=$?
    local good=1
    if [ "$status" -eq "$wanted" ] && [ "$(wc -l <err.txt)" -eq 1 ] && [ ! -s out.txt ] &&
        grep -q -E -e "^cubemap-(reproject|compare): .*($words)" err.txt &&
        [ -z "$(ls -A made)" ]; then
        good=0
    fi
    result "$good" "$name" "status $status; $(cat out.txt err.txt); left: $(ls -A made)"
    rm -rf made
}

# in_fresh_folder SUBJECT: runs the function of that name in a folder of its own.
in_fresh_folder()
{
    mkdir "$work/$1" && cd "$work/$1" && "$1"
    cd "$work" && rm -rf "${work:?}/$1"
}

# --- geometry -------------------------------------------------------------------------------------

# An image that holds its own directions must hold them after each conversion, up to the error of
# bilinear interpolation: h^2/4 for a grid of h radians, 1e-5 here. From a cube it is larger near
# the edges, where the grids of two faces meet at an angle: a fifth of a pixel at the corners.
every_mapping()
{
    "$helper" mappings >mappings.txt
    mappings_of_list
}

# One in three, and those that are like no other: torn, singular, of twelve squares. The whole list, by the
# name above, takes three times as long and asks the library more than the programs.
several_mappings()
{
    "$helper" mappings | awk 'NR % 3 == 1 || /^(arvo|conformal|healpix|coupled)$/' >mappings.txt
    mappings_of_list
}

mappings_of_list()
{
    "$helper" make equirect - - 1024 equirect.tif
    local mapping frame layout name turn=0
    while read -r mapping; do
        frame=$(printf 'geo\ngl\nfits\n' | sed -n $((turn % 3 + 1))p)
        layout=$(printf 'cross\nstrip\n' | sed -n $((turn % 2 + 1))p)
        turn=$((turn + 1))
        there_and_back
    done <mappings.txt
}

every_frame()
{
    "$helper" make equirect - - 1024 equirect.tif
    local mapping=coupled frame layout name
    for frame in geo gl fits; do
        for layout in faces strip cross; do
            there_and_back
        done
    done
    frame=s2
    for layout in faces strip; do
        there_and_back
    done
    fails 's2 as a cross' 1 'no cross without turned faces' reproject --to "cube:$mapping" --frame s2 \
        --layout cross equirect.tif made/a.png
}

# Uses the variables mapping, frame and layout of its caller.
there_and_back()
{
    # torn along edges, where the pixels of the neighbour are not those next to a face's own
    local largest=1.5e-3
    [ "$mapping" != arvo ] || largest=1.5e-2
    name=cube.tif
    [ "$layout" != faces ] || name=cube_%f.tif
    reproject --quiet --to "cube:$mapping" --frame "$frame" --layout "$layout" equirect.tif "$name"
    passes "equirect to cube:$mapping, $frame, $layout" \
        "$helper" check "$mapping" "$frame" "$layout" "$name" 2e-5 5e-6
    "$helper" make "$mapping" "$frame" "$layout" 256 "$name"
    reproject --quiet --from "cube:$mapping" --frame "$frame" --from-layout "$layout" "$name" \
        back.tif
    passes "cube:$mapping, $frame, $layout to equirect" \
        "$helper" check equirect - - back.tif $largest 2e-5
}

odd_sizes()
{
    "$helper" make equirect - - 1024 equirect.tif
    local size
    for size in 1 2 3 17; do
        reproject --quiet --size $size --layout strip equirect.tif cube.tif
        passes "face of $size pixels" "$helper" check coupled geo strip cube.tif 2e-5 1e-5
    done
    reproject --quiet --to equirect --size 2 equirect.tif two.tif
    passes 'equirectangular image of 2 pixels' "$helper" check equirect - - two.tif 2e-5 2e-5
    # An odd width, where the far side of a pole lies between two pixels.
    "$helper" constant 5 3 1 float 0.7 odd.tif
    "$helper" constant 8 4 1 float 0.7 even.tif
    reproject --quiet --from equirect --to equirect --size 8 odd.tif out.tif
    passes 'odd width, any aspect' compare --max 0 out.tif even.tif
}

cube_to_cube()
{
    "$helper" make equirect - - 1024 equirect.tif
    reproject --quiet --to cube:qsc --frame gl --layout cross equirect.tif first.tif
    reproject --quiet --from cube:qsc --to cube:tangent:c=1.1823 --from-frame gl --frame fits \
        --layout strip first.tif second.tif
    passes 'cube to cube in another mapping, frame and layout' \
        "$helper" check tangent:c=1.1823 fits strip second.tif 1.5e-3 5e-5
    # rHEALPix: the same with its polar squares elsewhere, turned
    reproject --quiet --to cube:healpix --layout cross equirect.tif first.tif
    reproject --quiet --from cube:healpix first.tif straight.tif
    local columns
    for columns in north=0,south=3 north=2,south=0 north=3,south=2 north=1,south=1; do
        for frame in geo gl; do
            reproject --quiet --to cube:healpix --frame $frame --layout cross:$columns equirect.tif turned.tif
            reproject --quiet --from cube:healpix --frame $frame --from-layout cross:$columns turned.tif \
                back.tif
            passes "rHEALPix in $frame, $columns" compare --max 2e-7 straight.tif back.tif
        done
    done
    "$helper" constant 8 4 1 float 0.5 grey.tif
    reproject --quiet --to cube:healpix --layout cross:north=3,south=0 --size 8 grey.tif cross.tif
    "$helper" describe cross.tif | grep -q '32 x 24, 1 channels'
    result $? 'size of a cross with turned faces'
    for frame in gl fits s2; do
        reproject --quiet --filter nearest --from cube:qsc --to cube:qsc --from-frame gl \
            --frame $frame --layout strip first.tif there.tif
        reproject --quiet --filter nearest --from cube:qsc --to cube:qsc --from-frame $frame \
            --frame gl --layout cross there.tif again.tif
        passes "gl to $frame and back loses nothing" compare --max 0 first.tif again.tif
    done
}

# Mappings of one face. Beside a disc's rim there is nothing to interpolate with: up to a pixel and a half.
charts()
{
    "$helper" make equirect - - 1024 equirect.tif
    local chart
    for chart in $("$helper" charts) azimuthal:lambert:full=1 azimuthal:equidistant:fov=200,lon=20,lat=30 \
        peirce quincuncial:mixture,elliptical,lon=100,lat=-20,beta=0.7; do
        reproject --quiet --to "$chart" --size 256 equirect.tif chart.tif
        passes "equirect to $chart" "$helper" check "$chart" - - chart.tif 2e-5 6e-6
    done
    while read -r chart largest mean; do
        "$helper" make "$chart" - - 512 chart.tif
        reproject --quiet --from "$chart" chart.tif back.tif
        passes "$chart to equirect" "$helper" check equirect - - back.tif "$largest" "$mean"
    done <<'E'
octahedral 6e-4 2e-5
octahedral:clarberg 3e-3 5e-5
peirce 4e-5 2e-5
quincuncial:equidistant,radial,lon=20,lat=30 4e-3 2e-5
border:equidistant,squircle 5e-5 2e-5
border:breusing,elliptical,lon=20,lat=30 8e-5 3e-5
rhealpix 6e-3 1e-4
rhealpix:north=2,south=3 6e-3 1e-4
azimuthal:equidistant:full=1 8e-3 3e-5
E
    for chart in lambert stereographic equidistant mixture breusing; do
        "$helper" make azimuthal:$chart - - 512 chart.tif
        reproject --quiet --from azimuthal:$chart --to azimuthal:lambert --size 300 chart.tif back.tif
        passes "azimuthal:$chart to another" "$helper" check azimuthal:lambert - - back.tif 1e-2 5e-5
    done
}

# A centre a quarter turn further on turns a layout, and the pixels beyond its border with it.
chart_borders()
{
    noise 32 32 >noise.ppm
    local chart filter
    for chart in quincuncial:lambert,shirley border:equidistant,radial; do
        reproject --quiet --from "$chart" --to "$chart",lon=180 --size 45 noise.ppm half.png
        python3 - <<'P'
pixels = open("noise.ppm", "rb").read()[-32 * 32 * 3:]
turned = b"".join(pixels[i:i + 3] for i in range(len(pixels) - 3, -1, -3))
open("turned.ppm", "wb").write(b"P6 32 32 255\n" + turned)
P
        reproject --quiet --from "$chart" --to "$chart" --size 45 turned.ppm turned.png
        passes "$chart, half a turn" compare --max 1 half.png turned.png
    done
    local size=0
    "$helper" constant 5 5 1 float 0.7 wanted.tif
    reproject --quiet --from peirce --to azimuthal:lambert:fov=80 --size 5 wanted.tif disc.tif
    for chart in $("$helper" charts); do
        for filter in nearest bilinear; do
            reproject --quiet --filter $filter --from "$chart" --to "$chart" noise.ppm same.tif
            reproject --quiet --filter $filter --from "$chart" --to "$chart" same.tif again.tif
            passes "$chart to the same, $filter: the same pixels" compare --max 0 same.tif again.tif
        done
        [ "$chart" != rhealpix ] || continue # no pixel of so few is on each of its squares
        size=$((size % 3 + 1))
        "$helper" constant $size $size 1 float 0.7 small.tif
        reproject --quiet --from "$chart" --to azimuthal:lambert:fov=80 --size 5 small.tif out.tif
        passes "$chart of $size pixels" compare --max 0 out.tif disc.tif
    done
}

# What is not on the map is black, and transparent if there is alpha.
chart_background()
{
    "$helper" constant 32 32 4 float 0.5 disc.tif
    reproject --quiet --from azimuthal:stereographic --size 16 --to equirect disc.tif half.tif
    reproject --quiet --from azimuthal:stereographic:lat=-90 --size 16 --to equirect disc.tif other.tif
    "$helper" constant 16 8 4 float 0.5 ones.tif
    compare half.tif ones.tif | grep -q '^mean absolute error  0.25$' &&
        compare other.tif ones.tif | grep -q '^mean absolute error  0.25$'
    result $? 'half of the sphere is transparent' "$(compare half.tif ones.tif)"
    "$helper" constant 64 32 4 uint8 1 white.png
    reproject --quiet --to azimuthal:lambert --size 100 white.png disc.png
    "$helper" constant 100 100 4 uint8 0 black.png
    # 7860 pixels of 10000 have their centres on the disc of radius 50
    compare disc.png black.png | grep -q '^mean absolute error  200.4'
    result $? 'beside a disc all is transparent' "$(compare disc.png black.png)"
    reproject --quiet --to azimuthal:lambert --size 64 --graticule 30 --grid 2 --indicatrices 3 white.png \
        lines.png
    reproject --quiet --to azimuthal:lambert --size 64 white.png plain.png
    passes 'lines over a disc' compare --max-mean 120 lines.png plain.png
    reproject --to azimuthal:lambert --size 64 --indicatrices 3 white.png lines.png | grep -q -v 'left out'
    result $? 'cells beside the disc are not missed'
}

# --- pixels ---------------------------------------------------------------------------------------

noise()
{
    python3 -c '
import random, sys
random.seed(1)
width, height = int(sys.argv[1]), int(sys.argv[2])
sys.stdout.buffer.write(b"P6 %d %d 255\n" % (width, height))
sys.stdout.buffer.write(bytes(random.randrange(256) for _ in range(3 * width * height)))' \
        "$1" "$2"
}

exactness()
{
    noise 256 128 >noise.ppm
    local filter
    for filter in nearest bilinear; do
        reproject --quiet --filter $filter --from equirect --to equirect noise.ppm same.png
        passes "same size, $filter: the same pixels" compare --max 0 noise.ppm same.png
    done
    reproject --quiet --size 100 --threads 1 noise.ppm one_%f.png
    reproject --quiet --size 100 --threads 3 noise.ppm three_%f.png
    reproject --quiet --size 100 --threads 16 noise.ppm many_%f.png
    local face
    for face in 0 1 2 3 4 5; do
        cmp -s one_$face.png three_$face.png && cmp -s one_$face.png many_$face.png
        result $? "the same bits from 1, 3 and 16 threads, face $face"
    done
    reproject --quiet --size 40 --filter nearest --layout strip noise.ppm strip.png
    reproject --quiet --size 40 --filter nearest --layout strip --from cube --to cube strip.png \
        strip-again.png
    passes 'cube to the same cube: the same pixels' compare --max 0 strip.png strip-again.png
}

# A constant image stays constant, to the last bit, in every type and number of channels.
constants()
{
    local channels type extension
    for channels in 1 2 3 4 5; do
        for type in uint8 uint16 half float; do
            extension=tif
            [ $type != half ] || extension=exr
            "$helper" constant 64 32 $channels $type 0.3 source.$extension
            "$helper" constant 96 16 $channels $type 0.3 strip.$extension
            reproject --quiet --layout strip source.$extension out.$extension
            reproject --quiet out.$extension back.$extension
            passes "constant, $channels channels, $type" compare --max 0 out.$extension \
                strip.$extension
            passes "constant and back, $channels channels, $type" compare --max 0 \
                back.$extension source.$extension
            "$helper" describe out.$extension | grep -q "96 x 16, $channels channels, $type"
            result $? "type and channels are kept, $channels channels, $type"
        done
    done
    "$helper" constant 64 32 4 float 1 source.tif
    reproject --quiet --layout cross source.tif cross.tif
    "$helper" describe cross.tif | grep -q '64 x 48, 4 channels, float'
    result $? 'size of a cross'
    python3 - <<'P'
width = 8
with open("red.ppm", "wb") as file:
    file.write(b"P6 8 4 255\n" + b"\xff\x00\x00" * 32)
P
    reproject --quiet --layout cross red.ppm cross.png
    "$helper" constant 8 6 3 uint8 0 black.png
    compare cross.png black.png | grep -q 'mean absolute error  42.5 grey'
    result $? 'the corners of a cross are 0' # 255 in half of the pixels, one channel of three
}

formats()
{
    "$helper" constant 64 32 3 float 0.5 source.exr
    local extension
    for extension in png jpg tif exr hdr PNG; do
        passes "to .$extension" reproject --quiet --size 16 source.exr "cube_%f.$extension"
        passes "from .$extension" reproject --quiet "cube_%f.$extension" back.exr
        passes "through .$extension" compare --max 0.006 source.exr back.exr
    done
    "$helper" constant 64 32 4 uint8 0.5 alpha.png
    passes 'JPEG has no alpha' reproject alpha.png 'cube_%f.jpg'
    grep -q 'without alpha' out.txt
    result $? 'and the program says so'
    "$helper" constant 64 32 4 uint8 0.5 alpha.png oiio:UnassociatedAlpha=1
    passes 'alpha from PNG to EXR' reproject alpha.png half.exr --to equirect
    "$helper" describe half.exr | grep -q '4 channels, half'
    result $? 'is kept'
}

metadata()
{
    "$helper" constant 64 32 3 uint8 0.5 source.jpg Copyright=Somebody Orientation=3 \
        XResolution=300 'GPano:ProjectionType=equirectangular' Exif:PixelXDimension=64
    reproject --quiet source.jpg 'face_%f.tif'
    "$helper" describe face_5.tif >description.txt
    grep -q 'Copyright=Somebody' description.txt
    result $? 'copyright is kept' "$(cat description.txt)"
    ! grep -q -E 'GPano|PixelXDimension|XResolution=300|Orientation=3' description.txt
    result $? 'what no longer holds is not' "$(cat description.txt)"
    # Turned upside down by its orientation: 180 degrees.
    noise 32 16 >noise.ppm
    reproject --quiet --from equirect --to equirect noise.ppm plain.png
    python3 - <<'P'
import struct
pixels = open("noise.ppm", "rb").read()[-32 * 16 * 3:]
turned = b"".join(pixels[i:i + 3] for i in range(len(pixels) - 3, -1, -3))
tags = [(256, 3, 1, 32), (257, 3, 1, 16), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 2),
        (273, 4, 1, 8), (274, 3, 1, 3), (277, 3, 1, 3), (278, 3, 1, 16), (279, 4, 1, len(turned))]
with open("turned.tif", "wb") as file:
    file.write(struct.pack("<2sHI", b"II", 42, 8 + len(turned)) + turned)
    file.write(struct.pack("<H", len(tags)))
    for tag in tags:
        file.write(struct.pack("<HHII", *tag))
    file.write(struct.pack("<I", 0))
P
    reproject --quiet --from equirect --to equirect turned.tif upright.png
    passes 'orientation is applied' compare --max 0 plain.png upright.png
}

golden()
{
    local source=$root/tests/programs/golden/earth-64.png
    reproject --quiet --size 16 --layout cross "$source" cross.png
    passes 'golden: cross of the Earth' compare --max 1 cross.png \
        "$root/tests/programs/golden/earth-cross-16.png"
    reproject --quiet --size 64 "$root/tests/programs/golden/earth-cross-16.png" back.png
    passes 'golden: and back' compare --max 1 back.png "$root/tests/programs/golden/earth-back-64.png"
    reproject --quiet --size 16 --frame gl --to cube:tangent --layout strip "$source" strip.png
    passes 'golden: strip in frame gl' compare --max 1 strip.png \
        "$root/tests/programs/golden/earth-strip-gl-16.png"
}

# --- the command line -----------------------------------------------------------------------------

talk()
{
    noise 64 32 >noise.ppm
    reproject noise.ppm 'face_%f.png' >out.txt
    local wanted='noise.ppm (equirect 64x32, 3 channels, uint8) -> '
    wanted+='face_0.png .. face_5.png (cube:coupled, frame geo, 16x16)'
    [ "$(cat out.txt)" = "$wanted" ]
    result $? 'says what it did' "$(cat out.txt)"
    [ "$(reproject --quiet noise.ppm face.png 2>&1)" = '' ] && [ -e face_3.png ]
    result $? 'quiet; a name without %f gets _0 to _5'
    [ "$(reproject --to peirce noise.ppm peirce.png | sed 's/.*-> //')" = 'peirce.png (peirce 36x36)' ] &&
        [ "$(reproject --from peirce peirce.png back.png)" = \
            'peirce.png (peirce 36x36, 3 channels, uint8) -> back.png (equirect 64x32)' ]
    result $? 'resolution of a square stays in the mean'
    [ "$(reproject --to azimuthal:lambert noise.ppm disc.png | sed 's/.*-> //')" = \
        'disc.png (azimuthal:lambert 29x29)' ]
    result $? 'resolution of a disc stays in the mean'
    reproject --help | grep -q 'Usage: cubemap-reproject' && compare --help | grep -q Usage
    result $? help
    reproject --version | grep -q -E '^cubemap-reproject [0-9]+\.[0-9]+\.[0-9]+$' &&
        compare --version | grep -q -E '^cubemap-compare [0-9]'
    result $? version
    reproject --help >/dev/full 2>err.txt
    [ $? -eq 1 ] && grep -q 'standard output' err.txt
    result $? 'help to a full device'
    python3 - "$programs/cubemap-reproject" >pty.txt <<'P'
import os, pty, sys
try:
    os.close(pty.openpty()[0])
except OSError:  # as in a change-root without devpts
    print("none")
    sys.exit()
for arguments in ([], ["--quiet"]):
    output = b""
    child, terminal = pty.fork()
    if child == 0:
        os.execv(sys.argv[1], [sys.argv[1], "noise.ppm", "face_%f.png"] + arguments)
    try:
        while True:
            data = os.read(terminal, 4096)
            if not data:
                break
            output += data
    except OSError:
        pass
    os.waitpid(child, 0)
    print("bar" if b"%" in output.replace(b"%f", b"") else "no bar")
P
    if [ "$(cat pty.txt)" = none ]; then
        echo "skipped: there is no terminal to be had for the progress bar"
    else
        [ "$(cat pty.txt)" = $'bar\nno bar' ]
        result $? 'a progress bar on a terminal, unless --quiet' "$(cat pty.txt)"
    fi
    cp noise.ppm -- -dash.ppm
    passes 'names that begin with a dash' reproject --quiet -- -dash.ppm -dash.png
    mkdir -p 'a folder'
    passes 'blanks in names' reproject --quiet --layout=cross noise.ppm 'a folder/the cross.png'
    echo old >old.png
    chmod 640 old.png
    ln -s old.png link.png
    reproject --quiet --layout strip noise.ppm link.png
    [ -L link.png ] && [ "$(stat -c %a old.png)" = 640 ] && compare --quiet old.png link.png
    result $? 'a link is followed, permissions are kept'
}

bad_arguments()
{
    noise 64 32 >noise.ppm
    noise 60 30 >other.ppm
    noise 50 30 >odd.ppm
    cp noise.ppm '%f.ppm'
    fails 'no names' 2 'INPUT and OUTPUT' reproject
    fails 'one name' 2 'INPUT and OUTPUT' reproject noise.ppm
    fails 'three names' 2 'INPUT and OUTPUT' reproject noise.ppm made/a.png made/b.png
    fails 'unknown option' 2 "'--sise'" reproject --sise 5 noise.ppm made/a.png
    fails 'missing value' 2 '--size needs a value' reproject noise.ppm made/a.png --size
    fails 'value too many' 2 '--quiet takes no value' reproject --quiet=1 noise.ppm made/a.png
    local size
    for size in 0 -1 -999999999999 1e3 0x10 '' ' 5' 5x 99999999999999999999 262145; do
        fails "size '$size'" 2 '--size: .* is not a whole number from 1 to' \
            reproject --size "$size" noise.ppm made/a.png
    done
    fails 'size of a face too large' 2 'may be 65536 at most' \
        reproject --size 65537 noise.ppm made/a.png
    fails 'odd width' 2 'must be even' reproject --to equirect --size 7 noise.ppm made/a.png
    fails 'unknown projection' 2 'not equirect, cube or cube:MAPPING' \
        reproject --to mercator noise.ppm made/a.png
    fails 'a mapping of one face as a cube' 2 "say peirce" reproject --to cube:peirce noise.ppm made/a.png
    fails 'a mapping of the cube alone' 2 'say cube:qsc' reproject --to qsc noise.ppm made/a.png
    fails 'no sphere' 2 'joins disc and square' reproject --from square:radial noise.ppm made/a.png
    fails 'azimuthal of what' 2 "after 'azimuthal:' comes" reproject --to azimuthal:x noise.ppm made/a.png
    fails 'field of view out of range' 2 'it must be in' \
        reproject --to azimuthal:gnomonic:fov=180 noise.ppm made/a.png
    fails 'a chart that is not square' 1 '64 x 32; an image in peirce must be square' \
        reproject --from peirce noise.ppm made/a.png
    fails 'layout of one face' 2 '--layout is for a cube, but OUTPUT is octahedral' \
        reproject --to octahedral --layout strip noise.ppm made/a.png
    fails 'layout of one face in' 2 '--from-layout is for a cube, but --from says octahedral' \
        reproject --from octahedral --from-layout strip noise.ppm made/a.png
    fails 'size of a chart too large' 2 'square image may be 65536 at most' \
        reproject --to peirce --size 65537 noise.ppm made/a.png
    fails 'unknown mapping' 2 'nonesuch' reproject --to cube:nonesuch noise.ppm made/a.png
    fails 'parameter out of range' 2 '4' reproject --to cube:tangent:c=5 noise.ppm made/a.png
    fails 'parameter not a number' 2 '--to: ' reproject --to cube:tangent:c=x noise.ppm made/a.png
    fails 'unknown parameter' 2 '--from: ' reproject --from cube:qsc:c=1 noise.ppm made/a.png
    fails 'empty mapping' 2 '--to: ' reproject --to cube: noise.ppm made/a.png
    fails 'unknown layout' 2 'faces, strip or cross' reproject --layout row noise.ppm made/a.png
    fails 'instruction set that is none' 1 "'abacus', but here it can be scalar" \
        env CUBEMAP_INSTRUCTIONS=abacus "$programs/cubemap-reproject" noise.ppm made/a.png
    fails 'a column that is none' 2 'columns from 0 to 3' \
        reproject --layout cross:north=4,south=0 noise.ppm made/a.png
    fails 'columns of a strip' 2 'faces, strip or cross' \
        reproject --layout strip:north=1,south=0 noise.ppm made/a.png
    fails 'unknown frame' 2 'geo, gl, fits or s2' reproject --frame east noise.ppm made/a.png
    fails 'unknown filter' 2 'nearest or bilinear' reproject --filter cubic noise.ppm made/a.png
    fails 'negative threads' 2 '--threads' reproject --threads -1 noise.ppm made/a.png
    fails 'layout of no cube' 2 '--layout is for a cube' \
        reproject --to equirect --layout strip noise.ppm made/a.png
    fails 'layout of no cube in' 2 '--from-layout is for a cube' \
        reproject --from equirect --from-layout strip noise.ppm made/a.png
    fails 'six names for one picture' 2 '%f' reproject --layout strip noise.ppm made/%f.png
    fails 'no extension' 2 'must end in' reproject noise.ppm made/a
    fails 'unknown extension' 2 'must end in' reproject noise.ppm made/a.docx
    fails 'an extension that is no format' 2 'must end in' reproject noise.ppm made/a.null
    fails 'output is input' 2 'same file' reproject --from equirect --to equirect noise.ppm \
        ./noise.ppm
    cp noise.ppm a.png
    fails 'output is input by a link' 2 'same file' \
        sh -c "ln -sf a.png b.png; '$programs/cubemap-reproject' --layout strip a.png b.png"
    fails 'neither shape' 1 '50 x 30.*neither' reproject odd.ppm made/a.png
    fails 'strip of the wrong shape' 1 'must be 6N x N' \
        reproject --from-layout strip noise.ppm made/a.png
    fails 'cross of the wrong shape' 1 'must be 4N x 3N' \
        reproject --from cube --from-layout cross noise.ppm made/a.png
    fails 'no cube' 1 'a cube must be' reproject --from cube noise.ppm made/a.png
    fails 'compare: one name' 2 'two images' compare noise.ppm
    fails 'compare: bad limit' 2 'not a number of 0 or more' \
        compare --max-rmse nan noise.ppm noise.ppm
    fails 'compare: unknown option' 2 "'--rmse'" compare --rmse 1 noise.ppm noise.ppm
    fails 'compare: sizes' 1 'must be alike' compare noise.ppm other.ppm
    fails 'compare: no such file' 1 'No such file' compare noise.ppm none.ppm
}

comparison()
{
    "$helper" constant 4 2 3 uint8 0.2 a.png
    "$helper" constant 4 2 3 uint8 0.4 b.png
    passes 'compare: the same' compare a.png a.png
    grep -q 'PSNR  *inf dB' out.txt && grep -q '^maximum  *0 grey levels of 8 bits$' out.txt
    result $? 'compare: no error' "$(cat out.txt)"
    passes 'compare: at the limit' compare --max-mean 51.001 --max-rmse 51.001 a.png b.png
    grep -q '^RMSE  *51 grey' out.txt
    result $? 'compare: grey levels' "$(cat out.txt)"
    fails 'compare: above the limit of RMSE' 1 'above the limit' \
        compare --quiet --max-rmse 50.9 a.png b.png
    fails 'compare: above the limit of the mean' 1 'above the limit' \
        compare --quiet --max-mean 50.9 a.png b.png
    "$helper" constant 4 2 1 float nan nan.tif
    "$helper" constant 4 2 1 float inf inf.tif
    "$helper" constant 4 2 1 float 1 one.tif
    passes 'compare: NaN with NaN' compare --max 0 nan.tif nan.tif
    passes 'compare: inf with inf' compare --max 0 inf.tif inf.tif
    fails 'compare: NaN with 1' 1 'inf, above' compare --quiet --max-rmse 1e30 nan.tif one.tif
    fails 'compare: inf with NaN' 1 'inf, above' compare --quiet --max-mean 1e30 inf.tif nan.tif
}

# --- bad input ------------------------------------------------------------------------------------

bad_input()
{
    fails 'no such file' 1 'No such file' reproject none.png made/a.png
    mkdir folder.png
    fails 'a folder' 1 'is a folder' reproject folder.png made/a.png
    : >empty.png
    fails 'an empty file' 1 'is empty' reproject empty.png made/a.png
    echo 'this is not an image' >text.png
    fails 'not an image' 1 "'text.png' is not an image" reproject text.png made/a.png
    head -c 5000 /dev/urandom >random.jpg
    fails 'random bytes' 1 "'random.jpg' is not an image" reproject random.jpg made/a.png
    printf 'P6 0 0 255\n' >zero.ppm
    fails 'zero size' 1 "'zero.ppm' (is not an image|has no pixels)" reproject zero.ppm made/a.png
    noise 512 256 >noise.ppm
    fails 'no such face' 1 "'none_0.png'.*No such file" reproject none_%f.png made/a.png
    local extension part size
    for extension in png jpg tif exr hdr; do
        reproject --quiet --from equirect --to equirect noise.ppm whole.$extension
        size=$(stat -c %s whole.$extension)
        for part in 10 $((size / 3)) $((size - 40)); do
            head -c $part whole.$extension >part.$extension
            fails "$extension of $size bytes that ends after $part" 1 "'part.$extension'" \
                reproject part.$extension made/a.png
            fails "compare: $extension that ends after $part" 1 "'part.$extension'" \
                compare part.$extension whole.$extension
        done
    done
    head -c $(($(stat -c %s whole.png) - 3)) whole.png >part.png
    fails 'png without its last bytes' 1 "'part.png'" reproject part.png made/a.png
    head -c $(($(stat -c %s whole.jpg) - 2)) whole.jpg >part.jpg
    fails 'jpg without its last bytes' 1 "'part.jpg'" reproject part.jpg made/a.png
    head -c 1000 noise.ppm >part.ppm
    fails 'ppm that ends early' 1 "'part.ppm'" reproject part.ppm made/a.png
    local type
    for type in half float; do
        "$helper" constant 8 4 3 $type nan nan.exr
        fails "NaN, $type" 1 "'nan.exr' has a NaN at x = 0, y = 0, channel R" \
            reproject nan.exr made/a.png
        fails "NaN, $type, nearest" 1 'has a NaN' \
            reproject --filter nearest nan.exr made/a.png
        "$helper" constant 8 4 3 $type inf inf.exr
        fails "infinity, $type" 1 'has an infinite value' reproject inf.exr made/a.exr
    done
    passes 'infinity, nearest' reproject --quiet --filter nearest inf.exr out.exr
    local face
    for face in 0 1 2 3 4 5; do
        noise 16 16 >face_$face.ppm
    done
    noise 16 8 >face_3.ppm
    fails 'a face that is not square' 1 "'face_3.ppm' is 16 x 8.*square" \
        reproject face_%f.ppm made/a.png
    noise 8 8 >face_3.ppm
    fails 'a face of another size' 1 "'face_3.ppm' is 8 x 8.*alike" \
        reproject face_%f.ppm made/a.png
    "$helper" constant 8 4 5 float 0.5 five.tif
    fails 'five channels to PNG' 1 'PNG holds' reproject five.tif made/a.png
    fails 'five channels to JPEG' 1 'JPEG holds' reproject five.tif made/a.jpg
    fails 'five channels to HDR' 1 'HDR holds' reproject five.tif made/a.hdr
    python3 - <<'P'
import struct, zlib
def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
with open("huge.png", "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 900000, 450000, 16, 6,
               0, 0, 0)) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b""))
P
    fails 'an image larger than the memory' 1 "'huge.png'" reproject huge.png made/a.png
}

bad_output()
{
    noise 512 256 >noise.ppm
    fails 'no such folder' 1 "'nowhere.*No such file" reproject noise.ppm nowhere/a.png
    fails 'a folder that is a file' 1 'Not a directory' reproject noise.ppm noise.ppm/a.png
    mkdir folder.png
    fails 'output is a folder' 1 'is a folder' reproject --layout strip noise.ppm folder.png
    ln -s /dev/full full.png
    fails 'output is a device' 1 'is not a file|not a file' \
        reproject --layout strip noise.ppm full.png
    mkdir made locked
    chmod a-w locked
    if [ "$(id -u)" -ne 0 ]; then
        fails 'a folder without the right to write' 1 'Permission denied' \
            reproject noise.ppm locked/a.png
    fi
    local extension
    for extension in png jpg tif exr hdr; do
        fails "limit on the size of files, $extension" 1 'File too large' \
            bash -c "ulimit -f 8; exec '$programs/cubemap-reproject' --layout strip noise.ppm \
            made/a.$extension"
        fails "limit on the size of files, six of $extension" 1 'File too large' \
            bash -c "ulimit -f 4; exec '$programs/cubemap-reproject' noise.ppm \
            made/%f.$extension"
    done
    mkdir -p kept
    echo old >kept/a.png
    (
        ulimit -f 8
        reproject --layout strip noise.ppm kept/a.png 2>/dev/null
    )
    [ "$(cat kept/a.png)" = old ] && [ "$(ls -A kept)" = a.png ]
    result $? 'an older file is kept when the new one fails'
    # The last of six names is taken by a folder: none may appear.
    mkdir -p six/face_5.png
    reproject --quiet noise.ppm six/face_%f.png 2>err.txt
    [ $? -eq 1 ] && [ "$(ls -A six)" = face_5.png ]
    result $? 'six files or none' "$(cat err.txt; ls -A six)"
}

signals()
{
    "$helper" constant 2048 1024 3 float 0.5 source.exr
    local signal
    for signal in INT TERM HUP; do
        mkdir made
        # From Python, as a shell starts what runs in its background with SIGINT ignored.
        python3 - "$signal" "$programs/cubemap-reproject" <<'P'
import os, signal, subprocess, sys, time
number = getattr(signal, "SIG" + sys.argv[1])
child = subprocess.Popen([sys.argv[2], "--size", "6000", "source.exr", "made/%f.tif"],
                         preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))
for _ in range(600):
    if len(os.listdir("made")) == 6 or child.poll() is not None:
        break
    time.sleep(0.01)
time.sleep(0.2)
running = child.poll() is None
child.send_signal(number)
sys.exit(0 if child.wait() == -number and running else 1)
P
        local status=$?
        [ $status -eq 0 ] && [ -z "$(ls -A made)" ]
        result $? "SIG$signal leaves nothing behind" "status $status; left: $(ls -A made)"
        rm -rf made
    done
}

subjects="several_mappings every_frame odd_sizes cube_to_cube charts chart_borders chart_background exactness constants formats metadata
    golden talk comparison bad_arguments bad_input bad_output signals"
if [ $# -gt 3 ]; then
    shift 3
    subjects=$*
fi
for subject in $subjects; do
    in_fresh_folder "$subject"
done
finish
