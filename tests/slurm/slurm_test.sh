#!/usr/bin/env bash
# slurm_test.sh LOCKSTEP: the Slurm script of docs/studies.md on a cluster of this machine, with 8 tasks, of which one is
# requeued while it runs; merged, the study must be the one that a single process makes. As root. munged, slurmctld and
# slurmd are of this test: their files are in a temporary directory, and they end with it.
set -euo pipefail
lockstep=$(realpath "$1")
cd "$(dirname "$0")/../.."
for program in munged slurmctld slurmd sbatch; do
  command -v $program >/dev/null || { echo "slurm: no $program: apt-get install slurm-wlm munge" && exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "slurm: slurmd runs as root only" && exit 77; }
work=$(mktemp -d /tmp/lockstep-slurm.XXXXXX)
daemons=()
clean_up() {
  scancel --state=PENDING,RUNNING 2>/dev/null || true
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    kill "${daemons[i]}" 2>/dev/null || true
    wait "${daemons[i]}" 2>/dev/null || true
  done
  rm -rf "$work"
}
trap clean_up EXIT
free_port() { python3 -c 'import socket; it = socket.socket(); it.bind(("127.0.0.1", 0)); print(it.getsockname()[1])'; }
# until SECONDS COMMAND…: asks again until it succeeds.
until_done() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    [ $SECONDS -lt $end ] || { echo "slurm: gave up: $*" >&2 && tail -n 20 "$work"/*.log >&2 && exit 1; }
    sleep 0.2
  done
}

mkdir "$work/state" "$work/spool" "$work/bin"
ln -s "$lockstep" "$work/bin/lockstep"
(umask 077 && head -c 1024 /dev/urandom >"$work/munge.key")
munged --foreground --force --socket="$work/munge" --key-file="$work/munge.key" --pid-file="$work/munged.pid" \
  --log-file="$work/munged.log" --seed-file="$work/munge.seed" 2>/dev/null &
daemons+=($!)
export SLURM_CONF=$work/slurm.conf
host=$(hostname -s)
cat >"$SLURM_CONF" <<TEXT
ClusterName=lockstep
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=socket=$work/munge
CredType=cred/munge
SlurmUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MailProg=/bin/true
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE
TEXT
until_done 10 test -S "$work/munge"
slurmctld -D -i >/dev/null 2>&1 &
daemons+=($!)
slurmd -D -N "$host" >/dev/null 2>&1 &
daemons+=($!)
until_done 60 bash -c 'sinfo --noheader --format=%T | grep -qE "idle|mixed|allocated"'

# The script of the page, made smaller.
sed -n '/^#!\/bin\/bash$/,/^```$/p' docs/studies.md | sed -e '/^```$/d' -e 's/array=1-100/array=1-8/' -e 's/cpus-per-task=4/cpus-per-task=1/' \
  -e 's/1000000/120000/' -e 's,/100",/8",' >"$work/array.sh"
grep -q 'array=1-8' "$work/array.sh" && grep -q -- '--resume --shard "$SLURM_ARRAY_TASK_ID/8"' "$work/array.sh"
cp -r trees "$work/"
cd "$work"
export PATH=$work/bin:$PATH
job=$(sbatch --parsable --output="$work/task-%a.log" array.sh)
has_rows() { [ "$(wc -l <"part-$1/runs.csv")" -gt 100 ]; }
until_done 120 has_rows 1
until_done 30 scontrol requeue "${job}_1"
before=$(wc -l <part-1/runs.csv)
# A task that was requeued waits for two minutes, unless it is told its time.
is_pending() { squeue --noheader --job="${job}_1" --format=%T | grep -q PENDING; }
until_done 60 is_pending
scontrol update JobId="${job}_1" StartTime=now
has_ended() { [ -z "$(squeue --noheader --job="$job")" ]; }
until_done 900 has_ended

lockstep study merge part-* --out merged --no-plots >/dev/null
lockstep study trees/paper/example5.xml --runs 120000 --grid noise=0,0.01,0.05 --out whole --no-plots >/dev/null 2>&1
all=$(($(wc -l <part-1/runs.csv)))
[ "$before" -lt "$all" ] || { echo "slurm: the task had ended before it was requeued" >&2 && exit 1; }
diff -r merged whole
echo "slurm: 8 tasks, one requeued after $before of $all lines: the same bytes as one process"
