#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The library, check-paths, the tests of bits and of sets, pictures, depth cameras and maps for AArch64, on any machine:
# cross-compiled, and run by an emulator. Without them (apt: gcc-aarch64-linux-gnu qemu-user) it ends with 77 and is skipped.
# With --quick, of pictures the tests of loops and of levels, which go through surfaces, geometry, borders and resampling; else
# all tests of tests/image, and of tests/scene and tests/octree those that use their loops and take minutes, each a part of the many that it has.
# Usage: neon.sh REPOSITORY [ARGUMENT OF check-paths...]
set -eu
root=$1
shift
quick=
for argument in "$@"; do
    [[ $argument != --quick ]] || quick=1
done
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
    set_sse2.c | set_avx2.c | set_avx512.c | lone_sse2.c | lone_avx2.c | lone_avx512.c | *_wasm128.c | set_small.c) ;;
    *) sources+=("$source") ;;
    esac
done

pictures=()
for source in "$root"/modules/image/*.c; do
    case ${source##*/} in
    *_sse2.c | *_avx2.c | *_avx512.c) ;;
    brdf* | compare_* | environment* | flip* | gauss_* | harmonics* | image_jobs.c)
        [[ -n $quick ]] || pictures+=("$source")
        ;;
    *) pictures+=("$source") ;;
    esac
done
picture_tests=("$root"/tests/image/test_{halving,mips,sample_set,six_points}.c)
if [[ -z $quick ]]; then
    picture_tests=("$root"/tests/image/test_*.c)
    pictures+=("$root"/tests/image/{drawn_scene,own_flip}.c "$root"/truth/{analytic_scene,scene_errors,scene_surface}.c)
fi

# Depth cameras, and maps of what they see: without --quick, which compiles their loops. What runs in children or reads files
# stays out.
scenes=("$root"/modules/{scene,octree}/*_neon.c)
scene_tests=()
if [[ -z $quick ]]; then
    scenes=("$root"/tests/octree/dense_map.c "$root"/truth/room_views.c "$root"/truth/scenes/ray_truth.c)
    for source in "$root"/modules/{scene,octree}/*.c; do
        case ${source##*/} in
        *_sse2.c | *_avx2.c | *_avx512.c) ;;
        *) scenes+=("$source") ;;
        esac
    done
    scene_tests=("$root"/tests/scene/test_{camera,depth,depth_window,lens,pool,raster,raster_cover,world}.c
        "$root"/tests/octree/test_{hull,octree_merge,octree_promises,octree_queries}.c)
fi

# compile SOURCE: an object whose name says which folder it is of; tests of pictures without vectors of their own, in which
# gcc 12 has an internal error (vect_transform_reduction)
compile()
{
    local name=${1#"$root"/} more=()
    [[ $name != tests/image/* ]] || more=(-O1)
    "$compiler" "${flags[@]}" "${more[@]}" -I"$root/include" -I"$root" -c "$1" -o "$folder/${name//\//-}.o"
}

running=()
for source in "${sources[@]}" "$root"/tests/paths/*.c "$root"/tests/mapping/test_bits.c \
    "$root"/tests/batch/test_sets.c "${pictures[@]}" "${picture_tests[@]}" \
    "${scenes[@]}" "${scene_tests[@]}"; do
    compile "$source" &
    running+=($!)
    if ((${#running[@]} >= 8)); then
        wait "${running[0]}"
        running=("${running[@]:1}")
    fi
done
for process in "${running[@]}"; do
    wait "$process"
done
for program in tests-paths tests-mapping-test_bits tests-batch-test_sets; do
    "$compiler" -static "$folder"/libcubemap-*.o "$folder/$program"*.o -lm -lpthread \
        -o "$folder/$program"
done
objects=()
for source in "${pictures[@]}"; do
    name=${source#"$root"/}
    objects+=("$folder/${name//\//-}.o")
done
for test in "${picture_tests[@]}"; do
    name=${test##*/}
    "$compiler" -static "$folder"/libcubemap-*.o "${objects[@]}" "$folder/tests-image-$name.o" -lm -lpthread \
        -o "$folder/${name%.c}"
done
for source in "${scenes[@]}"; do
    name=${source#"$root"/}
    objects+=("$folder/${name//\//-}.o")
done
# what is asked for alone is linked: of pictures a module takes a part
ar rcs "$folder/libmodules.a" "${objects[@]}"
for test in "${scene_tests[@]}"; do
    name=${test#"$root"/}
    object=$folder/${name//\//-}.o
    name=${test##*/}
    "$compiler" -static "$object" "$folder/libmodules.a" "$folder"/libcubemap-*.o -lm -lpthread \
        -o "$folder/${name%.c}"
done
"$emulator" "$folder/tests-mapping-test_bits" "$root/tests/bits.txt"
"$emulator" "$folder/tests-batch-test_sets" 5000
for test in "${picture_tests[@]}" "${scene_tests[@]}"; do
    name=${test##*/}
    CUBEMAP_QUICK_TESTS=1 "$emulator" "$folder/${name%.c}"
done
"$emulator" "$folder/tests-paths" --set neon "$@"
