#!/bin/bash
# SPDX-License-Identifier: MIT
#
# film.sh TOOLS: cubemap-reproject between two ffmpegs, which must agree on what goes through the pipes. Skipped where
# there is no ffmpeg.
set -euo pipefail
tools=$1
command -v ffmpeg >/dev/null || exit 77

film=(ffmpeg -nostdin -v error -f lavfi -i testsrc2=size=128x64:rate=5:duration=1)
sums=(ffmpeg -nostdin -v error -y)
same=("$tools/cubemap-reproject" --quiet --to equirect --filter nearest)
failures=0

# check NAME WANTED SEEN
check()
{
    if [[ -n $2 && $2 == "$3" ]]; then
        echo "ok - $1"
    else
        printf 'not ok - %s\n%s\n%s\n' "$1" "$2" "$3"
        failures=1
    fi
}

wanted=$("${film[@]}" -pix_fmt rgb24 -f framemd5 - | grep -v '^#' | awk '{print $NF}')

seen=$("${film[@]}" -f image2pipe -c:v ppm - | "${same[@]}" - - |
    ffmpeg -v error -f image2pipe -c:v ppm -i - -pix_fmt rgb24 -f framemd5 - | grep -v '^#' | awk '{print $NF}')
check 'PPM' "$wanted" "$seen"

seen=$("${film[@]}" -pix_fmt rgb24 -f image2pipe -c:v pam - | "${same[@]}" --pipe pam - - |
    ffmpeg -v error -f image2pipe -c:v pam -i - -pix_fmt rgb24 -f framemd5 - | grep -v '^#' | awk '{print $NF}')
check 'PAM' "$wanted" "$seen"

for format in rgb24 rgb48le gbrpf32le; do
    direct=$("${film[@]}" -pix_fmt "$format" -f framemd5 - | grep -v '^#' | awk '{print $NF}')
    seen=$("${film[@]}" -pix_fmt "$format" -f rawvideo - | "${same[@]}" --raw 128x64:"$format" --pipe "$format" - - |
        ffmpeg -v error -f rawvideo -pix_fmt "$format" -s 128x64 -i - -f framemd5 - | grep -v '^#' | awk '{print $NF}')
    check "$format" "$direct" "$seen"
done

# who stops reading ends it, without a word
said=$( { "${film[@]}" -f image2pipe -c:v ppm - 2>/dev/null | "$tools/cubemap-reproject" --to equirect - - |
    head -c 100 >/dev/null; } 2>&1 || true)
check 'a closed pipe' 'nothing' "${said:-nothing}"
exit "$failures"
