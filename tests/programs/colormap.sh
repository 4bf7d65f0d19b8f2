#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# cubemap-colormap as a user meets it.
#
# usage: colormap.sh PROGRAMS [SOURCE]
#   PROGRAMS  folder with the built programs
#   SOURCE    top of the source tree
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "${2:-$here/..}" && pwd)
# shellcheck source-path=SCRIPTDIR source=cases.sh
. "$here/cases.sh" "${1:?usage: colormap.sh PROGRAMS [SOURCE]}"
models='sequential-single sequential-rainbow sequential-custom sequential-saturation
    diverging-lightness diverging-saturation qualitative'

colormap()
{
    "$programs/cubemap-colormap" "$@"
}

# fails NAME STATUS MESSAGE ARGUMENT...: exits with STATUS and one line on standard error that has MESSAGE,
# an extended regular expression; writes nothing to standard output, and leaves no file in made/.
fails()
{
    local name=$1 status=$2 message=$3 got
    shift 3
    rm -rf made
    mkdir made
    colormap "$@" >output 2>errors
    got=$?
    [ "$got" -eq "$status" ] && [ ! -s output ] && [ "$(wc -l <errors)" -eq 1 ] &&
        grep -Eq -- "^cubemap-colormap: .*($message)" errors && [ -z "$(ls -A made)" ]
    result $? "$name" "status $got, wanted $status: $(cat errors) $(ls -A made)"
}

# says NAME MESSAGE ARGUMENT...: exits with 0, and standard error is one line with MESSAGE, or none if that
# is empty. Standard output is in the file output.
says()
{
    local name=$1 message=$2 got
    shift 2
    colormap "$@" >output 2>errors
    got=$?
    [ "$got" -eq 0 ] && if [ -z "$message" ]; then
        [ ! -s errors ]
    else
        [ "$(wc -l <errors)" -eq 1 ] && grep -Eq -- "$message" errors
    fi
    result $? "$name" "status $got: $(cat errors)"
}

# checks NAME PYTHON [ARGUMENT...]: a program that asserts.
checks()
{
    local name=$1 program=$2
    shift 2
    python3 -c "$program" "$@" >python.log 2>&1
    result $? "$name" "$(cat python.log)"
}

# ---------------------------------------------------------------------------- talk

colormap --help >output && grep -q '^Usage: cubemap-colormap' output
result $? help
colormap --version | grep -Eq '^cubemap-colormap [0-9]+\.[0-9]+\.[0-9]+$'
result $? version
colormap --list >output
for model in $models; do
    grep -q "^$model " output || echo "$model" >>missing
done
[ ! -e missing ] && [ "$(grep -c '^    source ' output)" -eq 7 ]
result $? 'the list has all maps' "$(cat missing 2>/dev/null)"

# ---------------------------------------------------------------------------- text

says 'csv by default' '' single:hue=0,lightness-range=0.75,saturation-range=1,saturation=0 --samples 2
cat >wanted <<'T'
t,red,green,blue,hex,lightness,chroma,hue,inside
0,0.232514527791,0.232514527791,0.232514527791,#3b3b3b,25,0,0,1
1,0.723900017328,0.723900017328,0.723900017328,#b9b9b9,75,0,0,1
T
python3 - >difference <<'P'
wanted, got = ([line.split(",") for line in open(name)] for name in ("wanted", "output"))
assert [row[4:] for row in wanted] == [row[4:] for row in got]
for one, other in zip(wanted[1:], got[1:]):
    assert all(abs(float(a) - float(b)) < 1e-11 for a, b in zip(one[:4], other[:4])), (one, other)
P
result $? 'csv has t, colours and LCH' "$(cat output)"
for model in $models; do
    says "$model as json" '' "$model" --format json
    mv output "$model.json"
done
checks 'json: colours, steps and what the map is' '
import json, sys
for name in sys.argv[1:]:
    data = json.load(open(name + ".json"))
    assert data["model"] == name and data["inside"] and data["clipped"]["count"] == 0, name
    assert data["specification"].startswith(name + ":")
    assert set(data["parameters"]) == {word.split("=")[0] for word in
                                       data["specification"].split(":")[1].split(",")}
    count = {"qualitative": 8, "diverging": 257}.get(data["family"], 256)
    assert len(data["samples"]) == count, len(data["samples"])
    assert data["step"]["max_deviation_percent"] < 0.01, data["step"]
    assert data["step"]["max_deviation_without_corners_percent"] < 0.01, data["step"]
    assert data["largest_saturation"] > data["parameters"]["saturation"]
    for sample in data["samples"]:
        assert sample["inside"] and all(0 <= value <= 1 for value in sample["srgb"])
        assert sample["hex"] == "#" + "".join("%02x" % int(v * 255 + 0.5) for v in sample["srgb"])
    middle = [s["lch"][1] for s in data["samples"] if s["t"] == 0.5]
    assert data["family"] != "diverging" or middle == [0], middle
' sequential-single sequential-rainbow sequential-custom sequential-saturation diverging-lightness \
    diverging-saturation qualitative
cat >luv.py <<'P'
def invert(m):
    """The inverse of a 3 by 3 matrix, by cofactors."""
    def minor(i, k):
        a, b = (x for x in range(3) if x != i)
        c, d = (x for x in range(3) if x != k)
        return (-1) ** (i + k) * (m[a][c] * m[b][d] - m[a][d] * m[b][c])
    whole = sum(m[0][k] * minor(0, k) for k in range(3))
    return [[minor(k, i) / whole for k in range(3)] for i in range(3)]

def xyz(x, y):
    return [x / y, 1, (1 - x - y) / y]

def times(m, v):
    return [sum(m[i][k] * v[k] for k in range(3)) for i in range(3)]

WHITE = xyz(0.3127, 0.3290)
PRIMARIES = [list(row) for row in zip(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06))]
BRIGHT = times(invert(PRIMARIES), WHITE)

def luv(srgb):
    """CIELUV of three numbers of sRGB, from the chromaticities of its primaries and its white."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in srgb]
    x, y, z = times(PRIMARIES, [c * b for c, b in zip(linear, BRIGHT)])
    if y <= 0:
        return [0, 0, 0]
    lightness = 116 * y ** (1 / 3) - 16 if y > 216 / 24389 else y * 24389 / 27
    whole, of_white = x + 15 * y + 3 * z, WHITE[0] + 15 + 3 * WHITE[2]
    return [lightness, 13 * lightness * (4 * x / whole - 4 * WHITE[0] / of_white),
            13 * lightness * (9 * y / whole - 9 / of_white)]

def worst_step(colors):
    """How far the worst distance of neighbours is from the mean, as a part of it, and the mean."""
    at = [luv(color) for color in colors]
    steps = [sum((a - b) ** 2 for a, b in zip(*pair)) ** 0.5 for pair in zip(at, at[1:])]
    mean = sum(steps) / len(steps)
    return max(abs(step / mean - 1) for step in steps), mean
P
for model in $models; do
    colormap "$model" --samples 256 --format json -o "$model.256.json"
    colormap "$model" --samples 256 --format csv -o "$model.256.csv"
done
checks 'steps of 256 colours are even, corners included, and json says so' '
import csv, json, sys
from luv import worst_step
for name in sys.argv[1:]:
    data = json.load(open(name + ".256.json"))
    rows = list(csv.DictReader(open(name + ".256.csv")))
    assert len(rows) == len(data["samples"]) == 256
    ts = [float(row["t"]) for row in rows]
    assert ts[0] == 0 and all(a < b for a, b in zip(ts, ts[1:])), name
    assert ts[-1] == 1 or name == "qualitative", ts[-1]
    for colors in ([s["srgb"] for s in data["samples"]],
                   [[float(row[c]) for c in ("red", "green", "blue")] for row in rows]):
        worst, mean = worst_step(colors)
        assert worst < 0.0001, (name, worst)
        assert abs(mean - data["step"]["mean"]) < 1e-6 * mean, (name, mean, data["step"])
        assert abs(100 * worst - data["step"]["max_deviation_percent"]) < 1e-5, (name, worst)
' sequential-single sequential-rainbow sequential-custom sequential-saturation diverging-lightness \
    diverging-saturation qualitative
# the colour in the middle of a fold, where two samples beside it are the same, is the only short step
colormap diverging:divergence=0 --samples 256 --format json >fold.json
checks 'json says where steps are not even' '
import json
from luv import worst_step
data = json.load(open("fold.json"))
assert data["step"]["max_deviation_percent"] > 99, data["step"]
assert abs(data["step"]["max_deviation_t"] - 0.5) < 0.01, data["step"]
assert worst_step([s["srgb"] for s in data["samples"]])[0] > 0.99
assert data["step"]["max_deviation_without_corners_percent"] < 1e-6, data["step"]'
colormap diverging --samples 257 --format csv | grep -q '^0\.5,\([^,]*\),\1,\1,'
result $? 'the middle of a diverging map is a colour of 257, and grey'
specification=$(python3 -c 'import json; print(json.load(open("sequential-custom.json"))["specification"])')
colormap "$specification" --format json | cmp -s - sequential-custom.json
result $? 'the specification in json makes the same map'
colormap rainbow --samples 7 | tail -n +2 | tac >forward
colormap rainbow --samples 7 --reverse | tail -n +2 | cmp -s - forward
result $? 'reverse'
colormap rainbow --samples 1 --format json | python3 -c '
import json, sys
data = json.load(sys.stdin)
assert data["step"] is None and len(data["samples"]) == 1'
result $? 'one sample'
colormap Custom:HUES=10/20 --samples 3 >output && colormap custom:hues=10@0/20@1 --samples 3 | cmp -s - output
result $? 'upper and lower case, places of stops'
for suffix in json csv py gpl; do
    colormap rainbow -o "file.$suffix" || echo "$suffix" >>unwritten
done
[ ! -e unwritten ] && head -c 1 file.json | grep -q '{' && head -n 1 file.csv | grep -q '^t,' &&
    grep -q '^NAME = "cubemap-sequential-rainbow"$' file.py && head -n 1 file.gpl | grep -q '^GIMP Palette$'
result $? 'the name says the format'
colormap rainbow --format csv -o plain && cmp -s plain file.csv
result $? 'the format says it'
colormap qualitative --samples 3 --format gimp --name three >output
printf 'GIMP Palette\nName: three\nColumns: 0\n' | cmp -s - <(head -n 3 output) &&
    [ "$(grep -Ec '^ *[0-9]+ +[0-9]+ +[0-9]+	#[0-9a-f]{6}$' output)" -eq 3 ]
result $? 'a palette' "$(cat output)"
python=$(for each in python3 /usr/bin/python3; do
    "$each" -c 'import matplotlib' 2>/dev/null && echo "$each" && break
done)
if [ -n "$python" ]; then
    colormap diverging -o mine.py --name mine
    "$python" -c '
import matplotlib
import mine
try:
    registered = matplotlib.colormaps["mine"], matplotlib.colormaps["mine_r"]
except AttributeError:
    registered = matplotlib.cm.get_cmap("mine"), matplotlib.cm.get_cmap("mine_r")
assert registered[0].N == 257 and registered[0](0.0) == registered[1](1.0)
assert max(registered[0](0.5)[:3]) - min(registered[0](0.5)[:3]) < 1e-9, registered[0](0.5)
assert mine.colormap.name == "mine"' >python.log 2>&1
    result $? 'matplotlib takes it' "$(cat python.log)"
else
    echo 'skipped: there is no matplotlib'
fi

# ---------------------------------------------------------------------------- pictures

cat >png.py <<'P'
import struct, zlib

def read(name):
    """The rows of an 8-bit RGB picture, each a list of triples."""
    data = open(name, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, form = struct.unpack(">IIBB", data[at + 8:at + 18])
            assert (depth, form) == (8, 2)
        packed += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += size + 12
    plain, rows, before = zlib.decompress(packed), [], bytes(3 * width)
    for row in range(height):
        kind, *line = plain[row * (3 * width + 1):(row + 1) * (3 * width + 1)]
        for i in range(3 * width):
            left, up, corner = (line[i - 3] if i >= 3 else 0), before[i], (before[i - 3] if i >= 3 else 0)
            guess = left + up - corner
            paeth = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            line[i] = (line[i] + (0, left, up, (left + up) // 2, paeth)[kind]) % 256
        before = line
        rows.append([tuple(line[i:i + 3]) for i in range(0, 3 * width, 3)])
    return rows
P
colormap qualitative --samples 5 --size 50x4 -o bands.png
colormap qualitative --samples 5 --format json >bands.json
checks 'a picture of bands' '
import json, png
rows = png.read("bands.png")
assert len(rows) == 4 and len(rows[0]) == 50
colors = [tuple(bytes.fromhex(s["hex"][1:])) for s in json.load(open("bands.json"))["samples"]]
assert rows == [[color for color in colors for i in range(10)]] * 4'
colormap rainbow -o strip.png
colormap rainbow --samples 512 --format json >strip.json
checks 'a picture of the whole map' '
import json, png
rows = png.read("strip.png")
assert len(rows) == 64
assert rows[0] == [tuple(bytes.fromhex(s["hex"][1:])) for s in json.load(open("strip.json"))["samples"]]
assert all(row == rows[0] for row in rows)'
colormap single:saturation=0 --test-pattern --size 160x20 -o pattern.png
colormap single:saturation=0 --reverse --test-pattern --size 160x20 -o mirrored.png
checks 'the test pattern fades from top to bottom' '
import png
rows = png.read("pattern.png")
assert len(rows) == 20 and len(rows[0]) == 160
swing = [sum(abs(row[i - 1][0] - 2 * row[i][0] + row[i + 1][0]) for i in range(1, 159)) for row in rows]
assert swing[0] > 5 * swing[-1] and swing[0] > swing[6] > swing[12] > swing[-1], swing
assert all(row[i][0] <= row[i + 1][0] for row in rows[-1:] for i in range(159))
assert png.read("mirrored.png")[-1] == rows[-1][::-1]'

# ---------------------------------------------------------------------------- the gamut

too_much=single:saturation=4
says 'a warning when colours are cut' \
    'warning: [0-9]+ of 256 colours are outside sRGB, the first at t = 0\.[0-9]+; --fit mends that, or saturation=2\.20' \
    "$too_much"
grep -q ',0$' output
result $? 'the table says which'
fails 'strict refuses them' 1 'colours are outside sRGB' "$too_much" --strict -o made/a.json
fails 'strict refuses the test pattern' 1 'colours of the map are outside sRGB' "$too_much" --strict \
    --test-pattern -o made/a.png
says 'strict takes what is inside' '' single --strict
says 'fit says to what' 'fitted into sRGB: saturation from 4 to 2\.20[0-9]+$' "$too_much" --fit --strict
! grep -q ',0$' output
result $? 'fitted colours are inside'
says 'fit changes nothing that fits' 'inside sRGB as it is' single --fit
colormap single >wanted && cmp -s wanted output
result $? 'and the map is the same'
says 'fit of pale ends' 'saturation-range from 0\.6 to 1' \
    single:lightness-range=1,saturation-range=0.6,saturation=1 --fit --strict
says 'advice for pale ends' 'or a larger saturation-range; they are cut' \
    single:lightness-range=1,saturation-range=0.6,saturation=1
colormap "$too_much" --format json 2>/dev/null | python3 -c '
import json, sys
data = json.load(sys.stdin)
outside = [i for i, sample in enumerate(data["samples"]) if not sample["inside"]]
assert not data["inside"] and data["clipped"]["count"] == len(outside) > 0
assert data["clipped"]["first"] == outside[0]
assert data["clipped"]["first_t"] == data["samples"][outside[0]]["t"]
assert data["clipped"]["excess"] > 0.01
assert 2.2 < data["largest_saturation"] < 2.21'
result $? 'json says what is cut'

# ---------------------------------------------------------------------------- wrong usage

fails 'no map' 2 'one MAP is needed, 0 are given'
fails 'two maps' 2 'one MAP is needed, 2 are given' single rainbow -o made/a.json
fails 'unknown map' 2 "no colour map is called 'viridis'.*see --list" viridis -o made/a.json
fails 'control characters' 2 "called 'a\\?b'" $'a\nb' -o made/a.json
fails 'unknown parameter' 2 "sequential-single has no parameter 'hug'" single:hug=1
fails 'range' 2 'must be in \[0, 360\]' single:hue=400
fails 'unknown option' 2 "no option '--sample'" single --sample 3
fails 'missing value' 2 '--samples needs a value' single --samples
fails 'value too many' 2 '--fit takes no value' single --fit=1
for number in 0 -1 65537 1.5 x ''; do
    fails "samples '$number'" 2 '--samples: .* is not a whole number from 1 to 65536' single --samples "$number"
done
for size in 5 5x 0x5 5x0 x5 5x5x 40000x1 '' 5X5; do
    fails "size '$size'" 2 '--size: .* is not WIDTHxHEIGHT' single --size "$size" -o made/a.png
done
fails 'unknown format' 2 "'gif' is not json, csv, matplotlib, gimp or png" single --format gif
fails 'unknown suffix' 2 "must end in .json, .csv, .py, .gpl or .png" single -o made/a.gif
fails 'no name of a file' 2 'needs the name of a file' single -o ''
fails 'png to standard output' 2 'a png goes to a file' single --format png
fails 'size of text' 2 '--size is for png only, not for csv' single --size 5x5
fails 'test pattern of text' 2 '--test-pattern is for png only, not for json' single --test-pattern -o made/a.json
fails 'samples of a test pattern' 2 '--samples has no meaning' single --test-pattern --samples 5 -o made/a.png
fails 'name of csv' 2 '--name is for matplotlib and gimp' single --name a
fails 'a name that is no word' 2 "'a\"b' is not a word" single --format gimp --name 'a"b'

# ---------------------------------------------------------------------------- files

fails 'no such folder' 1 'cannot be written' single -o made/none/a.json
mkdir folder.json
fails 'a folder' 1 'is a folder' single -o folder.json
if [ -w /dev/full ]; then
    colormap single >/dev/full 2>errors
    [ $? -eq 1 ] && grep -q 'standard output' errors
    result $? 'standard output is full' "$(cat errors)"
fi
echo old >kept.json
(
    ulimit -f 1
    colormap rainbow --samples 60000 -o kept.json 2>errors
)
[ $? -eq 1 ] && [ "$(cat kept.json)" = old ] && [ -z "$(find . -name '.cubemap-*')" ]
result $? 'no room: the old file stays, and no other' "$(cat errors)"
colormap rainbow -o kept.json && grep -q sequential-rainbow kept.json
result $? 'an old file is replaced'

# ---------------------------------------------------------------------------- the library

library=$programs/../modules/colormap/libcubemap-colormap.so
if [ -e "$library" ]; then
    nm -D --defined-only "$library" | awk '{ print $3 }' | grep '^cm_' | sort >exported
    tr '\n' ' ' <"$root/include/cubemap/colormap.h" | sed 's/CM_API/\n&/g' |
        sed -n 's/^CM_API[^(;]*[ *]\(cm_[a-z0-9_]*\)(.*/\1/p' | sort >declared
    [ -s declared ] && cmp -s declared exported
    result $? 'the library exports what its header declares' "$(diff declared exported)"
fi

finish
