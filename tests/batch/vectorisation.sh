#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The machine code of the batch loops: every mapping has its four loops (forward, inverse and their
# Jacobians) in every instruction set, in double and in float, and forward and inverse in the fast tier;
# they work on vectors of the set's width, and nothing in them is a call (which would be a kernel that was
# not inlined, or a function of libm); and so with latitudes. Writes how many divisions and square roots each has for a vector.
# Usage: vectorisation.sh BUILD_FOLDER INCLUDE_FOLDER SET...
set -eu
build=$1 include=$2
shift 2
if ! command -v objdump >/dev/null; then
    echo "objdump is missing (apt: binutils)"
    exit 77
fi

# NAME COUNT: the identifiers of the catalogue's rooms and the number of their variants
rooms=$(sed -n 's/^#include "\(.*\)"$/\1/p' "$include/cubemap/kernel/kernel_catalogue.h" | while read -r file; do
    sed -n 's/^CM_WARP_VARIANTS(\([a-z0-9_]*\),.*/\1 2/p; s/^CM_\(WARP\|WARP_ASYMMETRIC\|WARP_UNDERFLOW\|SPHERE\)(\([a-z0-9_]*\),.*/\2 1/p' \
        "$include/cubemap/kernel/$file"
done)
variants=$(echo "$rooms" | awk '{sum += $2} END {print sum}')
# and the loops of the parts of maps: four of a projection to the disc, three of a mapping to the square
parts=$(cat "$include"/cubemap/kernel/*.h |
    awk '/^CM_AZIMUTHAL\(/ {sum += 4} /^CM_SQUARE\(/ {sum += 3} END {print sum}')

status=0
for set in "$@"; do
    case $set in
    sse2) register='%xmm' packed='(mul|add|div)p' ;;
    avx2) register='%ymm' packed='v(mul|add|div|fn?m[a-z0-9]*)p' ;;
    avx512) register='%zmm' packed='v(mul|add|div|fn?m[a-z0-9]*)p' ;;
    neon) register='v[0-9]+[.](2d|4s)' packed='f(mul|add|div|mla|mls) ' ;;
    esac
    object=$build/libcubemap/libcubemap-$set.a.p/batch_set_$set.c.o
    for precision in in_f64 in_f32 fast; do
        expected=$((2 * variants))
        expected_parts=$parts
        [[ $precision != fast ]] || expected=$variants expected_parts=0
        objdump -d --no-show-raw-insn "$object" | awk -v set="$set" -v precision="$precision" \
            -v register="$register" -v packed="$packed" -v expected="$expected" \
            -v expected_parts="$expected_parts" '
            function finish() {
                if (name == "") return
                if (vectors < 4) { print set ": " name " has no loop of vectors"; bad = 1 }
                if (vectors >= 4 && !folded) {
                    gsub(/^<|_in_f[0-9]+>:$|>:$/, "", name)
                    print set ", " precision ": " name ": " divisions " divisions, " roots " roots"
                }
                name = ""
            }
            /^[0-9a-f]+ <.*>:$/ {
                finish()
                if ($2 ~ "^<(forward|inverse|azimuthal|square)_.*_" precision ">:$") {
                    name = $2; vectors = divisions = roots = folded = 0; found[substr(name, 2, 7)]++
                }
            }
            name != "" && /call|\tbl / { print set ": " name " calls: " $0; bad = 1 }
            # compilers fold functions with the same code into one
            name != "" && /jmp.*<(forward|inverse|azimuthal|square)_[a-z0-9_]*>$/ { vectors = 4; folded = 1 }
            name != "" && /\tv?f?div/ { divisions++ }
            name != "" && /\tv?f?sqrt/ { roots++ }
            name != "" && $0 ~ packed && $0 ~ register { vectors++ }
            END {
                finish()
                print set ", " precision ": " found["forward"] " forward and " found["inverse"] \
                    " inverse loops, " expected " expected"
                found_parts = found["azimuth"] + found["square_"]
                print set ", " precision ": " found_parts " loops of parts, " expected_parts " expected"
                exit bad || found["forward"] != expected || found["inverse"] != expected || \
                    found_parts != expected_parts
            }' || status=1
    done

    # the loops of latitudes, in double only: five of angles and four of directions
    objdump -d --no-show-raw-insn "$object" | awk -v set="$set" -v register="$register" -v packed="$packed" '
        function finish() {
            if (name != "" && vectors < 10) { print set ": " name " has no loop of vectors"; bad = 1 }
            name = ""
        }
        /^[0-9a-f]+ <.*>:$/ {
            finish()
            if ($2 ~ "^<latitude_(angles|directions)_[a-z0-9_]*>:$") { name = $2; vectors = 0; found++ }
        }
        name != "" && /call|\tbl / { print set ": " name " calls: " $0; bad = 1 }
        name != "" && $0 ~ packed && $0 ~ register { vectors++ }
        END { finish(); print set ": " found " loops of latitudes, 9 expected"; exit bad || found != 9 }' || status=1
done
exit $status
