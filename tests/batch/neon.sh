#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The library, check-paths, and the tests of bits, of sets and of loops over pixels for AArch64, on any machine:
# cross-compiled, and run by an emulator. Without them (apt: gcc-aarch64-linux-gnu qemu-user) it ends with 77 and is skipped.
# Usage: neon.sh REPOSITORY [ARGUMENT OF check-paths...]
set -eu
root=$1
shift
compiler=aarch64-linux-gnu-gcc
emulator=
for name in qemu-aarch64 qemu-aarch64-static; do
    ! command -v "$name" >/dev/null || emulator=$name
done
if ! command -v "$compiler" >/dev/null || [[ -z $emulator ]]; then
    echo "$compiler or qemu-aarch64 is missing (apt: gcc-aarch64-linux-gnu qemu-user)"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# as meson.build has them
flags=(-std=c11 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -ffp-contract=off
    -fno-math-errno -fno-trapping-math -DCM_HAVE_NEON -DCM_HAVE_PTHREADS -DWITHOUT_CHECK)
sources=()
for source in "$root"/libcubemap/*/*.c; do
    case ${source##*/} in
    set_sse2.c | set_avx2.c | set_avx512.c | lone_sse2.c | lone_avx2.c | lone_avx512.c) ;;
    *) sources+=("$source") ;;
    esac
done

sampling=("$root"/modules/image/{filter_weights,sample_set,sample_set_scalar,sample_set_neon}.c)

# compile SOURCE: an object whose name says which folder it is of
compile()
{
    local name=${1#"$root"/}
    "$compiler" "${flags[@]}" -I"$root/include" -I"$root" -c "$1" -o "$folder/${name//\//-}.o"
}

running=()
for source in "${sources[@]}" "$root"/tests/paths/*.c "$root"/tests/mapping/test_bits.c \
    "$root"/tests/batch/test_sets.c "${sampling[@]}" "$root"/tests/image/test_sample_set.c; do
    compile "$source" &
    running+=($!)
done
for process in "${running[@]}"; do
    wait "$process"
done
for program in tests-paths tests-mapping-test_bits tests-batch-test_sets; do
    "$compiler" -static "$folder"/libcubemap-*.o "$folder/$program"*.o -lm -lpthread \
        -o "$folder/$program"
done
"$compiler" -static "$folder"/{libcubemap,modules-image}-*.o "$folder"/tests-image-test_sample_set*.o -lm -lpthread \
    -o "$folder/test-sample-set"
"$emulator" "$folder/tests-mapping-test_bits" "$root/tests/bits.txt"
"$emulator" "$folder/tests-batch-test_sets" 5000
"$emulator" "$folder/test-sample-set"
"$emulator" "$folder/tests-paths" --set neon "$@"
