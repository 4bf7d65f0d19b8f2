#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The kernels as GLSL: one fragment shader that calls every mapping both ways, compiled by
# glslangValidator as desktop GLSL and as GLSL ES, with #include and as flat text.
# Usage: shaders.sh INCLUDE_FOLDER C_COMPILER
set -eu
include=$1 cc=$2
if ! command -v glslangValidator >/dev/null; then
    echo "glslangValidator is missing (apt: glslang-tools)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

rooms() { # rooms KIND: the identifiers of the catalogue's rooms whose descriptor begins so
    sed -n 's/^#include "\(.*\)"$/\1/p' "$include/cubemap/kernel/kernel_catalogue.h" |
        while read -r file; do
            sed -n "s/^$1\(_VARIANTS\)\?(\([a-z0-9_]*\),.*/\2/p" "$include/cubemap/kernel/$file"
        done
}

main() { # the body of a shader that uses everything
    echo 'void main() {'
    echo '    vec4 sum = vec4(0.0);'
    echo '    cm_constants k;'
    echo '    cm_uv uv; cm_pq pq; cm_face_point f; cm_xyz d;'
    echo '    cm_jacobian j; cm_tangents t; cm_gradients g;'
    for id in $(rooms CM_WARP); do
        echo "    k = cm_${id}_prepare(cm_make_parameters(place.z, 0.0));"
        echo "    uv = cm_${id}_forward(place.x, place.y, k); sum.xy += vec2(uv.u, uv.v);"
        echo "    pq = cm_${id}_inverse(place.x, place.y, k); sum.zw += vec2(pq.p, pq.q);"
        echo "    j = cm_${id}_jacobian(place.x, place.y, uv.u, uv.v, k);"
        echo "    sum += vec4(j.u_p, j.u_q, j.v_p, j.v_q);"
    done
    echo "    f = cm_cube_project(place.x, place.y, place.z); sum += vec4(f.face, f.a, f.b, 0.0);"
    echo "    d = cm_cube_unproject(f.face, f.a, f.b); sum += vec4(d.x, d.y, d.z, 0.0);"
    echo "    t = cm_jacobian_tangents(j, cm_cube_tangents(f.face, f.a, f.b));"
    echo "    g = cm_jacobian_gradients(j, cm_cube_gradients(d.x, d.y, d.z));"
    echo "    sum += vec4(t.x_a, t.y_a, t.z_a, t.x_b) + vec4(t.y_b, t.z_b, g.a_x, g.a_y);"
    echo "    sum += vec4(g.a_z, g.b_x, g.b_y, g.b_z);"
    for id in $(rooms CM_SPHERE); do
        echo "    k = cm_${id}_prepare(cm_make_parameters(place.z, place.y));"
        echo "    f = cm_${id}_project(place.x, place.y, place.z, k); sum += vec4(f.face, f.a, f.b, 0.0);"
        echo "    d = cm_${id}_unproject(f.face, f.a, f.b, k); sum += vec4(d.x, d.y, d.z, 0.0);"
        echo "    t = cm_${id}_tangents(f.face, f.a, f.b, k); sum += vec4(t.x_a, t.y_a, t.z_a, t.x_b);"
        echo "    g = cm_${id}_gradients(d.x, d.y, d.z, k); sum += vec4(g.a_z, g.b_x, g.b_y, g.b_z);"
    done
    echo '    cm_disc_point disc;'
    for id in $(rooms CM_AZIMUTHAL); do
        echo "    k = cm_azimuthal_${id}_prepare(cm_make_parameters(place.z, place.y));"
        echo "    disc = cm_azimuthal_${id}_project(place.x, place.y, place.z, k);"
        echo "    d = cm_azimuthal_${id}_unproject(disc, k); sum += vec4(disc.u, disc.v, d.x, d.z);"
        echo "    t = cm_azimuthal_${id}_tangents(disc, k); sum += vec4(t.x_a, t.y_a, t.z_a, t.x_b);"
        echo "    g = cm_azimuthal_${id}_gradients(place.x, place.y, place.z, k); sum.x += g.a_x;"
    done
    for id in $(rooms CM_SQUARE); do
        echo "    uv = cm_square_${id}_forward(cm_make_disc_point(place.x, place.y));"
        echo "    disc = cm_square_${id}_inverse(uv.u, uv.v); sum += vec4(uv.u, uv.v, disc.u, disc.v);"
        echo "    j = cm_square_${id}_jacobian(disc, uv.u, uv.v); sum.x += cm_jacobian_determinant(j);"
    done
    echo "    uv = cm_quincuncial_place(place.x, place.y, place.z); sum += vec4(uv.u, uv.v, 0.0, 0.0);"
    echo "    f = cm_quincuncial_unplace(uv.u, uv.v); sum += vec4(f.face, f.a, f.b, 0.0);"
    echo "    j = cm_quincuncial_jacobian(f.a, f.b, f.face); sum.x += cm_jacobian_determinant(j);"
    echo '    cm_latitude_constants l;'
    for coefficient in p0 p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 ratio; do
        echo "    l.$coefficient = place.z;"
    done
    for terms in 3 6 12; do
        echo "    sum.x += cm_latitude_series_angle(place.x, $terms, l);"
        echo "    d = cm_latitude_series_direction(place.x, place.y, place.z, $terms, l); sum.xyz += vec3(d.x, d.y, d.z);"
    done
    echo '    sum.x += cm_latitude_tangent_angle(place.x, 0, l) + cm_latitude_tangent_angle(place.x, 1, l);'
    echo '    d = cm_latitude_tangent_direction(place.x, place.y, place.z, l); sum.xyz += vec3(d.x, d.y, d.z);'
    echo '    colour = sum;'
    echo '}'
}

check() { # check NAME OPTIONS...: compile $work/NAME.frag
    local name=$1
    shift
    if glslangValidator "$@" "$work/$name.frag" >"$work/$name.log" 2>&1; then
        echo "ok: $name"
    else
        echo "not ok: $name"
        cat "$work/$name.log"
        exit 1
    fi
}

# unquoted: a command with arguments, as in "ccache gcc"
# shellcheck disable=SC2086
flat=$($cc -E -P -x c -DCM_BACKEND=3 -I "$include" "$include/cubemap/kernel/backend.h")
io_vulkan='layout(location = 0) in vec3 place; layout(location = 0) out vec4 colour;'
io_plain='in vec3 place; out vec4 colour;'

for version in "450" "310 es"; do
    name=include-${version// /-}
    {
        echo "#version $version"
        echo '#extension GL_GOOGLE_include_directive : require'
        case $version in *es) echo 'precision highp float;' ;; esac
        echo '#include "cubemap/kernel/backend.h"'
        echo "$io_vulkan"
        main
    } >"$work/$name.frag"
    check "$name" -V -o "$work/$name.spv" -I"$include"
done
for version in "330" "450" "300 es"; do
    name=flat-${version// /-}
    {
        echo "#version $version"
        case $version in *es) echo 'precision highp float;' ;; esac
        printf '%s\n' "$flat"
        echo "$io_plain"
        main
    } >"$work/$name.frag"
    check "$name"
done
echo "$(rooms CM_WARP | wc -l) warps and $(rooms CM_SPHERE | wc -l) whole-sphere mappings"
test "$(rooms CM_WARP | wc -l)" -ge 15
