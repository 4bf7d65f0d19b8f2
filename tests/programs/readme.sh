#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The library as its users get it: installed into an empty folder, found by pkg-config, linked with
# the shared and with the static library; the C program of the README and those of
# docs/guide/images.md and comparing.md compile and print what the documents say.
# Usage: readme.sh REPOSITORY BUILD_FOLDER C_COMPILER MESON...
set -eu
root=$1 build=$2 cc=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$@" install -C "$build" --no-rebuild --destdir "$work/root" >"$work/install.log" 2>&1 || {
    cat "$work/install.log"
    exit 1
}
package=$(find "$work/root" -name cubemap.pc)
test -n "$package"
export PKG_CONFIG_PATH=${package%/*} PKG_CONFIG_SYSROOT_DIR=$work/root
# one version everywhere
version=$(pkg-config --modversion cubemap)
header=$root/include/cubemap/version.h
number() {
    awk -v name="CM_VERSION_$1" '$2 == name { print $3 }' "$header"
}
test "$(number STRING)" = "\"$version\""
test "$(number MAJOR).$(number MINOR).$(number PATCH)" = "$version"

block() { # block LANGUAGE [FILE]: the first block of code in that language, of the README without a file
    awk -v fence="\`\`\`$1" '$0 == fence && !done { inside = 1; next }
        $0 == "```" && inside { inside = 0; done = 1 }
        inside' "$root/${2:-README.md}"
}
block c >"$work/example.c"
block output >"$work/expected"
test -s "$work/example.c"
test -s "$work/expected"
library=$(dirname "$(find "$work/root" -name 'libcubemap.so' | head -n 1)")
# the library may have been built with sanitizers, which its users link too
sanitizers=""
if nm -D "$library/libcubemap.so" | grep -q __asan_; then
    sanitizers="-fsanitize=address,undefined"
fi
# shellcheck disable=SC2046
$cc -std=c11 -Wall -Wextra -Wpedantic -Werror $sanitizers -o "$work/shared" "$work/example.c" \
    $(pkg-config --cflags --libs cubemap) -Wl,-rpath,"$library"
"$work/shared" >"$work/got"
diff "$work/expected" "$work/got"
echo "ok: shared"
# shellcheck disable=SC2046
$cc -std=c11 -Wall -Wextra -Wpedantic -Werror $sanitizers -o "$work/static" "$work/example.c" \
    $(pkg-config --cflags cubemap) "$library/libcubemap.a" -lm
"$work/static" >"$work/got"
diff "$work/expected" "$work/got"
echo "ok: static"
# the programs of the guides to pictures, with the library for them
for guide in images comparing; do
    block c "docs/guide/$guide.md" >"$work/picture.c"
    block output "docs/guide/$guide.md" >"$work/expected"
    test -s "$work/picture.c"
    test -s "$work/expected"
    # shellcheck disable=SC2046
    $cc -std=c11 -Wall -Wextra -Wpedantic -Werror $sanitizers -o "$work/picture" "$work/picture.c" \
        $(pkg-config --cflags --libs cubemap-image) -Wl,-rpath,"$library"
    "$work/picture" >"$work/got"
    diff "$work/expected" "$work/got"
    echo "ok: $guide"
done
# everything a user expects is there
for file in bin/cubemap-project bin/cubemap-reproject bin/cubemap-bench bin/cubemap-distortion \
    bin/cubemap-colormap bin/cubemap-latitude bin/cubemap-orient include/cubemap/cubemap.h include/cubemap/distortion.h \
    include/cubemap/statistics.h include/cubemap/colormap.h include/cubemap/kernels.h \
    include/cubemap/kernel/backend.h share/man/man1/cubemap-project.1 \
    share/man/man1/cubemap-reproject.1 share/man/man1/cubemap-bench.1 \
    share/man/man1/cubemap-distortion.1 share/man/man1/cubemap-colormap.1 share/man/man1/cubemap-latitude.1 \
    share/man/man1/cubemap-orient.1 \
    share/bash-completion/completions/cubemap-project share/zsh/site-functions/_cubemap-project \
    share/fish/vendor_completions.d/cubemap-project.fish cubemap/cubemap-image-io.so; do
    if [ -z "$(find "$work/root" -path "*/$file")" ]; then
        echo "not ok: $file is not installed"
        exit 1
    fi
done
echo "ok: installed files"

# an installed program finds what reads images beside it, wherever the whole was moved
moved="$work/a folder with blanks"
mv "$work/root" "$moved"
compare=$(find "$moved" -path '*/bin/cubemap-compare')
libraries=$(dirname "$(find "$moved" -name 'libcubemap.so*' | head -n 1)")
image=$root/tests/programs/golden/earth-64.png
if ! LD_LIBRARY_PATH=$libraries "$compare" "$image" "$image" >"$work/compare.log" 2>&1; then
    echo "not ok: an installed program does not read images"
    cat "$work/compare.log"
    exit 1
fi
echo "ok: an installed program reads images"
