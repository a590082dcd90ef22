#!/usr/bin/env bash
# Runs soak.xml at 1 kHz on the wall clock with random faults while the machine is unkind to it, and
# checks from outside how each run ends.
#   soak.sh BUILD SECONDS [MB by which memory may grow]
# Half of the time is one long run: its memory and descriptors stay flat. In the other half runs of a
# few seconds meet one misfortune each, in turn: the functions that begin with meet_. Each run has to
# end in time, with the right exit code, with a recording that is whole, or readable where it cannot
# be whole, and without a process that is left. The last line says what was seen.
set -euo pipefail
export LC_ALL=C

# Where that is allowed, with mounts of our own, which end with us.
if [ -z "${SOAK_HAS_MOUNTS-}" ]; then
  for options in --mount "--mount --map-root-user"; do
    # shellcheck disable=SC2086
    if unshare $options true 2>/dev/null; then SOAK_HAS_MOUNTS=yes exec unshare $options "$0" "$@"; fi
  done
fi

usage="usage: soak.sh BUILD SECONDS [MB]"
build=$(cd "${1:?$usage}" && pwd)
seconds=${2:?$usage}
allowed_mb=${3:-8}
half=$(((seconds + 1) / 2))
slice=$((half < 60 ? 1 : 4)) # of a short run
hang_limit=1 patience=20

ticks=0 faults=0 runs=0 crashes=0 whole=0 readable=0 failures=0
rss_first=0 rss_last=0 fds_first=0 fds_last=0

work=$(mktemp -d "${TMPDIR:-/tmp}/lockstep-soak-XXXXXX")
disk=$work/disk has_disk=no # a small one
mkdir "$disk"
trap 'umount "$disk" 2>/dev/null || true; rm -rf "$work"' EXIT
if [ -n "${SOAK_HAS_MOUNTS-}" ] && mount -t tmpfs -o size=256k none "$disk" 2>/dev/null; then has_disk=yes; fi
# This directory in a command line tells our processes from those of others.
cp "$(dirname "$0")/soak.xml" "$work/"
ln -s "$build/plugins/motion.so" "$build/tests/reliability/hostile.so" "$work/"
mkfifo "$work/stuck" # full, and nobody reads it
exec 7<>"$work/stuck"
dd if=/dev/zero of="$work/stuck" bs=4096 count=16 oflag=nonblock status=none

fail() {
  echo "soak: run $runs (${misfortune#meet_}): $*" >&2
  failures=$((failures + 1))
}

now() { echo "${EPOCHREALTIME/./}"; } # microseconds
a_moment() { sleep "0.$((100 + RANDOM % 600))"; }
send() { kill -"$1" "${@:2}" 2>/dev/null || true; }
one_of() {
  local all=("$@")
  echo "${all[RANDOM % $#]}"
}

# look PID: its resident memory in KiB and its open files; fails when it has ended.
look() {
  rss=$(awk '/^VmRSS/ {print $2}' "/proc/$1/status" 2>/dev/null)
  fds=$(find "/proc/$1/fd" -mindepth 1 2>/dev/null | wc -l)
  [ -n "$rss" ] && [ "$fds" -gt 0 ]
}

# What is left of ours.
processes() {
  local file
  for file in /proc/[0-9]*/cmdline; do
    if tr '\0' ' ' <"$file" 2>/dev/null | grep -qF "${work#/}"; then echo "$file"; fi
  done 2>/dev/null | grep -v "^/proc/$$/" || true
}

# within SECONDS CONDITION…: waits for it; fails when it does not come true.
within() {
  local deadline=$(($(now) + $1 * 1000000))
  shift
  until "$@"; do
    [ "$(now)" -lt $deadline ] || return 1
    sleep 0.02
  done
}
runs_no_more() { ! kill -0 "$pid" 2>/dev/null; }
reads_no_more() { ! kill -0 "$reader" 2>/dev/null; }
nothing_is_left() { left=$(processes) && [ -z "$left" ]; }
has_begun() { [ -s "$record" ] || runs_no_more; } # the file has its name once there is a line in it
is_closed() { tail -n 1 "$record" | grep -q '"reason"'; }
has_lost_plugin() { grep -q "its process" "$record"; }

# What a run writes goes here, until the next.
usual_places() {
  out=$work/summary.json err=$work/log.txt record=$work/run.jsonl blocks=unlimited
  rm -f "$out" "$record" "$disk"/*
}
usual_places

# start SECONDS OPTIONS…: a run, until it ticks. `plugins` are the processes of its plugins.
start() {
  local time=$1
  shift
  runs=$((runs + 1))
  (
    ulimit -f "$blocks"
    exec "$build/lockstep" run "$work/soak.xml" --plugin-path "$work" --on-fault fail --rate 1000 \
      --timeout "$time" --seed "$runs" --record "$record" --json --hang-limit "$hang_limit" "$@" \
      >"$out" 2>"$err" 7>&- 8>&-
  ) &
  pid=$!
  within $patience has_begun || fail "does not begin"
  mapfile -t plugins < <(pgrep -P "$pid")
}

# finish CODES whole|readable: waits for the end, which is one of these exit codes (124: its time was
# up), and checks what the run leaves behind.
finish() {
  local code=0
  within $patience runs_no_more 2>/dev/null || { # where bash says "Killed"
    fail "does not end"
    send KILL "$pid"
  }
  wait "$pid" || code=$?
  [[ " $1 " = *" $code "* ]] ||
    fail "ended with exit code $code instead of $1: $(tail -qn 3 "$work/log.txt")"
  if ! "$build/lockstep" log info "$record" >"$work/info.txt" 2>&1; then
    fail "its recording cannot be read: $(tail -n 3 "$work/info.txt")"
  elif is_closed && ! grep -q "lacks" "$work/info.txt"; then
    whole=$((whole + 1))
  elif [ "$2" = readable ]; then
    readable=$((readable + 1))
  else
    fail "its recording is not whole: $(tail -n 3 "$work/info.txt")"
  fi
  within 2 nothing_is_left || fail "leaves processes behind: $left"
  if [ -s "$work/summary.json" ]; then
    ticks=$((ticks + $(number ticks)))
    faults=$((faults + $(number faults)))
  fi
  if has_lost_plugin; then crashes=$((crashes + 1)); fi
}

# number KEY: the first one of that name in the summary.
number() { grep -o "\"$1\":[0-9]*" "$work/summary.json" | sed -n '1s/.*://p'; }

# A reader of stderr that can be stopped, `reader`.
read_messages() {
  exec 8> >(exec cat >"$work/log.txt" 7>&-)
  reader=$!
  err=/dev/fd/8
}

# It reads no more, and there is no room for what comes.
stop_reader() {
  send STOP "$reader"
  local size
  for size in 4096 1; do # what is too little for a page is left to bytes
    dd if=/dev/zero of=/dev/fd/8 bs=$size count=65536 oflag=nonblock status=none 2>/dev/null || true
  done
  exec 8>&-
}

# Longer than the hang limit.
stop_for_long() {
  send STOP "$@"
  sleep $((hang_limit + 1))
  send CONT "$@"
}

# What a plugin does to its process.
meet_crash() {
  local way
  way=$(one_of segv exit abort kill overflow "hang deaf" "exit thread" _exit)
  start "$slice" --isolate --view none --arg "how=$way" --arg crash=$((10 + RANDOM % 100))
  finish 124 whole
}
meet_crash_in_our_process() {
  local way
  way=$(one_of segv exit _exit abort overflow hang "hang deaf" "exit thread")
  start 60 --view none --arg "how=$way" --arg crash=$((10 + RANDOM % 100))
  finish 6 readable
}

# What others do to its process, or to ours.
meet_killed_plugin() {
  start "$slice" --isolate --view none
  a_moment
  send KILL "$(one_of "${plugins[@]}")"
  finish 124 whole
  has_lost_plugin || fail "the loss of the plugin's process is not told"
}
meet_stopped_plugin() {
  start $((hang_limit + 3)) --isolate --view none
  a_moment
  send STOP "$(one_of "${plugins[@]}")"
  finish 124 whole
  has_lost_plugin || fail "the loss of the plugin's process is not told"
}
meet_stop_of_all() {
  start $((hang_limit + 3)) --isolate --view none
  a_moment
  stop_for_long "$pid" "${plugins[@]}"
  finish 124 whole
  ! has_lost_plugin || fail "a plugin has lost its process though only time was lost"
}
meet_stop_of_host() {
  start $((hang_limit + 3)) --isolate --view none
  a_moment
  stop_for_long "$pid"
  finish 124 whole
  ! has_lost_plugin || fail "a plugin has lost its process though only time was lost"
}
meet_kill() {
  start 60 --isolate --view none
  a_moment
  [ $((RANDOM % 2)) -eq 0 ] || send STOP "${plugins[@]}"
  send KILL "$pid"
  finish 137 readable
}

# Signals.
meet_signal() {
  local name
  name=$(one_of INT QUIT TERM HUP USR1 USR2 ALRM XCPU VTALRM PROF IO PWR STKFLT)
  start 60 --isolate --view none
  a_moment
  send "$name" "$pid"
  finish "$((128 + $(kill -l "$name"))) 5" whole # 5: the soak's tree has a halt that fails by chance
}
meet_two_signals() {
  local one two
  one=$(one_of INT QUIT TERM HUP USR1 ALRM) two=$(one_of INT QUIT TERM)
  start 60 --isolate --view none
  a_moment
  send "$one" "$pid"
  [ $((RANDOM % 2)) -eq 0 ] || sleep 0.06
  send "$two" "$pid"
  finish "$((128 + $(kill -l "$one"))) $((128 + $(kill -l "$two"))) 5" readable
}
meet_harmless_signals() {
  start "$slice" --isolate --view none
  for _ in 1 2 3 4 5 6 7 8; do send "$(one_of PIPE XFSZ CHLD URG WINCH CONT)" "$pid"; done
  finish 124 whole
}
meet_suspension() {
  start $((slice + 2)) --isolate --view none
  a_moment
  send TSTP "$pid"
  sleep 1
  send CONT "$pid"
  finish 124 whole
}

# Readers.
meet_paused_reader() {
  read_messages
  start $((slice + 1)) --isolate --view plain
  stop_reader
  sleep 1
  send CONT "$reader"
  finish 124 whole
  within 2 reads_no_more || fail "the reader is kept"
  [ -z "$(tail -c 1 "$work/log.txt")" ] || fail "the last message is cut"
}
meet_stuck_reader() {
  read_messages
  start "$slice" --isolate --view plain
  stop_reader
  finish 124 whole
  send KILL "$reader"
  grep -q "lost: no process read them" "$work/summary.json" || fail "the loss of messages is not told"
}
meet_reader_who_leaves() {
  read_messages
  start "$slice" --isolate --view plain
  exec 8>&-
  send KILL "$reader"
  finish 124 whole
}
meet_stuck_reader_of_results() {
  out=$work/stuck
  start "$slice" --isolate --view none
  within $patience is_closed || fail "its recording waits for its results"
  send INT "$pid"
  finish 124 whole
}
meet_full_disk_for_results() {
  out=/dev/full
  start "$slice" --isolate --view none
  finish 124 whole
}

# Disks.
put_on_disk() {
  record=$disk/run.jsonl err=$disk/log.txt
  [ $has_disk = yes ] || blocks=256 # not a full disk, but a limit for each file
}
meet_full_disk() {
  put_on_disk
  start "$slice" --isolate --view plain
  finish 124 readable
}
meet_full_disk_that_matters() {
  put_on_disk
  start 60 --isolate --view plain --on-record-error stop
  finish "8 5" readable
}

# The long run, from a quarter of its time to its end.
watch() {
  local start looks=0
  start=$(now)
  while [ $(($(now) - start)) -lt $((half * 950000)) ] && look "$pid"; do
    if [ $(($(now) - start)) -gt $((half * 250000)) ]; then
      [ "$rss_first" -gt 0 ] || { rss_first=$rss fds_first=$fds; }
      rss_last=$rss fds_last=$fds
    fi
    sleep 0.1
    looks=$((looks + 1))
    [ $((looks % 50)) -ne 10 ] || disturb
  done
}
# With what costs a run nothing but time.
disturb() {
  case $((RANDOM % 3)) in
    0) stop_for_long "$pid" "${plugins[@]}" ;;
    1) send "$(one_of PIPE XFSZ CHLD URG WINCH CONT)" "$pid" ;;
    2) stop_for_long "$reader" ;;
  esac
}

RANDOM=1
misfortune="the long one"
end=$(($(now) + seconds * 1000000))
read_messages
start "$half" --isolate --view plain
exec 8>&-
watch
within $((half / 10)) runs_no_more || true # the rest of its time
finish 124 whole
[ "$faults" -gt 0 ] || fail "there was no fault"
[ $((rss_last - rss_first)) -le $((allowed_mb * 1024)) ] ||
  fail "memory grew from $rss_first to $rss_last KiB"
[ "$fds_last" -le "$fds_first" ] || fail "descriptors grew from $fds_first to $fds_last"
[ "$rss_first" -gt 0 ] || fail "nothing was seen of memory"
! has_lost_plugin || fail "a plugin has lost its process though only time was lost"

mapfile -t misfortunes < <(compgen -A function meet_)
met=0
while [ "$met" -eq 0 ] || [ "$(now)" -lt "$end" ]; do  # at least one, however busy the machine is
  misfortune=${misfortunes[met % ${#misfortunes[@]}]}
  usual_places
  "$misfortune"
  met=$((met + 1))
done

echo "soak: $runs runs, $met misfortunes of ${#misfortunes[@]} kinds, $ticks ticks, $faults faults," \
  "$crashes runs that lost a plugin; memory $rss_first to $rss_last KiB, descriptors $fds_first to" \
  "$fds_last; $whole recordings whole, $readable readable; $failures failures"
[ "$failures" -eq 0 ]
