#!/usr/bin/env bash
# Runs soak.xml at 1 kHz on the wall clock with random faults, and watches from outside that memory
# and descriptors stay flat, that no process is left, and that every recording is whole.
#   soak.sh BUILD SECONDS [MB by which memory may grow]
# Half of the time is one run whose leaves are at fault and live; in the other half runs of a few
# seconds lose the process of their plugin, each in another way. The last line says what was seen.
set -euo pipefail
export LC_ALL=C

usage="usage: soak.sh BUILD SECONDS [MB]"
build=$(cd "${1:?$usage}" && pwd)
seconds=${2:?$usage}
allowed_mb=${3:-8}
work=$(mktemp -d "${TMPDIR:-/tmp}/lockstep-soak-XXXXXX")
trap 'rm -rf "$work"' EXIT
# This directory in a command line tells our processes from those of others.
cp "$(dirname "$0")/soak.xml" "$work/"
ln -s "$build/plugins/motion.so" "$build/tests/reliability/hostile.so" "$work/"

ticks=0 faults=0 runs=0 crashes=0 whole=0 failures=0
rss_first=0 rss_last=0 fds_first=0 fds_last=0

fail() {
  echo "soak: $*" >&2
  failures=$((failures + 1))
}

now() { echo "${EPOCHREALTIME/./}"; } # microseconds

# look PID: its resident memory in KiB and its open files; fails when it has ended.
look() {
  rss=$(awk '/^VmRSS/ {print $2}' "/proc/$1/status" 2>/dev/null)
  fds=$(find "/proc/$1/fd" -mindepth 1 2>/dev/null | wc -l)
  [ -n "$rss" ] && [ "$fds" -gt 0 ]
}

# watch PID SECONDS: from a quarter of its time to its end.
watch() {
  local start
  start=$(now)
  while [ $(($(now) - start)) -lt $(($2 * 950000)) ] && look "$1"; do
    if [ $(($(now) - start)) -gt $(($2 * 250000)) ]; then
      [ "$rss_first" -gt 0 ] || { rss_first=$rss fds_first=$fds; }
      rss_last=$rss fds_last=$fds
    fi
    sleep 0.1
  done
}

# What is left of ours.
processes() {
  local file
  for file in /proc/[0-9]*/cmdline; do
    if tr '\0' ' ' <"$file" 2>/dev/null | grep -qF "${work#/}"; then echo "$file"; fi
  done 2>/dev/null | grep -v "^/proc/$$/" || true
}

# number KEY: the first one of that name in the summary.
number() { grep -o "\"$1\":[0-9]*" "$work/summary.json" | sed -n '1s/.*://p'; }

# check_run CODE: what the last run left behind.
check_run() {
  runs=$((runs + 1))
  if [ "$1" -ne 124 ]; then # 124: its time was up, as it should be
    fail "run $runs ended with exit code $1: $(tail -n 3 "$work/log.txt")"
    return
  fi
  ticks=$((ticks + $(number ticks)))
  faults=$((faults + $(number faults)))
  if grep -q "its process" "$work/run.jsonl"; then crashes=$((crashes + 1)); fi
  if "$build/lockstep" log info "$work/run.jsonl" >"$work/info.txt" 2>&1; then
    whole=$((whole + 1))
  else
    fail "the recording of run $runs is not whole: $(tail -n 3 "$work/info.txt")"
  fi
  local left
  left=$(processes)
  [ -z "$left" ] || fail "run $runs left processes behind: $left"
}

# run SECONDS watched|unwatched OPTIONS…
run() {
  local time=$1 watched=$2 code=0
  shift 2
  "$build/lockstep" run "$work/soak.xml" --plugin-path "$work" --isolate --on-fault fail \
    --rate 1000 --timeout "$time" --seed "$runs" --record "$work/run.jsonl" --view none --json \
    --hang-limit 2 "$@" >"$work/summary.json" 2>"$work/log.txt" &
  local pid=$!
  [ "$watched" = unwatched ] || watch "$pid" "$time"
  wait "$pid" || code=$?
  check_run "$code"
}

RANDOM=1
end=$(($(now) + seconds * 1000000))
half=$(((seconds + 1) / 2))
run "$half" watched
[ "$faults" -gt 0 ] || fail "there was no fault"
[ $((rss_last - rss_first)) -le $((allowed_mb * 1024)) ] ||
  fail "memory grew from $rss_first to $rss_last KiB"
[ "$fds_last" -le "$fds_first" ] || fail "descriptors grew from $fds_first to $fds_last"
[ "$rss_first" -gt 0 ] || fail "nothing was seen of memory"

ways=(segv exit abort kill overflow "hang deaf" "exit thread" _exit)
# On a busy machine a run may end before the tick in which it was to crash.
while [ "$(now)" -lt "$end" ] || { [ "$crashes" -eq 0 ] && [ "$runs" -lt 20 ]; }; do
  slice=$((half < 5 ? 1 : 5))
  run "$slice" unwatched --arg "how=${ways[runs % ${#ways[@]}]}" \
    --arg crash=$((10 + RANDOM % (slice * 50)))
done
[ "$crashes" -gt 0 ] || fail "no process of a plugin has crashed"

echo "soak: $runs runs, $ticks ticks, $faults faults, $crashes runs with a crash;" \
  "memory $rss_first to $rss_last KiB, descriptors $fds_first to $fds_last;" \
  "$whole of $runs recordings whole; $failures failures"
[ "$failures" -eq 0 ]
