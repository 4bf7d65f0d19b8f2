#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# cubemap-latitude as a user meets it.
#
# usage: latitude.sh PROGRAMS
#   PROGRAMS  folder with the built programs
# shellcheck source-path=SCRIPTDIR source=filter.sh
. "$(dirname "$0")/filter.sh" cubemap-latitude "${1:?usage: latitude.sh PROGRAMS}"

# bad_line NAME INPUT MESSAGE [ARGUMENT...]: the third of five lines is bad, the others are not.
bad_line()
{
    local name=$1 input=$2 message=$3
    shift 3
    expect "$name" 1 "0\n# c\n$input\n\n0\n" "0\n# c\nnan\n\n0\n" "<stdin>:3: $message" --to authalic "$@"
}

latitudes='geographic geocentric parametric authalic conformal rectifying authalic-approximation'

# ---------------------------------------------------------------------------- latitudes

# with 40 digits, from the definitions
expect 'authalic latitude of the Earth' 0 '45\n41.9 Rome\n' '44.8717028734339\n41.7724794979577 Rome\n' '' \
    --to authalic --digits 15
expect 'back' 0 '44.8717028734339407\n' '45\n' '' --from authalic --to geographic --digits 15
expect 'on Mars' 0 '30\n' '30.2938\n' '' -e Mars -f geocentric -t geographic --digits 6
expect 'far from a sphere' 0 '26.565051177077990\n' '45\n' '' -e 1,2 --from parametric --to geographic \
    --digits 14
expect 'beside the pole of a needle' 0 '89.9999999999999\n90\n-90\n0\n' \
    '89.9999999990054\n90\n-90\n0\n' '' -e 1,-0.010102 --from geocentric --to geographic --digits 15
expect 'a name in another case' 0 '45\n' '44.871703\n' '' --ellipsoid wgs84 --to Authalic --digits 8
expect 'an ellipsoid by its axes' 0 '45\n45\n' '44.87170287343394\n44.87170287343394\n' '' \
    --ellipsoid 6378137,1/298.257223563 --to authalic --digits 16
expect 'radians' 0 '0.78539816339744831\n1.5707963267948966\n' '0.78315895612\n1.5707963268\n' '' \
    --radians --to authalic --digits 11
expect 'exactly' 0 '45\n' '44.87170287343\n' '' --to authalic --exact --digits 13
expect 'no more terms than needed' 0 '45\n' '44.871703\n' '' --to authalic --tolerance 1e-6 --digits 8
for from in $latitudes; do
    for to in $latitudes; do
        expect "ends, $from to $to" 0 '90\n-90\n0\n-0\n+90.0 x\n' '90\n-90\n0\n0\n90 x\n' '' \
            --from "$from" --to "$to"
        expect "on the Moon, $from to $to" 0 '41.9\n0.1\n-89.3\n1e-300\n' '41.9\n0.1\n-89.3\n1e-300\n' '' \
            --from "$from" --to "$to" --ellipsoid Moon --digits 16
    done
done

# Every latitude there and back, as text: within 6e-14 degrees.
seq -90 0.7 90 >places
worst=$(for ellipsoid in WGS84 Saturn 1,3 1,-2; do
    for to in $latitudes; do
        "$program" -e $ellipsoid --to "$to" places | "$program" -e $ellipsoid --from "$to" --to geographic |
            paste - places | awk '{d = $1 - $2; d = d < 0 ? -d : d; if (d > 0) print d}'
    done
done | sort -g | tail -1)
awk -v w="$worst" 'BEGIN {exit !(w < 6e-14)}'
verdict "there and back: $worst degrees"

# ---------------------------------------------------------------------------- lines

expect 'what is no number passes' 0 '\n# comment\n  \n 0\ttail  end \n' '\n# comment\n  \n0\ttail  end \n' '' \
    --to authalic
expect 'CR LF' 0 '0\r\n0 x\r\n' '0\r\n0 x\r\n' '' --to authalic
expect 'no line feed at the end' 0 '0' '0\n' '' --to authalic
expect 'nothing' 0 '' '' '' --to authalic
expect 'a comma behind' 0 '0,5\n' '0,5\n' '' --to authalic
printf '0\n' >file
expect 'a file' 0 '1\n' '0\n' '' --to authalic file
expect 'standard input by its name' 0 '0\n' '0\n' '' --to authalic -
bad_line 'a word' 'rome' "'rome' is not a number: a line is a LATITUDE in degrees"
bad_line 'beyond the pole' '90.0000001' 'the latitude, 90.0000000999[0-9]*, is not in \[-90, 90\]'
bad_line 'nan' 'nan' 'the latitude, nan, is not in \[-90, 90\]'
bad_line 'infinite' '-inf' 'the latitude, -inf, is not in \[-90, 90\]'
bad_line 'beyond the pole in radians' '1.5708' 'the latitude, 1.5708, is not in \[-pi/2, pi/2\]' --radians
[ "$(echo '91 x' | "$program" --to authalic 2>/dev/null)" = 'nan x' ]
verdict 'rests of bad lines stay'

# ---------------------------------------------------------------------------- usage

usage_error 'no --to' '--to is missing: the latitude to write; see --list'
usage_error 'no such latitude' "--to is 'geodetic', not one of geographic, .*" --to geodetic
usage_error 'no such source' "--from is '', not one of geographic, .*" --from '' --to authalic
usage_error 'no such ellipsoid' "--ellipsoid: 'WGS85' is no ellipsoid: .*; did you mean WGS84[?]" --to authalic -e WGS85
usage_error 'a flattening of 1' '--ellipsoid: the inverse flattening 1 is out of range: .*' --to authalic -e 1,1
usage_error 'a tolerance of nothing' "--tolerance is '0', not a number above 0" --to authalic --tolerance 0
usage_error 'a tolerance that is none' "--tolerance is '1m', not a number above 0" --to authalic --tolerance 1m
usage_error 'a tolerance of closed forms' '--tolerance has no meaning with --exact, .*' --to authalic --exact \
    --tolerance 1
usage_error 'no digits' "--digits is '18', not a whole number from 1 to 17" --to authalic --digits 18
usage_error 'no such option' 'there is no option --deg.*' --to authalic --deg
usage_error 'no argument' '--to needs an argument.*' --to
usage_error 'two files' "one FILE at most, but 'b' follows 'a'" --to authalic a b
usage_error 'a list of a file' "--list reads no file, but 'a' is given" --list a
expect 'no such file' 1 '' '' 'cubemap-latitude: cannot open missing: No such file or directory' --to authalic missing
"$program" --to authalic >/dev/full 2>errors <file
[ $? -eq 1 ] && grep -q '^cubemap-latitude: cannot write to standard output: ' errors
verdict 'a full device'
CUBEMAP_INSTRUCTIONS=mmx "$program" --to authalic <file 2>errors
[ $? -eq 1 ] && grep -q "CUBEMAP_INSTRUCTIONS is 'mmx'" errors
verdict 'an instruction set that is none'
"$program" --help | grep -q '^Usage: cubemap-latitude '
verdict 'help'
"$program" --version | grep -q '^cubemap-latitude (libcubemap) [0-9]'
verdict 'version'
"$program" --list | awk '/^$/ {tables++} tables == 1 && !/^Ellipsoids|^$/ {print $1}' >names
unknown=$(while read -r name; do
    echo 0 | "$program" --to authalic -e "$name" >/dev/null || echo "$name"
done <names)
[ "$(wc -l <names)" -ge 40 ] && [ -z "$unknown" ]
verdict 'the list names what can be given'

finish
