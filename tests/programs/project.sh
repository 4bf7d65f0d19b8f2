#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# cubemap-project as a user meets it.
#
# usage: project.sh PROGRAMS [SOURCE]
#   PROGRAMS  folder with the built programs
#   SOURCE    top of the source tree
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "${2:-$here/..}" && pwd)
# shellcheck source-path=SCRIPTDIR source=filter.sh
. "$here/filter.sh" cubemap-project "${1:?usage: project.sh PROGRAMS [SOURCE]}"

# bad_line NAME INPUT MESSAGE [ARGUMENT...]: the third of five lines is bad, the others are not.
bad_line()
{
    local name=$1 input=$2 message=$3 point='0 0' result='0 0 0' bad='nan nan nan'
    shift 3
    case " $* " in
    *' -I --output xyz '*) point='0 0 0' result='1 0 0' ;;
    *' -I '*) point='0 0 0' result='0 0' bad='nan nan' ;;
    *' --input xyz '*) point='1 0 0' ;;
    esac
    expect "$name" 1 "$point\n# c\n$input\n\n$point\n" "$result\n# c\n$bad\n\n$result\n" \
        "<stdin>:3: $message" "$@"
}

# bad_pair NAME INPUT MESSAGE ARGUMENT...: the same where two numbers come from two, of the north pole or
# the middle of the plane.
bad_pair()
{
    local name=$1 input=$2 message=$3 point='0 90' result='0 0'
    shift 3
    case " $* " in
    *' square:'*) point='0 0' ;;
    *' -I '*) point='0 0' result='0 90' ;;
    esac
    expect "$name" 1 "$point\n$input\n$point\n" "$result\nnan nan\n$result\n" \
        "<stdin>:2: $message" "$@"
}

# ---------------------------------------------------------------------------- points

axes='0 0\n90 0\n180 0\n-90 0\n0 90\n0 -90\n'
expect 'axes in geo' 0 "$axes" '0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n' ''
expect 'axes in fits' 0 "$axes" '1 0 0\n2 0 0\n3 0 0\n4 0 0\n0 0 0\n5 0 0\n' '' --frame fits
expect 'axes in s2' 0 "$axes" '0 0 0\n1 0 0\n3 0 0\n4 0 0\n2 0 0\n5 0 0\n' '' --frame s2
expect 'axes in gl' 0 "$axes" '0 0 0\n2 0 0\n1 0 0\n3 0 0\n4 0 0\n5 0 0\n' '' --frame gl
expect 'axes of faces in geo' 0 '0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n' "$axes" '' -I
expect 'axes as directions' 0 '0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n' \
    '1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n0 0 1\n0 0 -1\n' '' -I --output xyz
expect 'u grows east, v north' 0 '45 0\n-45 0\n0 45\n0 -45\n' '0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n' '' \
    -m gnomonic
expect 'a pole has every longitude' 0 '123.4 90\n-7 -90\n1e300 90\n' '4 0 0\n5 0 0\n4 0 0\n' ''
expect 'turns of longitude' 0 '360 0\n-540 0\n3.6e20 0\n' '0 0 0\n2 0 0\n0 0 0\n' ''
# 10 * 2^61 = 360 k + 200
printf '23058430092136939520 20\n200 20\n-160 20\n' | "$program" | uniq | wc -l >output
[ "$(cat output)" -eq 1 ]
verdict 'longitudes are reduced exactly'
expect 'gnomonic values' 0 '1 0.5 0.25\n-4 -1 3 x\n' '0 0.5 0.25\n2 0.25 0.75 x\n' '' \
    -m gnomonic --input xyz
expect 'directions of any length' 0 '2e300 1e300 0\n2e-300 1e-300 0\n4e-323 2e-323 0\n' \
    '0 0.5 0\n0 0.5 0\n0 0.5 0\n' '' -m gnomonic --input xyz
expect 'directions of any length in float' 0 '2e300 1e300 0\n2e-300 1e-300 0\n4e-323 2e-323 0\n' \
    '0 0.5 0\n0 0.5 0\n0 0.5 0\n' '' -m gnomonic --input xyz --float
expect 'aliases' 0 '22.5 0\n' '0 0.5 0\n' '' -m EAC --digits 14
expect 'parameters' 0 '22.5 0\n' '0 0.5 0\n' '' -m tangent:c=1 --digits 14
expect 'nearly outside is the edge' 0 '0 1.0000000005 0\n' '45 0\n' '' -I
expect 'a corner' 0 '0 1 1\n' '0.57735026919 0.57735026919 0.57735026919\n' '' -I --output xyz \
    --digits 11
expect 'minus zero is zero' 0 '0 -0 -0\n2 0 0\n' '0 0\n180 0\n' '' -I
expect 'digits' 0 '1 2\n' '0 0.017 0.035\n' '' -m gnomonic --digits 2
expect 'float has 9 digits' 0 '3 1 0\n' '0 0.333333343 0\n' '' -m gnomonic --input xyz --float
expect 'double has 17 digits' 0 '1 3 0\n' '1 -0.33333333333333331 0\n' '' -m gnomonic --input xyz

# ---------------------------------------------------------------------------- disc and square

# The radius 0.5 becomes the larger coordinate.
expect 'disc to square' 0 '0.3 0.4 a\n-0.4 0.3\n0 -1\n' '0.375 0.5 a\n-0.5 0.375\n0 -1\n' '' \
    -m square:radial --digits 14
expect 'square to disc' 0 '0.375 0.5 a\n-0.5 0.375\n1 1\n' \
    '0.3 0.4 a\n-0.4 0.3\n0.707106781187 0.707106781187\n' '' -m square:radial -I --digits 12
expect 'disc to square in float' 0 '0.3 0.4\n' '0.375 0.5\n' '' -m square:radial --float --digits 6
expect 'square to disc in float' 0 '0.375 0.5\n' '0.3 0.4\n' '' -m square:radial --float -I --digits 6
expect 'concentric' 0 '0.5 0\n0 -0.25\n0.5 0.5\n' \
    '0.5 0\n0 -0.25\n0.707106781187 0.707106781187\n' '' -m square:concentric --digits 12
bad_pair 'outside the disc' '0.8 0.9' 'the point .* is outside the disc' -m square:shirley
bad_pair 'outside the square' '0 1.5' 'y, 1.5, is not in \[-1, 1\]' -m square:shirley -I
bad_pair 'nan on the disc' 'nan 0' 'the point nan 0 is outside the disc' -m square:conformal
bad_pair 'one number of a disc' '0.5' '1 of 2 numbers: a line is U V' -m square:conformal
bad_pair 'one number of a square' '0.5' '1 of 2 numbers: a line is X Y' -m square:conformal -I

# Equal angles about the pole, from south eastward; about other centres up is north.
expect 'azimuthal, about the pole' 0 '0 90\n0 60\n90 60\n180 60\n-90 60\n-90 0\n' \
    '0 0\n0 -0.333333333333\n0.333333333333 0\n0 0.333333333333\n-0.333333333333 0\n-1 0\n' '' \
    -m azimuthal:equidistant --digits 12
expect 'azimuthal, about another centre' 0 '90 0 here\n90 30\n90 -45\n120 0\n' \
    '0 0 here\n0 0.333333333333\n0 -0.5\n0.333333333333 0\n' '' -m azimuthal:aeqd:lon=90,lat=0 \
    --digits 12
expect 'azimuthal, back' 0 '0 0\n0 0.5\n' '10 50\n-170 85\n' '' \
    -m azimuthal:aeqd:lon=10,lat=50 -I --digits 12
expect 'azimuthal, a direction' 0 '3 0 4\n' '0 -0.75\n' '' -m azimuthal:gnomonic --input xyz \
    --digits 12
expect 'azimuthal, back to a direction' 0 '0 -0.75\n' '0.6 0 0.8\n' '' -m azimuthal:gnomonic -I \
    --output xyz --digits 12
expect 'azimuthal, the whole sphere' 0 '90 0\n90 -90\n' '0.707106781187 0\n0 -1\n' '' \
    -m azimuthal:lambert:full=1 --digits 12
expect 'a field of view' 0 '90 0\n90 -20\n' '0.818181818182 0\n1 0\n' '' \
    -m azimuthal:equidistant:fov=220 --digits 12
bad_pair 'not in the hemisphere' '0 -1' 'the direction is not in the field of view of 180 degrees' \
    -m azimuthal:lambert
bad_pair 'not in the field of view' '0 30' '.*field of view of 100 degrees' -m azimuthal:lambert:fov=100
bad_pair 'not in the field of view of the gnomonic' '0 -90' '.*field of view of 90 degrees' \
    -m azimuthal:gnomonic
bad_pair 'azimuthal, outside the disc' '0.6 -0.9' 'the point .* is outside the disc' \
    -m azimuthal:orthographic -I
bad_pair 'azimuthal, just outside the disc' '0 1.00000001' '.*outside the disc' \
    -m azimuthal:orthographic -I
bad_pair 'azimuthal, a word' '0 x' "'x' is not a number: a line is U V" -m azimuthal:orthographic -I
awk 'BEGIN { for (i = 0; i < 360; i++) printf "%d 0\n", i }' >rim
"$program" -m azimuthal:lambert --float rim | "$program" -m azimuthal:lambert --float -I >output \
    2>errors && [ ! -s errors ] && [ "$(wc -l <output)" -eq 360 ]
verdict 'the rim in float comes back'

expect 'octahedral' 0 '0 90\n0 0\n90 0\n45 0\n' '0 0\n1 0\n0 1\n0.5 0.5\n' '' -m octahedral \
    --digits 12
expect 'octahedral, directions' 0 '1 1 2\n1 1 -2\n' '0.25 0.25\n0.75 0.75\n' '' -m oct \
    --input xyz --digits 12
expect 'octahedral, back' 0 '0.75 0.75\n-1 -1\n' '0.408248290464 0.408248290464 -0.816496580928\n0 0 -1\n' \
    '' -m oct -I --output xyz --digits 12
expect 'equal-area octahedral' 0 '0 90\n180 0\n-45 0\n' '0 0\n-1 0\n0.5 -0.5\n' '' \
    -m octahedral:clarberg --digits 12
expect 'quincuncial' 0 '0 90\n0 0\n45 0\n135 0\n' '0 0\n-0.5 -0.5\n0 -1\n1 0\n' '' -m peirce \
    --digits 12
expect 'quincuncial, back' 0 '0 0\n1 0\n0.75 0.75\n1 1\n' '0 90\n135 0\n180 -45\n0 -90\n' '' \
    -m quincuncial:equidistant,radial -I --digits 12
expect 'a pole at the border' 0 '0 90\n90 0\n45 0\n' \
    '0 0\n0.707106781187 0\n0.707106781187 -0.707106781187\n' '' -m border:lambert,radial --digits 12
expect 'a pole at the border, back' 0 '1 0.3\n0 0.25\n' '0 -90\n180 45\n' '' \
    -m border:equidistant,shirley -I --digits 12
bad_pair 'outside a layout' '-1.5 0' 'x, -1.5, is not in \[-1, 1\]' -m quincuncial -I
bad_pair 'nan on a layout' '0 nan' 'y, nan, is not in \[-1, 1\]' -m octahedral -I
bad_pair 'latitude of a layout' '0 100' 'the latitude, 100, .*' -m octahedral

# ---------------------------------------------------------------------------- lines

expect 'no input' 0 '' '' ''
expect 'comments and blank lines' 0 '# a\n\n  \t\n \t# b , c\n' '# a\n\n  \t\n \t# b , c\n' ''
expect 'what follows passes through' 0 '0 0 a  b\n0 0\t#c\n0 0, 7\n0 0  \n' \
    '0 0 0 a  b\n0 0 0\t#c\n0 0 0, 7\n0 0 0  \n' ''
expect 'separators' 0 '0,0\n0 , 0\n0\t0\n  0  0\n0,\t0\n' \
    '0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n' ''
expect 'forms of numbers' 0 '+0 -.0\n0. 0e5\n9e1 0.0\n.9E+2 0\n900e-1 0\n' \
    '0 0 0\n0 0 0\n1 0 0\n1 0 0\n1 0 0\n' ''
expect 'CR LF' 0 '0 0\r\n# a\r\n0 90 b\r\n\r\n' '0 0 0\r\n# a\r\n4 0 0 b\r\n\r\n' ''
expect 'no newline at the end' 0 '0 0\n90 0' '0 0 0\n1 0 0\n' ''
expect 'a face as a decimal number' 0 '1.0 0 0\n' '90 0\n' '' -I
expect 'nan gives nan' 1 'nan nan nan\n' 'nan nan\n' '<stdin>:1: .*face, nan, .*' -I

bad_line 'one number' '5' '1 of 2 numbers: .*LON LAT.*'
bad_line 'a word' 'abc 5' "'abc' is not a number: .*LON LAT.*"
bad_line 'a word behind a number' '5 5x' "'5x' is not a number: .*"
bad_line 'two commas' '5,,5' ".*not a number.*"
bad_line 'a comma first' ',5,5' ".*not a number.*"
bad_line 'an exponent without digits' '1e 5' "'1e' is not a number.*"
bad_line 'hexadecimal' '0x10 5' "'0x10' is not a number.*"
bad_line 'a control character is not echoed' '\033[2J 5' "'\\?\[2J' is not a number.*"
bad_line 'latitude above 90' '0 90.00000000000001' '.*latitude, 90.000000000000014,.*\[-90, 90\].*'
bad_line 'latitude nan' '0 nan' '.*latitude, nan,.*'
bad_line 'longitude infinite' '1e999 0' '.*longitude, inf,.*'
bad_line 'two numbers of a direction' '1 2' '2 of 3 numbers: a line is X Y Z' --input xyz
bad_line 'direction of length zero' '0 0 -0' '.*no length.*' --input xyz
bad_line 'direction not finite' '0 -inf 0' '.*not finite.*' --input xyz
bad_line 'two numbers of a face' '0 0' '2 of 3 numbers: a line is FACE U V' -I
bad_line 'face 6' '6 0 0' '.*face, 6,.*0 to 5' -I
bad_line 'face -1' '-1 0 0' '.*face, -1,.*' -I
bad_line 'face 1.5' '1.5 0 0' '.*face, 1.5,.*' -I
bad_line 'u outside' '0 1.00000001 0' 'u, 1.0000000099.*\[-1, 1\]' -I
bad_line 'v outside' '0 0 -2' 'v, -2,.*' -I
bad_line 'v nan' '0 0 nan' 'v, nan,.*' -I
bad_line 'v outside, xyz' '0 0 -2' 'v, -2,.*' -I --output xyz
bad_line 'a zero byte' '0 0 \0000' '.*zero byte.*'
expect 'a bad line keeps what follows its numbers' 1 '0 91 x y\n' 'nan nan nan x y\n' \
    '<stdin>:1: .*latitude.*'

printf '0 0\n# c\n0 x\n' >points
expect 'a bad line by file and line' 1 '' '0 0 0\n# c\nnan nan nan\n' "points:3: 'x' is .*" points
printf '0 0\n' >points
expect 'FILE' 0 '90 0\n' '0 0 0\n' '' points
expect 'FILE is -' 0 '90 0\n' '1 0 0\n' '' -
expect 'FILE after --' 0 '90 0\n' '0 0 0\n' '' -- points

# Every bad line is reported, and only those.
for i in 1 2 3 4 5; do printf '%s 0\n1%s0 100\n' "$i" "$i"; done >input
"$program" <input >output 2>errors
[ $? -eq 1 ] && [ "$(grep -c nan output)" -eq 5 ] && [ "$(wc -l <output)" -eq 10 ] &&
    [ "$(cut -d: -f2 errors | tr '\n' ' ')" = '2 4 6 8 10 ' ]
verdict 'every bad line is reported'

# Lines around the longest, at the end of the buffer or not, ended or not.
line_of()
{
    printf '0 0 '
    head -c $(($1 - 4)) /dev/zero | tr '\0' x
}
line_of 4096 >long
{ cat long; printf '\r\n'; cat long; printf '\n'; cat long; } >input
{ printf '0 '; cat long; printf '\r\n0 '; cat long; printf '\n0 '; cat long; printf '\n'; } >wanted
"$program" <input >output 2>errors && cmp -s wanted output && [ ! -s errors ]
verdict 'a line of 4096 bytes'

for end in '\n' '\r\n' ''; do
    { printf '90 0\n'; line_of 4097; printf '%b' "$end"; } >input
    "$program" <input >output 2>errors
    [ $? -eq 1 ] && [ "$(cat output)" = "$(printf '1 0 0\nnan nan nan')" ] &&
        grep -q '^<stdin>:2: .*more than 4096 bytes$' errors
    verdict "a line of 4097 bytes${end:+ and $end}"
done

# 100 MB without a newline, in memory that would not hold them.
(
    # programs under AddressSanitizer cannot live with that limit
    if { (ulimit -v 50000 && "$program" --version); } >/dev/null 2>&1; then
        ulimit -v 50000
    fi
    { printf '0 0\n'; head -c 100000000 /dev/zero | tr '\0' 1; printf '\n90 0\n'; } |
        "$program" >output 2>errors
)
[ $? -eq 1 ] && [ "$(cat output)" = "$(printf '0 0 0\nnan nan nan\n1 0 0')" ] &&
    [ "$(wc -l <errors)" -eq 1 ]
verdict 'a line of 100 MB'

# ---------------------------------------------------------------------------- streams

awk 'BEGIN { for (i = 0; i < 20000; i++) printf "%.15g %.13g t%d\n", i * 0.017 - 170,
    i * 0.0089 - 89, i }' >points
"$program" points >whole
{ head -c 70001 points; sleep 0.2; tail -c +70002 points; } | "$program" | cmp -s - whole
verdict 'a pipe that pauses gives what the file gives'

while read -r line; do printf '%s\n' "$line" | "$program"; done < <(head -n 20 points) >output
head -n 20 whole | cmp -s - output
verdict 'line by line gives what the file gives'

"$program" -I whole | awk '
    { split($1 " " $2, is); i = NR - 1
      lon = is[1] - (i * 0.017 - 170); lat = is[2] - (i * 0.0089 - 89)
      if (lon < -180) lon += 360; if (lon > 180) lon -= 360
      if (lon < -1e-9 || lon > 1e-9 || lat < -1e-9 || lat > 1e-9 || $3 != "t" (NR - 1)) bad++ }
    END { exit bad > 0 || NR != 20000 }'
verdict 'there and back'

# Each question is asked only when the one before is answered; half a line waits for its end.
mkfifo questions
"$program" <questions >answers &
pid=$!
exec 3>questions
good=yes
for i in 1 2 3; do
    printf '0 0 %s\n90 ' "$i" >&3
    for _ in $(seq 100); do
        [ "$(wc -l <answers)" -lt $((2 * i - 1)) ] || break
        sleep 0.05
    done
    [ "$(wc -l <answers)" -eq $((2 * i - 1)) ] || good=no
    printf '0\n' >&3
done
exec 3>&-
wait "$pid" && [ "$good" = yes ] && [ "$(wc -l <answers)" -eq 6 ]
verdict 'each line is answered at once'

if [ -c /dev/full ]; then
    for arguments in '' '--list' '--list=json' '--help' '--version'; do
        # shellcheck disable=SC2086 # no argument or one
        echo 0 0 | "$program" $arguments >/dev/full 2>errors
        [ $? -eq 1 ] && [ "$(wc -l <errors)" -eq 1 ] &&
            grep -q '^cubemap-project: cannot write to standard output: ' errors
        verdict "disk full${arguments:+ with $arguments}"
    done
    "$program" points >/dev/full 2>errors
    [ $? -eq 1 ] && [ "$(wc -l <errors)" -eq 1 ]
    verdict 'disk full in the middle'
fi

for _ in 1 2 3 4 5 6 7 8 9 10; do cat points; done >many
{
    "$program" many 2>errors
    echo "${PIPESTATUS[0]}" >status
} | head -n 1 >output
[ "$(cat output)" = "$(head -n 1 whole)" ] && [ ! -s errors ] && [ "$(cat status)" -ge 128 ]
verdict 'a closed pipe ends it quietly'

echo 0 0 | "$program" >&- 2>errors
[ $? -eq 1 ] && [ "$(wc -l <errors)" -eq 1 ]
verdict 'closed standard output'

"$program" <&- >output 2>errors
[ $? -eq 1 ] && grep -q '^cubemap-project: cannot read <stdin>: ' errors
verdict 'closed standard input'

# ---------------------------------------------------------------------------- options

expect 'a file that is not there' 1 '' '' 'cubemap-project: cannot open nowhere: .*' nowhere
expect 'a folder' 1 '' '' 'cubemap-project: cannot read \.: .*' .
usage_error 'unknown mapping' '-m nothing: .*' -m nothing
usage_error 'unknown parameter' '-m tangent:d=1: .*' -m tangent:d=1
usage_error 'parameter out of range' '-m tangent:c=9: .*' -m tangent:c=9
usage_error 'empty mapping' '-m : .*' -m ''
usage_error 'a name that is nearly one' '-m tangnt: .*; did you mean tangent[?]' -m tangnt
usage_error 'an option that is nearly one' 'there is no option --mapings; did you mean --mapping[?]' --mapings
usage_error 'unknown frame' "--frame is 'earth', not one of geo, gl, fits, s2" --frame earth
usage_error 'digits 0' "--digits is '0', .* 1 to 17" --digits 0
usage_error 'digits 18' "--digits is '18', .*" --digits=18
usage_error 'digits 2.5' "--digits is '2.5', .*" --digits 2.5
usage_error 'digits x' "--digits is 'x', .*" --digits x
usage_error 'input form' "--input is 'polar', not lonlat or xyz" --input polar
usage_error 'output form' "--output is 'polar', not lonlat or xyz" -I --output polar
usage_error '-I with --input' '--input has no meaning with -I.*' -I --input xyz
usage_error '--output without -I' '--output has no meaning without -I.*' --output xyz
usage_error '--frame of a disc' '--frame has no meaning with -m azimuthal:lambert, .*' \
    -m azimuthal:lambert --frame geo
usage_error '--frame of a square' '--frame has no meaning with -m peirce, .*' -m peirce --frame gl
usage_error '--input of a disc' '--input has no meaning with -m square:radial, .*' \
    -m square:radial --input xyz
usage_error '--output of a square' '--output has no meaning with -m square:radial, .*' \
    -m square:radial -I --output lonlat
usage_error 'square of what' "-m square:round: after 'square:' comes one of radial.*" -m square:round
usage_error 'azimuthal of what' "-m azimuthal: after 'azimuthal:' comes one of lambert.*" -m azimuthal
usage_error 'no layout of that' '-m border:gnomonic,radial: .*whole sphere.*' -m border:gnomonic,radial
usage_error 'unknown short option' 'there is no option -x; .*' -x
usage_error 'unknown long option' 'there is no option --nothing; see .*' --nothing
usage_error 'ambiguous option' '--in is short for several options: --inverse, --input' --in
usage_error 'missing argument, short' '--mapping needs an argument.*' -m
usage_error 'missing argument, long' '--digits needs an argument.*' --digits
usage_error 'argument too many' '--float takes no argument.*' --float=1
usage_error 'two files' "one FILE at most, but 'b' follows 'a'" a b
usage_error 'a name of two lines' "-m cu[?]bic: no mapping is called 'cu[?]bic'.*" -m $'cu\nbic'
usage_error '--list of what' "--list is 'xml': .*" --list=xml
usage_error '--list json' "--list reads no file, but 'json'.*--list=json.*" --list json
export CUBEMAP_INSTRUCTIONS=abacus
expect 'instruction set that is none' 1 '' '' \
    "cubemap-project: CUBEMAP_INSTRUCTIONS is 'abacus', but here it can be scalar.*" -m qsc
export CUBEMAP_INSTRUCTIONS=scalar
expect 'instruction set' 0 '0 0\n' '0 0 0\n' ''
unset CUBEMAP_INSTRUCTIONS
expect 'short for a long option' 0 '1 2\n' '0 0.017 0.035\n' '' --mapp gnomonic --dig 2

"$program" --help >output 2>errors && grep -q '^Usage: ' output && [ ! -s errors ] &&
    [ "$(awk 'length > 100' output | wc -l)" -eq 0 ]
verdict '--help'
"$program" --version >output && grep -Eq '^cubemap-project .*[0-9]+\.[0-9]+\.[0-9]+$' output
verdict '--version'

# Every option of the help stands in the man page, and the other way round.
if [ -f "$programs/cubemap-project.1" ]; then
    "$program" --help | grep -Eo -- '--[a-z]+' | sort -u >output
    sed 's/\\-/-/g' "$programs/cubemap-project.1" | grep -Eo -- '--[a-z]+' | sort -u >wanted
    cmp -s output wanted
    verdict 'the man page has the options of --help'
fi

# ---------------------------------------------------------------------------- the Earth

expect 'a round ellipsoid is the sphere' 0 '12.5 41.9\n' \
    "$(echo 12.5 41.9 | "$program")\n" '' --ellipsoid 6378137,0
expect 'with the geographic latitude an ellipsoid is a sphere' 0 '12.5 41.9\n' \
    "$(echo 12.5 41.9 | "$program")\n" '' --ellipsoid WGS84 --latitude geographic
# authalic, conformal, rectifying latitude of 45 degrees: tests/vectors/latitudes; on face 0 in longitude 0 v of
# gnomonic is its tangent
for pair in geocentric:0.99330562001 parametric:0.996647189335 authalic:0.995531583683 \
    conformal:0.993309339535 rectifying:0.994974997545; do
    expect "${pair%:*} latitude" 0 '0 45\n' "0 0 ${pair#*:}\n" '' -m gnomonic --ellipsoid wgs84 \
        --latitude "${pair%:*}" --digits 12
done
expect 'a conformal mapping takes the conformal latitude' 0 '10 40\n' \
    "$(echo 10 40 | "$program" -m conformal --ellipsoid WGS84 --latitude conformal)\n" '' -m conformal --ellipsoid WGS84
expect 'other mappings take the authalic one' 0 '10 40\n' \
    "$(echo 10 40 | "$program" -m qsc --ellipsoid WGS84 --latitude authalic)\n" '' -m qsc --ellipsoid WGS84
"$program" --help | tr -s ' \n' '  ' | grep -q 'default: conformal if the mapping is conformal, else authalic '
verdict 'the help says so'
expect 'a latitude alone is one of WGS84' 0 '10 40\n' \
    "$(echo 10 40 | "$program" --ellipsoid WGS84 --latitude parametric)\n" '' --latitude parametric
expect 'x y z are normals' 0 '0 0 2\n1 0 1\n' "4 0 0\n$(echo 0 45 | "$program" --digits 14 --ellipsoid Mars)\n" '' \
    --digits 14 --ellipsoid Mars --input xyz
expect 'in float' 0 '0 40\n' '0 0 0.902708\n' '' --float --ellipsoid WGS84 --digits 6
expect 'a cube that looks east' 0 '90 0\n0 0\n' '0 0 0\n3 0 0\n' '' --rotate 90,0 --ellipsoid WGS84
expect 'a cube on its edge' 0 '0 0\n' '0 0 0\n' '' --rotate 0,0,45
expect 'and back' 0 '0 0 0\n4 0 0\n' '-20 30\n160 60\n' '' --rotate -20,30 -I --digits 15
expect 'a disc is turned, too' 0 '270 0\n180 0 rim\n10 90 centre\n' '0 1\n1 0 rim\n0 0 centre\n' '' -m azimuthal:lambert --rotate 90,0

# cells and pixels that the S2 library and HEALPix's programs give
expect 'the cells of S2' 0 '11.770681595 49.703498679 Weiden\n12.588490937 55.685376759\n-93.449700022 45.486546517\n' \
    '47a1cbd595522b39 Weiden\n46525318b63be0f9\n52b30b71698e729d\n' '' -m s2 --frame s2 --cell 30
expect 'the cells of S2, to the bit, where the mapping has others' 0 '180 0\n-180 0\n135 -20\n0 90\n' \
    '6fffffffffffffff\n7000000000000001\n2b4b54ccccb34d2d\n5000000000000001\n' '' -m s2 --frame s2 --cell 30:s2
expect 'cells of all levels have centres' 0 '1\n47a1cbd595522b39 Weiden\n' '0 0\n11.7706815947 49.7034986791 Weiden\n' '' \
    --cell 0 -m s2 --frame s2 -I --digits 12
expect 'the cell of a point that is none' 1 '0 91\n' 'nan\n' '<stdin>:1: .*' --cell 3
expect 'what is no cell' 1 '89c25z\n' 'nan nan\n' "<stdin>:1: '89c25z' is no cell: .*" --cell 3 -I
expect 'the token of no cell' 1 'X\n' 'nan nan\n' "<stdin>:1: 'X' means no cell" --cell 3 -I
expect 'a token that is far too long' 1 '0000000000000000000000000000000000000000000000000001\n' 'nan nan\n' \
    '<stdin>:1: .* is no cell: .*' --cell 3 -I
expect 'the pixels of HEALPix' 0 '0 0\n45 80\n-90 -45\n' '4\n0\n11\n' '' --healpix 1
expect 'pixels of 1 mm, nested' 0 '0 0\n' '1273017494670060202\n' '' --healpix 536870912:nest
expect 'NEST and NESTED are the same word' 0 '0 0\n' '282\n' '' --healpix 8:NESTED
expect 'pixels have centres' 0 '3458764513820540927 last\n' '-45 -89.9999999 last\n' '' --healpix 536870912 -I --digits 9
expect 'a pixel that there is not' 1 '12\n' 'nan nan\n' "<stdin>:1: '12' is not a pixel, from 0 to 11" --healpix 1 -I
expect 'a pixel that is no number' 1 '1x\n' 'nan nan\n' "<stdin>:1: '1x' is not a pixel, from 0 to 11" --healpix 1 -I

# there and back, on ellipsoids, rotated, by places, by cells and by pixels
awk 'BEGIN { for (i = 0; i < 4000; i++) printf "%.13g %.13g\n", i * 0.0899 - 179.7, 179.9 * ((i * 0.61803398875) % 1) - 89.95 }' >places
# back NAME DEGREES ARGUMENT...: longitudes by their length there
back()
{
    local name=$1 limit=$2
    shift 2
    "$program" "$@" places >there 2>errors && "$program" "$@" -I there >output 2>>errors && [ ! -s errors ] &&
        paste -d ' ' places output | awk -v limit="$limit" '
            { d = $1 - $3; d -= 360 * int(d / 360 + (d > 0 ? 0.5 : -0.5))
              east = d * cos($2 * 0.017453292519943295); north = $2 - $4
              if (!(east * east + north * north <= limit * limit)) { print "# " $0; bad++ } }
            END { exit NR != 4000 || bad > 0 }'
    verdict "$name"
}
back 'places on WGS84' 1e-13 --ellipsoid WGS84
back 'on Saturn, rotated' 2e-13 -m slice --ellipsoid Saturn --rotate 12,34,56
back 'on a prolate ellipsoid, conformal' 2e-13 -m conformal --ellipsoid 1,-40 --rotate 12,34,56
back 'a layout, rotated' 2e-13 -m quincuncial --ellipsoid WGS84 --rotate 12,34,56
back 'cells' 2e-7 --ellipsoid WGS84 --rotate 12,34,56 --cell 30
back 'cells on the curve of Morton' 1e-3 -m healpix --ellipsoid WGS84 --cell 18:morton
back 'pixels' 2e-7 --ellipsoid WGS84 --healpix 536870912
back 'nested pixels' 0.1 --rotate 1,2,3 --healpix 1024:nest

usage_error 'no such ellipsoid' "--ellipsoid Nowhere: .* is no ellipsoid: .*" --ellipsoid Nowhere
usage_error 'an ellipsoid without a size' '--ellipsoid 0,300: .*' --ellipsoid 0,300
usage_error 'no such latitude' "--latitude is 'x', not one of geographic, .*" --latitude x
usage_error 'no such orientation' "--rotate 1: no orientation is called '1'.*" --rotate 1
usage_error 'angles that are none' '--rotate 1,91: .*' --rotate 1,91
usage_error 'no such level' "--cell is '31': .* from 0 to 30" --cell 31
usage_error 'no such curve' "--cell is '3:peano': the curve is hilbert, morton or s2" --cell 3:peano
usage_error "S2's cells of another mapping" '--cell 3:s2 is of -m s2 --frame s2 on a sphere.*' --cell 3:s2 -m qsc
usage_error "S2's cells of an ellipsoid" '--cell 3:s2 is of -m s2 --frame s2 on a sphere.*' --cell 3:s2 -m s2 \
    --frame s2 --ellipsoid WGS84
usage_error 'half a level' "--cell is '2.5': .*" --cell 2.5
usage_error 'cells of one face' '--cell has no meaning with -m rhealpix, .*' --cell 3 -m rhealpix
usage_error 'no such nside' "--healpix is '536870913': .*" --healpix 536870913
usage_error 'no such order' "--healpix is '4:x': the order is ring or nest" --healpix 4:x
usage_error 'nested, but no power of two' '--healpix 3:nest: .*power of two.*' --healpix 3:nest
usage_error 'pixels and cells' '--cell has no meaning with --healpix, .*' --healpix 4 --cell 4
usage_error 'pixels and a mapping' '-m has no meaning with --healpix, .*' --healpix 4 -m qsc
usage_error 'pixels in float' '--float has no meaning with --healpix, .*' --healpix 4 --float
usage_error 'cells in float' '--float has no meaning with --cell, .*' --cell 4 --float
usage_error 'a disc without a sphere, on an ellipsoid' '--ellipsoid has no meaning with -m square:radial, .*' \
    -m square:radial --ellipsoid WGS84
usage_error 'a disc without a sphere, rotated' '--rotate has no meaning with -m square:radial, .*' -m square:radial \
    --rotate 1,2

# ---------------------------------------------------------------------------- catalogue

"$program" --list >output && grep -q '^coupled ' output && grep -q '^geo ' output
verdict '--list'
[ "$(grep -c ':$' output)" -eq 8 ] && grep -q '^    also       peirce (stereographic,conformal)$' output &&
    grep -q '^    also       square:concentric$' output && grep -q '^    parts      border:AZ' output &&
    grep -q '^octahedral .* -  *octahedron' output
verdict '--list by kinds'
if command -v python3 >/dev/null; then
    "$program" --list=json >catalogue.json && python3 - >names <<'PYTHON'
import json
catalogue = json.load(open("catalogue.json"))
identifiers = [mapping["identifier"] for mapping in catalogue["mappings"]]
assert catalogue["recommended"] in identifiers
assert [frame["identifier"] for frame in catalogue["frames"]] == ["geo", "gl", "fits", "s2"]
for frame in catalogue["frames"]:
    assert len(frame["faces"]) == 6 and abs(frame["first_row_v"]) == 1
for mapping in catalogue["mappings"]:
    for key in ("name", "source", "family", "smooth_face"):
        assert mapping[key], key
    assert mapping["kind"] in ("cube", "disc-square", "azimuthal", "layout")
    assert (mapping["smooth_edge"] is None) == (mapping["kind"] != "cube")
    assert mapping["parts"] is None or mapping["kind"] == "layout"
    assert isinstance(mapping["equal_area"], bool) and isinstance(mapping["conformal"], bool)
    # none is stated where what is near the axes is not near 0, and of round trips where the map is flat
    assert all(bound > 0 or (key in ("relative", "round_trip") and mapping["kind"] != "cube")
               for key, bound in mapping["bounds_eps"].items())
    for parameter in mapping["parameters"]:
        assert parameter["low"] <= parameter["standard"] <= parameter["high"]
    for name in [mapping["identifier"]] + mapping["aliases"]:
        # as it can be given: values and parts behind the last colon belong to the alias
        fixes = "=" in name or "," in name
        print(mapping["kind"], name.rpartition(":")[0] if fixes else name)
kinds = {mapping["identifier"]: mapping["kind"] for mapping in catalogue["mappings"]}
assert kinds["coupled"] == "cube" and kinds["square:radial"] == "disc-square"
assert kinds["azimuthal:lambert"] == "azimuthal" and kinds["octahedral"] == "layout"
PYTHON
    verdict '--list=json'

    # The last of the points are in every field of view; on the disc there are others.
    good=yes
    tail -n 2000 points >north
    if [ -f "$root/docs/guide/projections.md" ]; then
        python3 - "$root/docs/guide/projections.md" "$root/tests/bits.txt" <<'PYTHON'
import json, sys
page = open(sys.argv[1], encoding="utf-8").read()
released = {line.split()[1] for line in open(sys.argv[2], encoding="utf-8")}
assert len(released) >= 30
for mapping in json.load(open("catalogue.json"))["mappings"]:
    name = mapping["identifier"] + (":" + mapping["parts"] if mapping["parts"] else "")
    assert mapping["identifier"] not in released or f"`{name}`" in page or f"`{name}:" in page, name
PYTHON
        verdict 'every released mapping is in docs/guide/projections.md'
    fi
    awk '{ print $1 / 250, $2 / 250, $3 }' north >disc
    while read -r kind name; do
        here=north
        [ "$kind" != disc-square ] || here=disc
        "$program" -m "$name" $here >faces 2>errors && "$program" -m "$name" -I faces >output 2>>errors &&
            [ "$(wc -l <output)" -eq 2000 ] && [ ! -s errors ] || good="no: $name"
    done <names
    [ "$good" = yes ] && [ "$(wc -l <names)" -ge 33 ]
    verdict 'every name of the catalogue can be given'
fi

finish
