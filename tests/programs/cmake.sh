#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The library as projects with CMake get it: installed into an empty folder, found by find_package, linked with the target of
# each kind; the C program of the README compiles and prints what the README says, and another version is refused. Without
# CMake it ends with 77 and is skipped.
# Usage: cmake.sh REPOSITORY BUILD_FOLDER C_COMPILER KINDS MESON...   KINDS: static, shared or both
set -eu
root=$1 build=$2 cc=$3 kinds=$4
shift 4
if ! command -v cmake >/dev/null; then
    echo "cmake is missing (apt: cmake)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
quietly() { # quietly COMMAND...: its output only if it fails
    "$@" >"$work/log" 2>&1 || {
        cat "$work/log"
        return 1
    }
}
quietly "$@" install -C "$build" --no-rebuild --destdir "$work/root"
config=$(find "$work/root" -name cubemap-config.cmake)
test -n "$config"
# moved as a whole, it is still found
moved="$work/a folder with blanks"
mv "$work/root" "$moved"
config="$moved${config#"$work/root"}"

block() { # block LANGUAGE: the README's first block of code in that language
    awk -v fence="\`\`\`$1" '$0 == fence && !done { inside = 1; next }
        $0 == "```" && inside { inside = 0; done = 1 }
        inside' "$root/README.md"
}
mkdir "$work/project"
block c >"$work/project/example.c"
block output >"$work/expected"
test -s "$work/project/example.c" && test -s "$work/expected"
echo '#include <cubemap/colormap.h>
#include <stddef.h>
int main(void) { return cm_colormap_count() > 0 ? 0 : 1; }' >"$work/project/colours.c"
echo '#include <cubemap/image.h>
#include <stddef.h>
int main(void)
{
    cm_surface *surface = NULL;
    const cm_surface_options options = {.size = sizeof options, .width = 8};
    cm_status status = cm_surface_create("cube:coupled", &options, &surface);
    cm_surface_destroy(surface);
    return status == CM_OK ? 0 : 1;
}' >"$work/project/pictures.c"
echo '#include <cubemap/octree.h>
#include <cubemap/world.h>
#include <stddef.h>
int main(void)
{
    cm_scene *scene = NULL;
    cm_status status = cm_scene_create_named("room", &scene);
    cm_scene_destroy(scene);
    return status == CM_OK && cm_octree_create(NULL, NULL) == CM_ERROR_ARGUMENT ? 0 : 1;
}' >"$work/project/maps.c"
echo '#include <cubemap/sim.h>
#include <cubemap/world.h>
#include <stddef.h>
int main(void)
{
    cm_scene *scene = NULL;
    cm_tof_scene *tof = NULL;
    cm_status status = cm_scene_create_named("room", &scene);
    status = status == CM_OK ? cm_tof_scene_create(scene, &tof) : status;
    cm_tof_scene_destroy(tof);
    cm_scene_destroy(scene);
    return status == CM_OK ? 0 : 1;
}' >"$work/project/light.c"

targets=cubemap
[ "$kinds" != both ] || targets='cubemap cubemap-static'
cat >"$work/project/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.12)
project(example C)
find_package(cubemap ${WANTED} CONFIG REQUIRED)
find_package(cubemap CONFIG REQUIRED) # a second time
separate_arguments(TARGETS)
foreach(target IN LISTS TARGETS)
    add_executable(example-${target} example.c)
    target_link_libraries(example-${target} PRIVATE cubemap::${target})
endforeach()
if(TARGET cubemap::cubemap-colormap)
    add_executable(colours colours.c)
    target_link_libraries(colours PRIVATE cubemap::cubemap-colormap)
endif()
foreach(kind "" -static)
    if(TARGET cubemap::cubemap-image${kind})
        add_executable(pictures${kind} pictures.c)
        target_link_libraries(pictures${kind} PRIVATE cubemap::cubemap-image${kind})
        add_executable(maps${kind} maps.c)
        target_link_libraries(maps${kind} PRIVATE cubemap::cubemap-octree${kind})
    endif()
    if(TARGET cubemap::cubemap-sim${kind})
        add_executable(light${kind} light.c)
        target_link_libraries(light${kind} PRIVATE cubemap::cubemap-sim${kind})
    endif()
endforeach()
END
configure() { # configure VERSION
    rm -rf "$work/out"
    cmake -S "$work/project" -B "$work/out" -DCMAKE_C_COMPILER="$cc" "-DTARGETS=$targets" "-DWANTED=$1" \
        -DCMAKE_C_FLAGS="-Wall -Wextra -Wpedantic -Werror" "-Dcubemap_DIR=${config%/*}"
}
version=$(sed -n 's/^#define CM_VERSION_STRING "\(.*\)"$/\1/p' "$root/include/cubemap/version.h")
for refused in 0.0.1 0.99 1 "$version.1 EXACT"; do
    if quietly configure "$refused" >/dev/null; then
        echo "not ok: version $refused is found"
        exit 1
    fi
done
echo "ok: other versions are refused"
quietly configure "$version"
quietly cmake --build "$work/out"
for target in $targets; do
    "$work/out/example-$target" >"$work/got"
    diff "$work/expected" "$work/got"
    echo "ok: $target"
done
for program in colours pictures pictures-static maps maps-static light light-static; do
    [ -e "$work/out/$program" ] || continue
    # a module's own path does not count for what it uses
    LD_LIBRARY_PATH=${config%/cmake/*} "$work/out/$program"
    echo "ok: $program"
done
