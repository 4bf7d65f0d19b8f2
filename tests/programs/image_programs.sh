#!/bin/bash
# SPDX-License-Identifier: MIT
#
# image_programs.sh PROGRAMS ROOT: what of the image programs in the folder PROGRAMS needs a process of its own: exit
# statuses, streams that are full, terminals, signals, limits. What they make of images is asked by image_cases, in
# one process. ROOT is the top of the source tree. A line a case, "ok N - NAME" or "not ok N - NAME"; exit status 1
# if any is not.

set -u
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$2" && pwd)
# shellcheck source-path=SCRIPTDIR source=cases.sh
. "$here/cases.sh" "$1"
earth=$root/tests/programs/golden/earth-64.png

# ends NAME STATUS WORDS COMMAND...: the command must end with that status and one line on stderr that matches the
# words, write nothing to stdout, and leave nothing in the folder "made".
ends()
{
    local name=$1 wanted=$2 words=$3 status=0
    shift 3
    mkdir -p made
    "$@" >out.txt 2>err.txt || status=$?
    [ "$status" -eq "$wanted" ] && [ "$(wc -l <err.txt)" -eq 1 ] && [ ! -s out.txt ] &&
        grep -q -E -e "^cubemap-[a-z]*: .*($words)" err.txt && [ -z "$(ls -A made)" ]
    result $? "$name" "status $status; $(cat out.txt err.txt); left: $(ls -A made)"
    rm -rf made
}

# starts PROGRAM WORDS-OF-WRONG-USAGE WORDS-OF-A-FAILURE ARGUMENT...: success, wrong usage, and what fails with the
# arguments.
starts()
{
    local name=$1 usage=$2 failure=$3 program=$programs/cubemap-$1
    shift 3
    "$program" --version >out.txt 2>err.txt && [ ! -s err.txt ] &&
        grep -q -x -E "cubemap-$name [0-9]+\.[0-9]+\.[0-9]+" out.txt
    result $? "$name: its version" "$(cat out.txt err.txt)"
    ends "$name: wrong usage" 2 "$usage" "$program"
    ends "$name: what fails" 1 "$failure" "$program" "$@"
}

# keeps_old_file NAME COMMAND...: the command writes kept/a.png and may not write so much.
keeps_old_file()
{
    local name=$1 status=0
    shift
    mkdir kept
    echo old >kept/a.png
    (
        ulimit -f 4
        exec "$@" >out.txt 2>err.txt
    ) || status=$?
    [ "$status" -eq 1 ] && grep -q 'File too large' err.txt && [ "$(cat kept/a.png)" = old ] &&
        [ "$(ls -A kept)" = a.png ]
    result $? "$name: an older file is kept when the new one fails" "status $status; $(cat err.txt); $(ls -A kept)"
    rm -rf kept
}

# full NAME COMMAND...: standard output takes nothing.
full()
{
    local name=$1 status=0
    shift
    "$@" >/dev/full 2>err.txt || status=$?
    [ "$status" -eq 1 ] && grep -q 'standard output' err.txt
    result $? "$name" "status $status; $(cat err.txt)"
}

# closed NAME COMMAND...: standard output is no open file, and neither is standard input; what is lost is said.
closed()
{
    local name=$1 status=0
    shift
    "$@" >&- 2>err.txt || status=$?
    [ "$status" -eq 1 ] && grep -q 'standard output' err.txt
    result $? "$name: standard output is closed" "status $status; $(cat err.txt)"
    status=0
    "$@" <&- >&- 2>err.txt || status=$?
    [ "$status" -eq 1 ] && grep -q 'standard \(in\|out\)put' err.txt
    result $? "$name: standard input and output are closed" "status $status; $(cat err.txt)"
}

link_and_permissions()
{
    echo old >old.png
    chmod 640 old.png
    ln -s old.png link.png
    "$programs/cubemap-reproject" --quiet --layout strip "$earth" link.png
    [ -L link.png ] && [ "$(stat -c %a old.png)" = 640 ] && [ "$(head -c 4 old.png | tail -c 3)" = PNG ]
    result $? 'a link is followed, permissions are kept'
}

progress_bar()
{
    python3 - "$programs/cubemap-reproject" "$earth" >pty.txt <<'P'
import os, pty, sys
try:
    os.close(pty.openpty()[0])
except OSError:  # as in a change-root without devpts
    print("none")
    sys.exit()
for arguments in ([], ["--quiet"]):
    output = b""
    child, terminal = pty.fork()
    if child == 0:
        os.execv(sys.argv[1], [sys.argv[1], sys.argv[2], "face_%f.png"] + arguments)
    try:
        while True:
            data = os.read(terminal, 4096)
            if not data:
                break
            output += data
    except OSError:
        pass
    os.waitpid(child, 0)
    print("bar" if b"%" in output.replace(b"%f", b"") else "no bar")
P
    if [ "$(cat pty.txt)" = none ]; then
        echo "skipped: there is no terminal to be had for the progress bar"
    else
        [ "$(cat pty.txt)" = $'bar\nno bar' ]
        result $? 'a progress bar on a terminal, unless --quiet' "$(cat pty.txt)"
    fi
}

# signals NAME COUNT COMMAND...: ended by a signal when it has so many names in the folder "made", it leaves none.
signals()
{
    local name=$1 signal status
    shift
    for signal in INT TERM HUP; do
        mkdir made
        # From Python, as a shell starts what runs in its background with SIGINT ignored.
        python3 - "$signal" "$@" <<'P'
import os, signal, subprocess, sys, time
number = getattr(signal, "SIG" + sys.argv[1])
child = subprocess.Popen(sys.argv[3:], preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))
for _ in range(1000):
    if len(os.listdir("made")) == int(sys.argv[2]) or child.poll() is not None:
        break
    time.sleep(0.01)
time.sleep(0.05)
running = child.poll() is None
child.send_signal(number)
sys.exit(0 if child.wait() == -number and running else 1)
P
        status=$?
        [ $status -eq 0 ] && [ -z "$(ls -A made)" ]
        result $? "$name: SIG$signal leaves nothing behind" "status $status; left: $(ls -A made)"
        rm -rf made
    done
}

# A folder of views, too.
signals_while_rendering()
{
    [ -x "$programs/cubemap-scene" ] || return 0
    echo '{"width":1280,"height":960,"fx":900,"fy":900,"cx":640,"cy":480}' >camera.json
    seq 1 200 | sed 's/$/ 0 0 1.2 0.5 -0.5 0.5 -0.5/' >path.txt
    signals scene 1 "$programs/cubemap-scene" render room camera.json path.txt -o made/x --truth --quiet
}

# What was killed leaves its temporary files to the next that writes into the folder; files of who lives, and of who is no
# program of ours, stay.
left_over()
{
    mkdir made
    python3 - "$programs/cubemap-reproject" "$earth" <<'P'
import os, signal, subprocess, sys, time
child = subprocess.Popen([sys.argv[1], "--size", "6000", sys.argv[2], "made/%f.tif"])
for _ in range(1000):
    if len(os.listdir("made")) == 6 or child.poll() is not None:
        break
    time.sleep(0.01)
child.send_signal(signal.SIGKILL)
sys.exit(0 if child.wait() == -signal.SIGKILL else 1)
P
    local status=$? count
    count=$(find made -name '.cubemap-*' | wc -l)
    echo mine >"made/.cubemap-$$-0.png"
    echo other >made/.cubemap-notes.png
    mkdir made/.cubemap-999999999-0
    "$programs/cubemap-reproject" --quiet --layout strip "$earth" made/a.png
    [ $status -eq 0 ] && [ "$count" -eq 6 ] &&
        [ "$(find made -mindepth 1 | sort)" = "$(printf 'made/.cubemap-%s\n' "$$-0.png" 999999999-0 notes.png | sort
            echo made/a.png)" ]
    result $? 'what was killed leaves nothing for long' "status $status, $count files; then: $(ls -A made)"
    rm -rf made
}

# The same of folders of tiles.
left_over_tiles()
{
    mkdir made
    python3 - "$programs/cubemap-reproject" --quiet --size 512 --order 3 "$earth" made/tiles/ <<'P'
import os, signal, subprocess, sys, time
child = subprocess.Popen(sys.argv[1:])
for _ in range(1000):
    if len(os.listdir("made")) == 1 or child.poll() is not None:
        break
    time.sleep(0.01)
child.send_signal(signal.SIGKILL)
sys.exit(0 if child.wait() == -signal.SIGKILL else 1)
P
    local status=$? count
    count=$(find made -mindepth 1 -maxdepth 1 -name '.*' | wc -l)
    "$programs/cubemap-reproject" --quiet --size 16 --order 0 "$earth" made/tiles/
    [ $status -eq 0 ] && [ "$count" -eq 1 ] && [ "$(ls -A made)" = tiles ] &&
        [ "$(stat -c %a made/tiles)" = "$(printf %o $((0777 & ~$(umask))))" ]
    result $? 'nor do folders of tiles' "status $status, $count folders; then: $(ls -lA made)"
    rm -rf made
}

# Work that was killed goes on, and has the same bytes.
killed_and_resumed()
{
    local status pictures
    mkdir whole made
    "$programs/cubemap-reproject" --quiet --filter bspline5 --size 600 "$earth" whole/%f.png
    python3 - "$programs/cubemap-reproject" --quiet --resume --filter bspline5 --size 600 "$earth" made/%f.png <<'P'
import os, signal, subprocess, sys, time
journal = "made/%f.png.resume/journal"
lines = done = 0
for wanted in (1, 8):  # killed twice, the second time in the middle of a picture that the first has begun
    child = subprocess.Popen(sys.argv[1:])
    for _ in range(2000):
        lines = len(open(journal).readlines()) if os.path.exists(journal) else 0
        if lines >= done + wanted or child.poll() is not None:
            break
        time.sleep(0.002)
    done = lines
    child.send_signal(signal.SIGKILL)
    if child.wait() != -signal.SIGKILL:
        sys.exit("it was over before it was killed")
if lines < 9:
    sys.exit(f"{lines} lines are done")
second = subprocess.Popen(sys.argv[1:])
for _ in range(2000):
    if os.path.exists(journal) and len(open(journal).readlines()) > lines:
        break
    time.sleep(0.002)
third = subprocess.run(sys.argv[1:], capture_output=True, text=True)
if second.poll() is None and "is in use by another process" not in third.stderr:
    sys.exit(f"two at a time: {third}")
sys.exit(second.wait())
P
    status=$?
    for pictures in 0 1 2 3 4 5; do
        cmp -s whole/$pictures.png made/$pictures.png || status=different
    done
    [ "$status" = 0 ] && [ "$(find made -mindepth 1 | wc -l)" -eq 6 ]
    result $? 'what was killed twice is resumed, and has the same bytes' "status $status; $(ls -A made)"
    rm -rf whole made
}

# A picture of 54 MB and 216 MB of coefficients, of which no more than 32 MB may be in memory without a ceiling either. PPM and
# PFM are read by rows, as TIFF is: one of 216 MB, four times the TIFF file, takes no more below a ceiling.
memory_ceiling()
{
    python3 - "$programs/cubemap-reproject" "$earth" >peaks.txt <<'P'
import os, subprocess, sys
program, earth = sys.argv[1:]
# What the address sanitizer of the build takes, its leak checker in the end and memory given back, is not of the program.
os.environ["ASAN_OPTIONS"] = ":".join(filter(None, [os.environ.get("ASAN_OPTIONS"), "detect_leaks=0:quarantine_size_mb=1"]))
subprocess.run([program, "--quiet", "--to", "equirect", "--size", "6000", "--filter", "nearest", earth, "large.tif"],
               check=True)
def peak(*words):
    child = subprocess.Popen([program, "--quiet", "--threads", "1", *words, "small.png"])
    _, status, usage = os.wait4(child.pid, 0)
    return usage.ru_maxrss if status == 0 else 0
# Of the files that stand for memory the system keeps as many pages as it likes, now and then more: the least of three counts.
def peak_below(most, *words):
    peaks = [peak("--memory", "64M", *words)]
    while min(peaks) >= most and len(peaks) < 3:
        peaks.append(peak("--memory", "64M", *words))
    return min(peaks)
spline = ["--filter", "bspline5", "--size", "64", "large.tif"]
bilinear = ["--filter", "bilinear", "--layout", "3x2", "--size", "1500"]
for copy in "large.ppm", "large.pfm":
    subprocess.run([program, "--quiet", "--to", "equirect", "--size", "6000", "--filter", "nearest", "large.tif", copy],
                   check=True)
free, tiff_below = peak(*spline), peak("--memory", "64M", *bilinear, "large.tif")
print(free, peak_below(free - 30000, *spline), peak(*bilinear, "large.tif"),
      peak(*bilinear, "large.ppm"), peak("--filter", "nearest", "--size", "64", "large.tif"),
      tiff_below, peak_below(tiff_below + 32768, *bilinear, "large.pfm"))
P
    read -r free below tiff ppm nearest tiff_below pfm_below <peaks.txt
    [ "$nearest" -gt 0 ] && [ "$((free - nearest))" -le 32768 ]
    result $? 'coefficients take 32 MB at most' "$(cat peaks.txt) kB"
    [ "$below" -gt 0 ] && [ "$((free - below))" -gt 30000 ]
    result $? 'less memory with --memory than without' "$(cat peaks.txt) kB"
    [ "$ppm" -gt 0 ] && [ "$ppm" -lt "$((tiff + 20000))" ]
    result $? 'a PPM file takes no more memory than TIFF' "$(cat peaks.txt) kB"
    [ "$pfm_below" -gt 0 ] && [ "$pfm_below" -lt "$((tiff_below + 32768))" ]
    result $? 'a PFM file takes no more memory than TIFF below a ceiling' "$(cat peaks.txt) kB"
    rm -f large.tif large.ppm large.pfm
}

# What reads and writes images is opened when a file is.
library()
{
    local program words
    for program in reproject compare distortion orient colormap; do
        env CUBEMAP_IMAGE_IO=/none.so "$programs/cubemap-$program" --help >out.txt 2>err.txt && [ ! -s err.txt ] &&
            env CUBEMAP_IMAGE_IO=/none.so "$programs/cubemap-$program" --completion bash >out.txt 2>err.txt &&
            [ ! -s err.txt ]
        result $? "$program: help and completion without what reads images" "$(cat err.txt)"
        ends "$program: a wrong option without what reads images" 2 'no option --nonesuch' \
            env CUBEMAP_IMAGE_IO=/none.so "$programs/cubemap-$program" --nonesuch
    done
    words="the library for image files, '/none.so', cannot be opened: .*No such file"
    ends 'reproject: without what reads images' 1 "$words" \
        env CUBEMAP_IMAGE_IO=/none.so "$programs/cubemap-reproject" "$earth" made/a.png
    ends 'distortion: without what writes images' 1 "$words" \
        env CUBEMAP_IMAGE_IO=/none.so "$programs/cubemap-distortion" made/a.png
    # a program in a folder of its own, where there is no library beside it: that of the installed one, or a line
    mkdir alone made
    cp "$programs/cubemap-compare" alone
    LD_LIBRARY_PATH=$programs/../libcubemap:$programs/../modules/colormap:$programs/../modules/image alone/cubemap-compare "$earth" "$earth" >out.txt 2>err.txt ||
        grep -q -E "^cubemap-compare: there is no library for image files, neither '/.*cubemap-image-io.so' nor .*CUBEMAP_IMAGE_IO" err.txt
    result $? 'a program alone says what it looked for' "$(cat out.txt err.txt)"
    rm -rf alone made
}

exported_names()
{
    local library=$programs/../modules/colormap/libcubemap-colormap.so
    [ -e "$library" ] || return
    nm -D --defined-only "$library" | awk '{ print $3 }' | grep '^cm_' | sort >exported
    tr '\n' ' ' <"$root/include/cubemap/colormap.h" | sed 's/CM_API/\n&/g' |
        sed -n 's/^CM_API[^(;]*[ *]\(cm_[a-z0-9_]*\)(.*/\1/p' | sort >declared
    [ -s declared ] && cmp -s declared exported
    result $? 'the library of colour maps exports what its header declares' "$(diff declared exported)"
}

starts reproject 'INPUT and OUTPUT' 'No such file' none.png made/a.png
starts compare 'two images' 'above the limit of 0.1' --quiet --max 0.1 "$earth" "$root/tests/programs/golden/earth-back-64.png"
starts distortion 'OUTPUT is needed' "'nowhere.*No such file" nowhere/a.png
starts orient 'one mask is needed' 'twice as wide as high' "$root/tests/programs/golden/earth-cross-16.png"
starts colormap 'one MAP is needed' 'cannot be written' single -o made/none/a.json
ends 'reproject: instruction set that is none' 1 "'abacus', but here it can be scalar" \
    env CUBEMAP_INSTRUCTIONS=abacus "$programs/cubemap-reproject" "$earth" made/a.png
ends 'distortion: instruction set that is none' 1 "'abacus', but here it can be scalar" \
    env CUBEMAP_INSTRUCTIONS=abacus "$programs/cubemap-distortion" made/a.png
keeps_old_file reproject "$programs/cubemap-reproject" --layout strip --size 200 "$earth" kept/a.png
keeps_old_file distortion "$programs/cubemap-distortion" --size 400 --legend kept/l.png kept/a.png
keeps_old_file colormap "$programs/cubemap-colormap" rainbow --samples 60000 --format csv -o kept/a.png
full 'help to a full device' "$programs/cubemap-reproject" --help
full 'standard output is full' "$programs/cubemap-colormap" single
printf 'P6\n2 1\n255\nabcdef' >two.ppm
closed 'a picture to a pipe' "$programs/cubemap-reproject" --to equirect - - <two.ppm
closed 'what was done' "$programs/cubemap-reproject" --to equirect two.ppm out.ppm
closed 'errors' "$programs/cubemap-compare" two.ppm two.ppm
link_and_permissions
progress_bar
signals reproject 6 "$programs/cubemap-reproject" --size 6000 "$earth" made/%f.tif
signals tiles 1 "$programs/cubemap-reproject" --quiet --size 512 --order 3 "$earth" made/tiles/
signals_while_rendering
left_over
left_over_tiles
killed_and_resumed
memory_ceiling
library
exported_names
finish
