# shellcheck shell=bash disable=SC2154 # root is set by who sources this
# SPDX-License-Identifier: MIT
#
# The stages of .ci/run and .ci/long: what each is, what it counts for, and how long it took. To be sourced by a script of
# bash that has set root and sourced common.sh.

passed=0
failed=0
output=$(mktemp)
ledger=$(mktemp)   # what ends the output
failures=$(mktemp) # and before the total, what failed and how: of a long output often the end alone is kept
trap 'rm -f "$output" "$ledger" "$failures"' EXIT

# begin NAME: the head of a stage.
begin()
{
    stage=$1
    stage_begun=$SECONDS
    printf '\n== %s\n' "$stage"
}

# end: its line of the ledger.
end()
{
    printf '%-56s %5d s\n' "$stage" "$((SECONDS - stage_begun))" >>"$ledger"
}

# count GOOD BAD: added to the total.
count()
{
    passed=$((passed + $1))
    failed=$((failed + $2))
}

# note_failure LINE...: what failed in this stage, then the end of the stage's output.
note_failure()
{
    {
        printf '%s: %s\n' "$stage" "$*"
        tail -n 25 "$output" | sed 's/^/    /'
    } >>"$failures"
}

# note_suites BUILD: into the ledger what its suites took; each budget that one broke is a failure.
note_suites()
{
    local log broken line
    log=$(find "$root/$1/meson-logs" -name 'testlog*.json' 2>/dev/null || true)
    [[ -f $log ]] || return 0
    "$root/.ci/ledger.py" --failed "$log" | sed "s/^/$stage: /" >>"$failures"
    "$root/.ci/ledger.py" "$log" | sed 's/^/    /' >>"$ledger"
    [[ $keeps_budgets -eq 1 ]] || return 0
    broken=$("$root/.ci/ledger.py" --check "$log") || while read -r line; do
        echo "$stage: $line" | tee -a "$failures"
        count 0 1
    done <<<"$broken"
}

# check NAME BUILD VARIABLE=VALUE... [-- ARGUMENT...]: scripts/test into that folder with those variables, added to the total.
check()
{
    begin "$1"
    local folder=$2 variables=("CUBEMAP_BUILD=$2")
    shift 2
    while [[ $# -gt 0 && $1 != -- ]]; do
        variables+=("$1")
        shift
    done
    [[ $# -eq 0 ]] || shift
    env "${variables[@]}" "$root/scripts/test" --timeout-multiplier 4 "$@" 2>&1 | tee "$output" || true
    if [[ $(tail -n 1 "$output") =~ ^([0-9]+)\ passed,\ ([0-9]+)\ failed$ ]]; then
        count "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}"
    else
        note_failure 'no build, no tests'
        count 0 1
    fi
    end
    note_suites "$folder"
}

# fuzz NAME ARGUMENT...: scripts/fuzz with those arguments, each harness added to the total.
fuzz()
{
    begin "fuzzers, $1"
    shift
    CUBEMAP_MESON_ARGS='-Dwerror=true -Dpeers=disabled' "$root/scripts/fuzz" "$@" 2>&1 | tee "$output" || true
    if [[ $(tail -n 1 "$output") =~ ^([0-9]+)\ harnesses,\ ([0-9]+)\ findings$ ]]; then
        count $((BASH_REMATCH[1] - BASH_REMATCH[2])) "${BASH_REMATCH[2]}"
        [[ ${BASH_REMATCH[2]} -eq 0 ]] || note_failure 'findings'
    else
        note_failure 'no build, no runs'
        count 0 1
    fi
    end
}

# one NAME COMMAND...: what counts for one.
one()
{
    begin "$1"
    shift
    local status=0
    # no pipe of the shell's: the command may wait for what this shell began
    exec 3> >(tee "$output")
    local copier=$!
    "$@" >&3 2>&1 3>&- || status=$?
    exec 3>&-
    wait "$copier"
    if [[ $status -eq 0 ]]; then
        count 1 0
    else
        note_failure "$(basename "$1") failed"
        count 0 1
    fi
    end
}

# aside NAME COMMAND...: what counts for one, for a function that begin_aside runs.
aside()
{
    local folder status=0 begun=$SECONDS
    aside_count=$((aside_count + 1))
    folder=$(printf '%s/%03d' "$aside_folder" "$aside_count")
    mkdir "$folder"
    echo "$1" >"$folder/name"
    shift
    "$@" >"$folder/output" 2>&1 || status=$?
    echo "$((SECONDS - begun))" >"$folder/seconds"
    echo "$status" >"$folder/status"
}

# begin_aside FUNCTION: runs it beside the stages that follow, until join_aside.
begin_aside()
{
    aside_folder=$(mktemp -d)
    aside_count=0
    "$1" &
    aside_process=$!
    trap 'kill "$aside_process" 2>/dev/null || true; rm -rf "$output" "$ledger" "$failures" "$aside_folder"' EXIT
}

# join_aside COUNT: what the function has done, which must be so many stages.
join_aside()
{
    local folder seconds status
    wait "$aside_process" || true
    for folder in "$aside_folder"/*/; do
        [[ -f $folder/name ]] || continue
        begin "$(cat "$folder/name")"
        cat "$folder/output" | tee "$output"
        seconds=$(cat "$folder/seconds" 2>/dev/null || echo 0)
        status=$(cat "$folder/status" 2>/dev/null || echo 'no end')
        if [[ $status == 0 ]]; then
            count 1 0
        else
            note_failure "ended with $status"
            count 0 1
        fi
        printf '%-56s %5d s beside others\n' "$stage" "$seconds" >>"$ledger"
    done
    if [[ $(find "$aside_folder" -name name | wc -l) -ne $1 ]]; then
        stage='beside others'
        note_failure 'some stages did not begin'
        count 0 1
    fi
    rm -rf "$aside_folder"
}

# finish: the ledger, what failed, the total, and the exit status.
finish()
{
    printf '\n== ledger\n'
    cat "$ledger"
    printf '%-56s %5d s\n\n' 'all' "$SECONDS"
    if [[ -s $failures ]]; then
        printf '== failed\n'
        cat "$failures"
        echo
    fi
    echo "$passed passed, $failed failed"
    [[ $failed -eq 0 ]]
}
