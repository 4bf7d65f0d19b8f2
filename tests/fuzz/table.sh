#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The table of tests/fuzz/README.md: every function that the library exports is in it, every harness
# in it calls its function, and every harness is built and has first inputs.
# Usage: table.sh REPOSITORY
set -eu
root=$1
fuzz=$root/tests/fuzz
failed=0

complain()
{
    echo "not ok: $*"
    failed=1
}

# "FUNCTION HARNESS" for each harness of each row
rows=$(sed -n 's/^| `\([a-z0-9_]*\)`[^|]* | \(`.*`\) |$/\1 \2/p' "$fuzz/README.md" |
    while read -r function harnesses; do
        for harness in $(tr -d '`,' <<<"$harnesses"); do
            echo "$function $harness"
        done
    done)

# declarations may go over several lines; the name is the word before the first parenthesis
exported=$(cat "$root"/include/cubemap/*.h | tr '\n' ' ' | sed 's/CM_API/\n&/g' |
    sed -n 's/^CM_API[^(;]*[ *]\(cm_[a-z0-9_]*\)(.*/\1/p' | sort)
for function in $exported; do
    grep -q "^$function " <<<"$rows" || complain "$function is in no row of the table"
done

while read -r function harness; do
    name=${harness%.*}
    name=${name#fuzz_}
    if [[ $function == cm_* ]] && ! grep -qx "$function" <<<"$exported"; then
        complain "$function is in the table, but not in the library"
    elif [[ ! -f $fuzz/$harness ]]; then
        complain "$harness is in the table, but there is no such file"
    elif ! sed 's,/\*.*\*/,,; s,//.*,,; /^ \*/d' "$fuzz/$harness" | grep -qw "$function"; then
        complain "$harness does not call $function"
    elif [[ -z $(find "$fuzz/corpus/$name" -type f 2>/dev/null) ]]; then
        complain "$harness has no first inputs in corpus/$name"
    elif ! grep -qE "'(fuzz-|fuzz_)?$name(\.c)?'" "$fuzz/meson.build"; then
        complain "$harness is not built by meson.build"
    fi
done <<<"$rows"

for file in "$fuzz"/fuzz_*.c "$fuzz"/fuzz_*.cpp; do
    grep -q " ${file##*/}$" <<<"$rows" || complain "${file##*/} is in no row of the table"
done

echo "$(wc -w <<<"$exported") functions of the library"
echo "$(cut -d' ' -f2 <<<"$rows" | sort -u | wc -l) harnesses"
test "$(wc -w <<<"$exported")" -ge 30
exit "$failed"
