#!/bin/bash
# SPDX-License-Identifier: MIT
#
# distortion.sh PROGRAMS ROOT DIRECTION_IMAGE PICTURE_PIXELS [SUBJECT...]: tests cubemap-distortion, and
# the lines of cubemap-reproject, in the folder PROGRAMS from the outside. ROOT is the top of the source
# tree, then come the programs made of direction_image.cpp and picture_pixels.cpp; the subjects are
# those at the end of this file (without them, all). A line a case, "ok N - NAME" or "not ok N - NAME"; exit
# status 1 if any is not.

set -u
here=$(cd "$(dirname "$0")" && pwd)
programs=$(cd "$1" && pwd)
root=$(cd "$2" && pwd)
helper=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
pixels=$(cd "$(dirname "$4")" && pwd)/$(basename "$4")
# shellcheck source-path=SCRIPTDIR source=cases.sh
. "$here/cases.sh" "$programs"

distortion()
{
    "$programs/cubemap-distortion" "$@"
}

reproject()
{
    "$programs/cubemap-reproject" "$@"
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

# holds NAME CHECK [ARGUMENT...]: a check of distortion_checks.py.
holds()
{
    local name=$1
    shift
    passes "$name" python3 "$root/tests/programs/distortion_checks.py" "$pixels" "$@"
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
        grep -q -E -e "^cubemap-(distortion|reproject): .*($words)" err.txt &&
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

quantities='area isotropy deformation scale texel-aspect texel-area'

# --- values ---------------------------------------------------------------------------------------

closed_forms()
{
    local quantity
    for quantity in $quantities; do
        passes "gnomonic, $quantity" distortion --quiet -m gnomonic --quantity "$quantity" --values \
            --face 2 --size 65 values.tif
        holds "gnomonic, $quantity, closed form" gnomonic "$quantity" values.tif
    done
    distortion --quiet -m gnomonic --quantity isotropy --values --face 0 --size 2000 values.exr
    holds 'the corner of gnomonic: root 3' pixel values.exr 1999 0 1.7316
    for quantity in area scale; do
        distortion --quiet -m qsc --quantity $quantity --values --face 4 --size 64 qsc.tif
    done
    holds 'the scale of an equal-area map: 6/pi' pixel qsc.tif 3 60 1.909859
}

differences()
{
    local mapping frame quantity turn=0
    for mapping in $("$helper" mappings | awk 'NR % 3 == 2 || /^(arvo|conformal|healpix)$/'); do
        frame=$(printf 'geo\ngl\nfits\ns2\n' | sed -n $((turn % 4 + 1))p)
        turn=$((turn + 1))
        for quantity in area isotropy texel-aspect texel-area; do # the others follow from these
            distortion --quiet -m "$mapping" --frame "$frame" --quantity "$quantity" --values \
                --layout strip --size 16 "$mapping-$quantity.tif"
        done
        holds "$mapping, $frame: as cubemap-project has it" differences \
            "$programs/cubemap-project" "$mapping" "$frame" "$mapping-QUANTITY.tif"
    done
}

# --- colours --------------------------------------------------------------------------------------

colors()
{
    local custom=sequential-single:hue=140
    distortion --quiet -m gnomonic --values --face 0 --size 40 area.tif
    distortion --quiet -m gnomonic --face 0 --size 40 area.png
    holds 'area: a quarter and four are equally far from one' colors diverging-lightness 0.25 4 1 \
        area.tif area.png
    distortion --quiet -m gnomonic --face 0 --size 40 --range 0.8:2 --colors diverging-saturation \
        range.png
    holds 'a range that is not symmetric keeps its middle' colors diverging-saturation 0.8 2 1 \
        area.tif range.png
    distortion --quiet -m gnomonic --quantity isotropy --values --face 0 --size 40 isotropy.tif
    distortion --quiet -m gnomonic --quantity isotropy --face 0 --size 40 isotropy.png
    holds 'isotropy: light at one' colors sequential-custom 1 2 0 isotropy.tif isotropy.png
    distortion --quiet -m gnomonic --quantity isotropy --face 0 --size 40 --range 1.1:1.5 --reverse \
        --colors "$custom" reverse.png
    holds 'reversed, with a map and a range of one'"'s"' own' colors "$custom" 1.1 1.5 0 \
        isotropy.tif reverse.png yes
    distortion --quiet -m qsc --face 3 --size 40 --colors diverging-saturation qsc.png
    local middle
    middle=$(echo 0.5 | "$pixels" colors diverging-saturation)
    # unquoted: three numbers
    # shellcheck disable=SC2086
    holds 'an equal-area map has one colour' uniform qsc.png $middle
    distortion --quiet -m qsc --face 3 --size 40 --colors diverging-saturation --isolines 0.5 qsc.png
    # shellcheck disable=SC2086
    holds 'and no isolines' uniform qsc.png $middle
    distortion --quiet -m gnomonic --face 0 --size 501 --isolines 0.25 --line-width 4 \
        --line-color ff0000 isolines.png
    holds 'isolines where they should be' isolines isolines.png 0.25
    local mapping
    for mapping in tangent qsc; do
        distortion --quiet -m $mapping --quantity deformation --face 0 --size 61 --isolines 5 \
            --grid 4 symmetric.png
        holds "symmetric, $mapping" symmetric symmetric.png 1
    done
    distortion --quiet -m outerra --indicatrices 5 --face 0 --size 200 symmetric.png
    holds 'symmetric ellipses' symmetric symmetric.png 1
}

talk()
{
    # (1 + r^2)^1.5 < 6/pi up to r = 0.7344: pi r^2 / 4 of the face
    distortion -m gnomonic --range 1:4 --size 500 area.png >out.txt
    grep -q '42\.4 % of the map is below 1 and has its colour' out.txt &&
        grep -q 'area (D_A): 0\.5236[0-9]* to 2\.7[0-9]* at' out.txt
    result $? 'says what is beyond the colours, and the extremes' "$(cat out.txt)"
    [ "$(wc -l <out.txt)" -eq 1 ] && ! distortion -m qsc --size 8 area.png | grep -q 'of the map'
    result $? 'and nothing where nothing is'
    distortion -m tangent --size 8 --colors sequential-single:saturation=5 area.png >out.txt
    grep -q '% are outside sRGB and cut to it' out.txt
    result $? 'says which colours are cut' "$(cat out.txt)"
    # over the means of a disc and of a square: (1 + r^2)^2 / 2, and 1
    distortion -m azimuthal:stereographic --size 200 disc.png >out.txt
    grep -q '^azimuthal:stereographic, area (D_A): 0\.5000[0-9]* to 1\.99[0-9]* at .*(200x200)$' out.txt
    result $? 'areas of a disc, over their mean' "$(cat out.txt)"
    distortion -m octahedral:clarberg --size 100 square.png >out.txt
    grep -q '^octahedral:clarberg, area (D_A): 1 to 1 at' out.txt
    result $? 'areas of a square' "$(cat out.txt)"
    distortion -m azimuthal:lambert --quantity scale --size 50 disc.png >out.txt
    grep -q 'scale (s): 0\.5 to 0\.5 at .*0\.125 to 2, logarithmic about 0\.5 ' out.txt
    result $? 'the scale of a disc' "$(cat out.txt)"
    distortion -m peirce --quantity texel-area --size 64 square.png >out.txt
    grep -q 'texel-area (L_x L_y): 0\.00[0-9]* to 2\.18[0-9]* at' out.txt
    result $? 'texels of a square' "$(cat out.txt)"
    local extension
    for extension in png jpg tif; do
        distortion --quiet -m gnomonic --range 1:4 --size 32 area.$extension
        "$helper" describe area.$extension >description.txt
        grep -q 'ImageDescription=gnomonic, frame geo, area (D_A): 0.5.*, 1 to 4, .*is below 1' \
            description.txt && grep -q 'uint8' description.txt
        result $? "metadata, $extension" "$(cat description.txt)"
    done
    distortion --quiet --values --size 32 area.exr
    "$helper" describe area.exr >description.txt
    grep -q 'ImageDescription=coupled, frame geo, area' description.txt &&
        grep -q '128 x 96, 1 channels, float' description.txt
    result $? 'metadata of values' "$(cat description.txt)"
    [ "$(distortion --quiet --size 8 area.png 2>&1)" = '' ]
    result $? quiet
    distortion --help | grep -q 'Usage: cubemap-distortion' &&
        distortion --version | grep -q -E '^cubemap-distortion [0-9]+\.[0-9]+\.[0-9]+$'
    result $? 'help and version'
    passes 'faces' distortion --layout faces --size 8 'f%f.png'
    [ -e f0.png ] && [ -e f5.png ] && grep -q 'f0.png .. f5.png (8x8)' out.txt
    result $? 'are six files' "$(cat out.txt)"
    passes 'a legend' distortion --size 8 --legend legend.png area.png
    "$helper" describe legend.png | grep -q '520 x 62, 3 channels'
    result $? 'has its size'
    distortion --quiet --size 8 --range 1:4 --colors diverging-saturation --legend legend.tif area.png
    local end
    end=$(printf 0.50056 | "$pixels" colors diverging-saturation)
    # shellcheck disable=SC2086
    set -- $end
    holds 'the left end of the strip' pixel legend.tif 36 15 "$(near "$1")" "$(near "$2")" "$(near "$3")"
    local threads
    distortion --quiet --size 100 --isolines 0.1 --graticule 15 --threads 1 one.png
    for threads in 2 7; do
        distortion --quiet --size 100 --isolines 0.1 --graticule 15 --threads $threads many.png
        cmp -s one.png many.png
        result $? "the same bits from 1 and $threads threads"
    done
}

# near NUMBER: as 8 bits hold it
near()
{
    python3 -c 'import sys; print(round(255 * float(sys.argv[1])) / 255)' "$1"
}

sizes()
{
    local size
    for size in 1 2 3 4097; do
        passes "$size pixels" distortion --face 1 --size $size --isolines 0.1 --grid 2 --graticule 30 \
            --indicatrices 3 face.tif
        "$helper" describe face.tif | grep -q "^$size x $size, 3 channels"
        result $? "are $size pixels"
    done
    passes 'smoothstep with its singular edge' distortion -m smoothstep:c=1 --quantity isotropy \
        --isolines 1 --grid 3 --indicatrices 3 --size 65 face.tif
    holds 'no NaN' finite face.tif
}

# --- ellipses -------------------------------------------------------------------------------------

# Lines 2 wide on black, in one channel.
on_black()
{
    reproject --quiet --line-width 2 "$@"
}

ellipses()
{
    "$helper" constant 720 360 1 float 0 black.tif
    on_black --to cube:gnomonic --size 600 --indicatrices 3 --indicatrices-radius 9 black.tif face.tif
    holds 'gnomonic: area, axes and directions of ellipses' gnomonic_ellipses face_0.tif 3 9
    holds 'gnomonic: the same around the pole' gnomonic_ellipses face_4.tif 3 9
    on_black --to cube:gnomonic --frame gl --size 600 --indicatrices 3 --indicatrices-radius 9 \
        black.tif face.tif
    holds 'gnomonic: the same in frame gl' gnomonic_ellipses face_2.tif 3 9
    on_black --to cube:outerra --size 700 --indicatrices 5 black.tif face.tif
    holds 'outerra: a circle in the middle' circle face_1.tif 5
    reproject --quiet --from equirect --to cube:gnomonic --size 90 black.tif flat.tif
    reproject --quiet --from cube:gnomonic --to equirect --size 1440 --line-width 2 --indicatrices 3 \
        --indicatrices-radius 9 flat_%f.tif back.tif
    holds 'equirectangular: ellipses, and over the antimeridian' equirect_ellipses back.tif 9
    local cells left
    for cells in 1 2 3 4 5 7; do
        left=$((6 * cells * cells - cells % 2 * 2))
        reproject --quiet --from equirect --to equirect --size 800 --indicatrices $cells \
            --line-width 0.1 black.tif count.tif
        holds "equirectangular: $left ellipses apart" count count.tif $left
        reproject --quiet --from equirect --to cube:continuous --layout strip --size 100 \
            --indicatrices $cells --line-width 0.1 black.tif count.tif
        holds "cube: $((6 * cells * cells)) ellipses apart" count count.tif $((6 * cells * cells))
    done
    reproject --from equirect --to equirect --size 800 --indicatrices 3 black.tif out.tif |
        grep -q 'ellipses of circles of [0-9.]* degrees, 2 at poles left out'
    result $? 'says the radius, and what is left out'
}

# --- lines ----------------------------------------------------------------------------------------

lines()
{
    "$helper" constant 720 360 1 float 0.5 grey.tif
    "$helper" constant 720 360 1 float 0 black.tif
    on_black --from equirect --to equirect --graticule 30 grey.tif graticule.tif
    holds 'equirectangular graticule, pixel by pixel' equirect_graticule graticule.tif grey.tif
    on_black --to cube:gnomonic --layout cross --size 400 --graticule 15 black.tif cross.tif
    holds 'graticule on a cube, its edges and poles' cube_graticule cross.tif
    on_black --to cube:gnomonic --size 401 --graticule 15 black.tif odd.tif
    holds 'a pixel on the pole' pixel odd_4.tif 200 200 1
    holds 'and on the other' pixel odd_5.tif 200 200 1
    reproject --quiet --to cube:gnomonic --size 60 black.tif flat.tif
    on_black --from cube:gnomonic --to equirect --size 720 --grid 3 flat_%f.tif grid.tif
    holds 'grid of a cube over an equirectangular image' equirect_grid grid.tif
    local mapping
    for mapping in gnomonic qsc cobe healpix; do
        on_black --to cube:$mapping --size 240 --grid 6 black.tif grid.tif
        holds "grid of $mapping" cube_grid grid_1.tif 6
        holds "grid of $mapping, top" cube_grid grid_4.tif 6
    done
}

pixel_types()
{
    "$helper" constant 64 32 4 uint8 0.2 alpha.png oiio:UnassociatedAlpha=1
    "$helper" constant 64 32 4 half 0.2 alpha.exr
    "$helper" constant 64 32 5 float 0.2 five.tif
    "$helper" constant 64 32 3 uint16 0.2 sixteen.png
    "$helper" constant 64 32 3 half inf inf.exr
    local lines='--from equirect --to equirect --graticule 90 --line-width 2'
    # shellcheck disable=SC2086 # a list of words
    {
        reproject --quiet $lines --line-color ff8000 alpha.png out.png
        reproject --quiet $lines --line-color ff8000 alpha.exr out.exr
        reproject --quiet $lines --line-color ff8000 five.tif out.tif
        reproject --quiet $lines sixteen.png sixteen-out.png
        reproject --quiet $lines --filter nearest inf.exr inf-out.exr
    }
    holds 'alpha, not multiplied: the line is opaque' pixel out.png 16 8 1 0.50196 0 1
    holds 'alpha, multiplied: the line is opaque' pixel out.exr 16 8 1 0.50196 0 1
    holds 'alpha: the rest as it was' pixel out.exr 8 8 0.2 0.2 0.2 0.2
    holds 'five channels, one of them alpha: the fifth stays as it is' pixel out.tif 16 8 1 0.50196 0 1 0.2
    holds '16 bits' pixel sixteen-out.png 16 8 1 1 1
    holds 'infinities: no NaN beside lines' finite inf-out.exr
    "$helper" constant 64 32 1 float 0.2 one.tif
    # shellcheck disable=SC2086
    reproject --quiet $lines --line-color ff0000 one.tif one-out.tif
    holds 'one channel: luminance' pixel one-out.tif 16 8 0.2126
    # 0.6 black over alpha 0.2: alpha 0.68, and colour 0.2 * 0.08 / 0.68
    holds 'casing over alpha, not multiplied' pixel out.png 17 8 0.0235 0.0235 0.0235 0.6784
    holds 'casing over alpha, multiplied' pixel out.exr 17 8 0.08 0.08 0.08 0.68
}

# --- what is wrong ----------------------------------------------------------------------------------

bad_arguments()
{
    fails 'no name' 2 'OUTPUT is needed' distortion
    fails 'two names' 2 'OUTPUT is needed, 2' distortion made/a.png made/b.png
    fails 'unknown option' 2 "'--sise'" distortion --sise 5 made/a.png
    fails 'missing value' 2 '--size needs a value' distortion made/a.png --size
    fails 'value too many' 2 '--values takes no value' distortion --values=1 made/a.tif
    fails 'layout of one face' 2 '--layout is for the six faces' \
        distortion -m peirce --layout cross made/a.png
    fails 'frame of one face' 2 '--frame is for the six faces' distortion -m peirce --frame gl made/a.png
    fails 'face 1 of one' 2 '--face is for the six faces' distortion -m peirce --face 1 made/a.png
    fails 'no sphere' 2 'joins disc and square' distortion -m square:radial made/a.png
    fails 'unknown mapping' 2 '-m: .*nonesuch' distortion -m nonesuch made/a.png
    fails 'parameter out of range' 2 '--mapping: ' distortion --mapping tangent:c=5 made/a.png
    fails 'unknown frame' 2 'geo, gl, fits or s2' distortion --frame east made/a.png
    fails 'unknown quantity' 2 'area, isotropy, .* or texel-area' distortion --quantity shape made/a.png
    fails 'unknown layout' 2 'faces, strip or cross' distortion --layout row made/a.png
    fails 'face that is none' 2 '--face: .* 0 to 5' distortion --face 6 made/a.png
    fails 'face and layout' 2 '--face is for' distortion --face 1 --layout cross made/a.png
    local value
    for value in 0 -1 65537 1e3 ''; do
        fails "size '$value'" 2 '--size: .* from 1 to 65536' distortion --size "$value" made/a.png
    done
    for value in '' 1 1: :1 2:1 1:1 nan:2 1:inf -1:2 1:2:3 0x1:2 a:b; do
        fails "range '$value'" 2 '--range: .* is not LOW:HIGH' distortion --range "$value" made/a.png
    done
    fails 'range from 0 on a logarithmic scale' 2 'LOW must be above 0' distortion --range 0:2 \
        made/a.png
    for value in 0 -1 x '' nan 1e-7; do
        fails "isolines '$value'" 2 '--isolines: ' distortion --isolines "$value" made/a.png
    done
    fails 'unknown colours' 2 "--colors: 'nonesuch'" distortion --colors nonesuch made/a.png
    fails 'colours out of range' 2 '--colors: ' distortion --colors sequential-single:hue=999 made/a.png
    fails 'values in PNG' 2 'ends in .tif or .exr' distortion --values made/a.png
    fails 'colours in EXR' 2 'ends in .png, .jpg or .tif' distortion made/a.exr
    fails 'no extension' 2 'must end in' distortion made/a
    fails 'values and colours' 2 '--values writes numbers' distortion --values --colors rainbow made/a.tif
    fails 'values and lines' 2 '--values writes numbers' distortion --values --grid 2 made/a.tif
    fails 'values and a legend' 2 '--values writes numbers' \
        distortion --values --legend made/l.png made/a.tif
    fails 'six names for one picture' 2 '%f' distortion made/%f.png
    fails 'legend is the output' 2 'same file' distortion --legend made/a.png made/a.png
    fails 'legend of the wrong kind' 2 'ends in .png' distortion --legend made/l.exr made/a.png
    local program
    "$helper" constant 64 32 3 uint8 0.5 grey.png
    # unquoted: a program, or a program and a name
    # shellcheck disable=SC2086
    for program in 'distortion' 'reproject grey.png'; do
        for value in 0 -1 7 181 x '' nan 0.001; do
            fails "graticule '$value', $program" 2 '--graticule: ' \
                $program --graticule "$value" made/a.png
        done
        fails "grid 0, $program" 2 '--grid: .* from 1 to' $program --grid 0 made/a.png
        fails "indicatrices 0, $program" 2 '--indicatrices: ' $program --indicatrices 0 made/a.png
        fails "a radius alone, $program" 2 'say --indicatrices N' \
            $program --indicatrices-radius 3 made/a.png
        fails "a radius too large, $program" 2 'overlap; with 5 x 5 a face, [0-9.]* at most' \
            $program --indicatrices 5 --indicatrices-radius 12 made/a.png
        fails "a line's look alone, $program" 2 'there are none' $program --line-width 2 made/a.png
        fails "line width, $program" 2 '--line-width: .* from 0.1 to 100' \
            $program --grid 2 --line-width 0 made/a.png
        for value in red fff '#ffffff' gggggg 1234567 ''; do
            fails "line colour '$value', $program" 2 '--line-color: .* RRGGBB' \
                $program --grid 2 --line-color "$value" made/a.png
        done
    done
    fails 'instruction set that is none' 1 "'abacus', but here it can be scalar" \
        env CUBEMAP_INSTRUCTIONS=abacus "$programs/cubemap-distortion" made/a.png
}

bad_output()
{
    fails 'no such folder' 1 "'nowhere.*No such file" distortion nowhere/a.png
    mkdir made
    fails 'no such folder for the legend' 1 "'nowhere.*No such file" \
        distortion --legend nowhere/l.png made/a.png
    mkdir folder.png
    fails 'output is a folder' 1 'is a folder' distortion folder.png
    local extension values
    for extension in png jpg tif exr; do
        values=
        [ $extension != exr ] || values=--values
        # unquoted: nothing or one word
        # shellcheck disable=SC2086
        fails "limit on the size of files, $extension" 1 'File too large' \
            bash -c "ulimit -f 4; exec '$programs/cubemap-distortion' $values --size 400 \
            made/a.$extension"
    done
    mkdir -p kept
    echo old >kept/a.png
    (
        ulimit -f 4
        distortion --size 400 --legend kept/l.png kept/a.png 2>/dev/null
    )
    [ "$(cat kept/a.png)" = old ] && [ "$(ls -A kept)" = a.png ]
    result $? 'an older file is kept when the new one fails'
    mkdir -p six/f5.png
    distortion --layout faces --size 8 six/f%f.png 2>err.txt
    [ $? -eq 1 ] && [ "$(ls -A six)" = f5.png ]
    result $? 'six files or none' "$(cat err.txt; ls -A six)"
}

subjects="closed_forms differences colors talk sizes ellipses lines pixel_types bad_arguments bad_output"
if [ $# -gt 4 ]; then
    shift 4
    subjects=$*
fi
for subject in $subjects; do
    in_fresh_folder "$subject"
done
finish
