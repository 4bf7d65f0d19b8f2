# shellcheck shell=bash disable=SC2034 # what is for the tests
# SPDX-License-Identifier: MIT
#
# What the tests of programs have in common: a folder to work in, which goes at the end, and cases, a line each,
# "ok NUMBER - NAME" or "not ok NUMBER - NAME" and what was seen.
#
# usage: . cases.sh PROGRAMS
#   PROGRAMS  folder with the built programs
# Afterwards the shell is in the folder to work in; $programs is absolute.
set -u
LC_ALL=C
export LC_ALL

programs=$(cd "$1" && pwd) || exit 1
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
cases=0
failures=0

# result STATUS NAME [WHAT WAS SEEN]
result()
{
    cases=$((cases + 1))
    if [ "$1" -eq 0 ]; then
        echo "ok $cases - $2"
    else
        failures=$((failures + 1))
        echo "not ok $cases - $2"
        [ -z "${3-}" ] || printf '%s\n' "$3" | sed 's/^/# /'
    fi
}

# The end of a test, and its status: no case is a failure, too.
finish()
{
    echo "$cases cases, $failures failed"
    [ "$cases" -gt 0 ] && [ "$failures" -eq 0 ]
}
