#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The libraries as DLLs of mingw-w64's compiler, without optimisation and without vectors: they compile without a warning,
# and export what the headers declare. Without that compiler (apt: gcc-mingw-w64-x86-64) it ends with 77 and is skipped.
# Usage: dll.sh REPOSITORY PYTHON
set -eu
root=$1 python=$2
prefix=x86_64-w64-mingw32
if ! command -v "$prefix-gcc" >/dev/null || ! command -v "$prefix-objdump" >/dev/null; then
    echo "$prefix-gcc is missing (apt: gcc-mingw-w64-x86-64)"
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# dll NAME USES SOURCE...: NAME.dll, which uses the DLLs of those names
dll() {
    local name=$1 uses=() each
    for each in $2; do
        uses+=("$folder/lib$each.dll.a")
    done
    shift 2
    mkdir "$folder/$name"
    (cd "$folder/$name" && printf '%s\0' "$@" | xargs -0 -n 8 -P 4 "$prefix-gcc" -c -std=c11 -O0 -Wall -Wextra \
        -Wpedantic -Wconversion -Wno-float-conversion -Wshadow -Werror -DCM_BUILD -I"$root/include" -I"$root")
    "$prefix-gcc" -shared -static -o "$folder/$name.dll" "$folder/$name"/*.o "${uses[@]}" \
        -Wl,--out-implib,"$folder/lib$name.dll.a"
}

# plain SOURCE...: those that are of no instruction set, to the array plain
plain() {
    plain=()
    for source in "$@"; do
        case $source in
        *_sse2.c | *_avx2.c | *_avx512.c | *_neon.c | *_wasm128.c | *_small.c) ;;
        *) plain+=("$source") ;;
        esac
    done
}
plain "$root"/libcubemap/*/*.c
dll cubemap "" "${plain[@]}"
plain "$root"/modules/image/*.c
dll cubemap-image cubemap "${plain[@]}"
dll cubemap-colormap cubemap "$root"/modules/colormap/*.c
plain "$root"/modules/scene/*.c
dll cubemap-scene 'cubemap cubemap-image' "${plain[@]}"
plain "$root"/modules/octree/*.c
dll cubemap-octree 'cubemap cubemap-image cubemap-scene' "${plain[@]}"
plain "$root"/modules/sim/*.c
dll cubemap-sim 'cubemap cubemap-image cubemap-scene' "${plain[@]}"
for name in cubemap cubemap-colormap cubemap-image cubemap-scene cubemap-octree cubemap-sim; do
    "$python" "$root/tests/include/check_exports.py" --library "$name" "$prefix-objdump" "$folder/$name.dll" "$root/include"
done
