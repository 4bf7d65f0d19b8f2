#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every public header compiles alone, as C11 and as C++17, without a warning.
# Usage: headers.sh INCLUDE_FOLDER C_COMPILER CXX_COMPILER; an empty CXX_COMPILER leaves C++ out.
set -eu
include=$1 cc=$2 cxx=$3
flags="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -fsyntax-only"
failed=0
count=0
for header in "$include"/cubemap/*.h; do
    name=cubemap/$(basename "$header")
    count=$((count + 1))
    # shellcheck disable=SC2086
    if ! printf '#include <%s>\nextern int unit;\n' "$name" |
        $cc -std=c11 $flags -I "$include" -x c - ||
        { [ -n "$cxx" ] &&
            ! printf '#include <%s>\n' "$name" | $cxx -std=c++17 $flags -I "$include" -x c++ -; }; then
        echo "not ok: $name"
        failed=1
    fi
done
# the kernels used from both languages, in both precisions: the example of kernels.h itself
example=$(sed -n 's/^ \*     \(cm_.*\)$/\1/p' "$include/cubemap/kernels.h")
test -n "$example"
use='#include <cubemap/kernels.h>
#if defined(CM_REAL) || defined(cm_min) || defined(CM_SELECT)
#error "words of the dialect are left"
#endif
extern float p, q;
int main(void) {
    '"$example"'
    cm_face_point_f64 f = cm_healpix_project_f64(1.0, 2.0, 3.0, cm_make_parameters_f64(0.0, 0.0));
    return uv.u > 0.0f && f.face < 6.0 ? 0 : 1;
}'
# shellcheck disable=SC2086
echo "$use" | $cc -std=c11 $flags -I "$include" -x c - || failed=1
# shellcheck disable=SC2086
[ -z "$cxx" ] || echo "$use" | $cxx -std=c++17 $flags -I "$include" -x c++ - || failed=1
echo "$count headers, C11${cxx:+ and C++17}"
test "$count" -ge 8
exit "$failed"
