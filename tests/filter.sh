# shellcheck shell=bash
# SPDX-License-Identifier: MIT
#
# What the tests of filters, cubemap-project and cubemap-latitude, have in common: a folder to work in, cases, and a
# filter's input, output and messages.
#
# usage: . filter.sh NAME PROGRAMS
#   NAME      of the program
#   PROGRAMS  folder with the built programs
set -u
LC_ALL=C
export LC_ALL

filter=$1
programs=$(cd "$2" && pwd) || exit 1
program=$programs/$filter
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cases=0
failures=0

ok()
{
    cases=$((cases + 1))
    echo "ok $cases - $1"
}

# not_ok NAME [WHAT WAS SEEN]
not_ok()
{
    cases=$((cases + 1))
    failures=$((failures + 1))
    echo "not ok $cases - $1"
    [ $# -lt 2 ] || printf '%s\n' "$2" | sed 's/^/# /'
}

# verdict NAME: the status of the command before decides.
verdict()
{
    if [ "$?" -eq 0 ]; then ok "$1"; else not_ok "$1"; fi
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
        ok "$name"
    else
        not_ok "$name" "$(printf 'status %s, wanted %s\n' "$got" "$status"
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

# The end of a test.
finish()
{
    echo "$cases cases, $failures failed"
    [ "$failures" -eq 0 ]
}
