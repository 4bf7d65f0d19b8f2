# shellcheck shell=sh disable=SC2034,SC2154 # variables that are set or used by the scripts
# SPDX-License-Identifier: MIT
#
# What the scripts of this folder share. To be sourced, after "set -eu", by a script that has set
# root to the top of the source tree.
#
# CUBEMAP_BUILD   folder to build in, absolute or from the top of the source tree; default: build

build=${CUBEMAP_BUILD:-build}
case $build in
/*) ;;
*) build=$root/$build ;;
esac

# What each job needs, by the names of Debian's and Ubuntu's packages.
needs_to_build="build-essential meson ninja-build pkg-config libopenimageio-dev zlib1g-dev libcfitsio-dev libjansson-dev
    libopenexr-dev libsqlite3-dev libzstd-dev libcjson-dev libtinygltf-dev libtinyobjloader-dev libembree-dev check"
needs_to_test="$needs_to_build glslang-tools python3 python3-mpmath python3-pycparser doxygen"
# The libraries that tests/peers and bench/side_by_side compare with are used where they are; .ci/run
# and scripts/speed have them all.
needs_for_peers="wcslib-dev libproj-dev libchealpix-dev libs2-dev libgeographiclib-dev
    libhealpix-cxx-dev"
# The programs that bench/image compares with, each where it is; scripts/renew image has them all.
needs_for_images="ffmpeg hugin-tools gdal-bin"
# What is built with tools where it is there, and its tests then run: rasters of GDAL, films through ffmpeg, frames of HDF5.
needs_for_rasters="libgdal-dev ffmpeg libhdf5-dev"
# Optical flows, for motion between phase images.
needs_for_flows="libopencv-contrib-dev libopencv-dev"
# A compiler for AArch64 and an emulator of it, for tests/batch/neon.sh.
needs_for_neon="gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user"
# A compiler for a processor of 32 bits, for .ci/long; the emulator is that of AArch64.
needs_for_long="gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user"

# The Python package (its module sim is built where Embree is), and what its tests compare and draw with; all of the
# system's Python.
needs_to_build_python="build-essential meson ninja-build python3-dev python3-numpy python3-mesonpy python3-pip python3-venv
    python3-pycparser libembree-dev"
needs_for_python="python3-pytest python3-hypothesis python3-healpy python3-dask python3-distributed python3-xarray
    python3-matplotlib"
# What checks their types, in bindings/python/test --long.
needs_for_types="python3-mypy"

# CMake, for tests/programs/cmake.sh, and a compiler for Windows, for tests/include/dll.sh; to run what it makes, .ci/long
# has Wine.
needs_for_users="cmake gcc-mingw-w64-x86-64"
needs_for_windows="gcc-mingw-w64-x86-64 g++-mingw-w64-x86-64 wine64 wine"

# The shaders' texts, compiled and run without a graphics card: by Mesa's llvmpipe and lavapipe, and by PoCL. npm brings naga.
needs_for_shaders="glslang-tools python3 libegl-dev libopengl-dev libgl-dev libgl1-mesa-dri libvulkan-dev mesa-vulkan-drivers
    opencl-headers ocl-icd-opencl-dev pocl-opencl-icd nodejs npm"
# A compiler to WebAssembly and what runs it, for bindings/js.
needs_for_wasm="clang lld wasi-libc libclang-rt-dev-wasm32 python3 python3-pycparser"
needs_for_javascript="$needs_for_wasm nodejs npm"
# WebGL and WebGPU, and what runs examples/threejs, where it is; .ci/run has it.
needs_for_browsers="chromium"

# How clang builds what is fuzzed, and what the tests run with sanitizers: arguments to meson, and flags of C and C++.
sanitized_by_clang="-Dbuildtype=debugoptimized -Doptimization=1 -Db_sanitize=address,undefined -Db_lundef=false
    -Dfuzzers=enabled"
sanitized_flags="-g1 -fsanitize=fuzzer-no-link -fno-sanitize-recover=all"
untraced=-fno-sanitize-coverage=trace-cmp

die()
{
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit 1
}

# compiles COMPILER LANGUAGE HEADER: whether the compiler is there and has its library's headers.
compiles()
{
    # unquoted: CC may be a command with arguments, as in CC="ccache gcc"
    # shellcheck disable=SC2086
    echo "#include <$3>" | $1 -x "$2" -fsyntax-only - 2>/dev/null
}

# system_python: the Python that packages of Python are installed for.
system_python()
{
    if [ -x /usr/bin/python3 ]; then
        echo /usr/bin/python3
    else
        echo python3
    fi
}

# has PACKAGE: whether what we want of the package is there, wherever it came from.
has()
{
    case $1 in
    build-essential)
        compiles "${CC:-cc}" c math.h && compiles "${CXX:-c++}" c++ cmath ;;
    clang)
        compiles clang c math.h && compiles clang++ c++ cmath ;;
    meson)
        case $(meson --version 2>/dev/null) in
        '' | 0.*) false ;;
        esac ;;
    ninja-build) command -v ninja >/dev/null ;;
    pkg-config) command -v pkg-config >/dev/null ;;
    libopenimageio-dev) pkg-config --exists OpenImageIO 2>/dev/null ;;
    libopenexr-dev) pkg-config --exists OpenEXR 2>/dev/null ;;
    zlib1g-dev) pkg-config --exists zlib 2>/dev/null ;;
    libcfitsio-dev) pkg-config --exists cfitsio 2>/dev/null ;;
    libjansson-dev) pkg-config --exists jansson 2>/dev/null ;;
    libsqlite3-dev) pkg-config --exists sqlite3 2>/dev/null ;;
    libzstd-dev) pkg-config --exists libzstd 2>/dev/null ;;
    libcjson-dev) pkg-config --exists libcjson 2>/dev/null ;;
    libtinygltf-dev) pkg-config --exists tinygltf 2>/dev/null ;;
    libtinyobjloader-dev) pkg-config --exists tinyobjloader_double 2>/dev/null ;;
    check) pkg-config --exists check 2>/dev/null ;;
    doxygen) command -v doxygen >/dev/null ;;
    glslang-tools) command -v glslangValidator >/dev/null ;;
    python3) command -v python3 >/dev/null ;;
    wcslib-dev) pkg-config --exists wcslib 2>/dev/null ;;
    libproj-dev) pkg-config --exists proj 2>/dev/null ;;
    libchealpix-dev) pkg-config --exists chealpix 2>/dev/null ;;
    libs2-dev) compiles "${CXX:-c++} -std=c++17" c++ s2/s2coords.h ;;
    libgeographiclib-dev) pkg-config --exists geographiclib 2>/dev/null ;;
    libhealpix-cxx-dev) pkg-config --exists healpix_cxx 2>/dev/null ;;
    ffmpeg) command -v ffmpeg >/dev/null ;;
    hugin-tools) command -v nona >/dev/null ;;
    libgdal-dev) pkg-config --exists gdal 2>/dev/null ;;
    libhdf5-dev) pkg-config --exists hdf5 2>/dev/null ;;
    libopencv-contrib-dev) [ -e /usr/include/opencv4/opencv2/optflow.hpp ] ;;
    libopencv-dev) pkg-config --exists opencv4 2>/dev/null ;;
    libembree-dev) compiles "${CC:-cc}" c embree3/rtcore.h || compiles "${CC:-cc}" c embree4/rtcore.h ;;
    gdal-bin) command -v gdalwarp >/dev/null ;;
    gcc-aarch64-linux-gnu) command -v aarch64-linux-gnu-gcc >/dev/null ;;
    libc6-dev-arm64-cross) compiles aarch64-linux-gnu-gcc c stdio.h ;;
    qemu-user) command -v qemu-aarch64 >/dev/null || command -v qemu-aarch64-static >/dev/null ;;
    gcc-arm-linux-gnueabihf) command -v arm-linux-gnueabihf-gcc >/dev/null ;;
    libc6-dev-armhf-cross) compiles arm-linux-gnueabihf-gcc c stdio.h ;;
    cmake) command -v cmake >/dev/null ;;
    gcc-mingw-w64-x86-64) compiles x86_64-w64-mingw32-gcc c stdio.h ;;
    g++-mingw-w64-x86-64) compiles x86_64-w64-mingw32-g++ c++ cmath ;;
    wine64) [ -x /usr/lib/wine/wine64 ] || command -v wine64 >/dev/null ;;
    wine) command -v wine >/dev/null ;;
    lld) command -v wasm-ld >/dev/null ;;
    wasi-libc) [ -e /usr/lib/wasm32-wasi/libc.a ] ;;
    libclang-rt-dev-wasm32)
        [ -e "$(clang --target=wasm32-wasi -rtlib=compiler-rt -print-libgcc-file-name 2>/dev/null)" ] ;;
    chromium) command -v chromium >/dev/null ;;
    nodejs) command -v node >/dev/null ;;
    npm) command -v npm >/dev/null ;;
    gcovr) command -v gcovr >/dev/null ;;
    valgrind) command -v valgrind >/dev/null && compiles "${CC:-cc}" c valgrind/callgrind.h ;;
    libegl-dev) compiles "${CC:-cc}" c EGL/egl.h ;;
    libgl-dev) compiles "${CC:-cc}" c GL/glcorearb.h ;;
    libopengl-dev) pkg-config --exists opengl 2>/dev/null ;;
    libgl1-mesa-dri) ls /usr/lib/*/dri/swrast_dri.so >/dev/null 2>&1 || ls /usr/lib/*/libgallium-*.so >/dev/null 2>&1 ;;
    libvulkan-dev) compiles "${CC:-cc}" c vulkan/vulkan.h ;;
    mesa-vulkan-drivers) ls /usr/share/vulkan/icd.d/lvp_icd*.json >/dev/null 2>&1 ;;
    opencl-headers) compiles "${CC:-cc}" c CL/cl.h ;;
    ocl-icd-opencl-dev) pkg-config --exists OpenCL 2>/dev/null ;;
    pocl-opencl-icd) [ -f /etc/OpenCL/vendors/pocl.icd ] ;;
    python3-dev)
        compiles "${CC:-cc} $(/usr/bin/python3 -c \
            'import sysconfig; print("-I" + sysconfig.get_path("include"))' 2>/dev/null)" c Python.h ;;
    python3-pip) /usr/bin/python3 -m pip --version >/dev/null 2>&1 ;;
    python3-venv) /usr/bin/python3 -c 'import ensurepip, venv' 2>/dev/null ;;
    python3-mesonpy) /usr/bin/python3 -c 'import mesonpy' 2>/dev/null ;;
    # of the system's Python, which the package and its tests are made with: another that comes first in PATH may have them
    # and helps nobody
    python3-matplotlib | python3-mpmath | python3-pycparser | python3-numpy | python3-pytest | python3-hypothesis | \
        python3-healpy | python3-dask | python3-distributed | python3-xarray | python3-mypy)
        "$(system_python)" -c "import ${1#python3-}" 2>/dev/null ;;
    *) die "has: no rule for $1" ;;
    esac
}

# missing PACKAGE...: those of the packages that are not there, on one line.
missing()
{
    lacking=
    for package in "$@"; do
        has "$package" || lacking="$lacking $package"
    done
    echo "${lacking# }"
}

# require PACKAGE...: installs those that are missing. Where that cannot be done, says in one line
# what is missing and stops.
require()
{
    wanted=$(missing "$@")
    [ -n "$wanted" ] || return 0

    command -v apt-get >/dev/null ||
        die "missing: $wanted (Debian's names; there is no apt-get here, so please install them)"
    if [ "$(id -u)" -eq 0 ]; then
        as_root=
    elif sudo -n true 2>/dev/null; then
        as_root='sudo -n'
    else
        die "missing: $wanted; please run: sudo apt-get update && sudo apt-get install $wanted"
    fi

    echo "Installing $wanted"
    log=$(mktemp)
    # apt-get update may fail for some other source than ours: whether that matters, install knows.
    # unquoted: lists of words
    # shellcheck disable=SC2086
    if ! {
        $as_root apt-get update
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
            -o DPkg::Lock::Timeout=300 $wanted
    } </dev/null >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        die "could not install $wanted: the end of apt-get's output is above, all of it in $log"
    fi
    rm -f "$log"

    # shellcheck disable=SC2086
    wanted=$(missing $wanted)
    case " $wanted " in
    '  ') ;;
    *' meson '*) die "missing: meson 1.0 or newer; apt-get installed $(meson --version)" ;;
    *) die "still missing after apt-get installed it: $wanted" ;;
    esac
}

# clang's runtime libraries are a package of their own, and its name has clang's version.
links_fuzzers()
{
    echo 'int LLVMFuzzerTestOneInput(void); int LLVMFuzzerTestOneInput(void) { return 0; }' |
        clang -fsanitize=fuzzer,address,undefined -x c - -o /dev/null 2>/dev/null
}

# What a build as sanitized_by_clang says needs.
require_fuzzers()
{
    # shellcheck disable=SC2086
    require $needs_to_build clang # a list of words
    if ! links_fuzzers; then
        version=$(clang -dumpversion)
        (
            has()
            {
                links_fuzzers
            }
            require "libclang-rt-${version%%.*}-dev"
        )
    fi
}
