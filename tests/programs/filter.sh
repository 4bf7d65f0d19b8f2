# shellcheck shell=bash
# SPDX-License-Identifier: MIT
#
# What the tests of filters, cubemap-project and cubemap-latitude, have in common: what those of all programs have,
# and a filter's input, output and messages.
#
# usage: . filter.sh NAME PROGRAMS
#   NAME      of the program
#   PROGRAMS  folder with the built programs
# shellcheck source-path=SCRIPTDIR source=cases.sh
. "$(dirname "${BASH_SOURCE[0]}")/cases.sh" "$2"
filter=$1
program=$programs/$filter

# verdict NAME: the status of the command before decides.
verdict()
{
    result "$?" "$1"
}

# expect NAME STATUS INPUT OUTPUT MESSAGE [ARGUMENT...]: INPUT and OUTPUT are as printf %b has them;
# MESSAGE is an extended regular expression that all of standard error, a single line, must match,
# or empty for silence.
expect()
{
    local name=$1 status=$2 input=$3 output=$4 message=$5 got good=yes
    shift 5
    printf '%b' "$input" >input
    printf '%b' "$output" >wanted
    "$program" "$@" <input >output 2>errors
    got=$?
    [ "$got" -eq "$status" ] || good=no
    cmp -s wanted output || good=no
    if [ -z "$message" ]; then
        [ ! -s errors ] || good=no
    else
        { [ "$(wc -l <errors)" -eq 1 ] && grep -Eq -- "^$message\$" errors; } || good=no
    fi
    if [ "$good" = yes ]; then
        result 0 "$name"
    else
        result 1 "$name" "$(printf 'status %s, wanted %s\n' "$got" "$status"
            diff wanted output
            printf 'messages (wanted: %s):\n' "$message"
            cat errors)"
    fi
}

# usage_error NAME MESSAGE ARGUMENT...: status 2, nothing on standard output.
usage_error()
{
    local name=$1 message=$2
    shift 2
    expect "$name" 2 '0 0\n' '' "$filter: $message" "$@"
}
