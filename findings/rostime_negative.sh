#!/usr/bin/env bash
# @foxglove/rostime 1.1.3: a negative duration has one of two forms; they are not equal, and toString() prints neither rightly.
#
# ROS has one form: -1.5 s is {sec: -2, nsec: 500000000}, and nsec is never negative. subtract() and fixTime() give it.
# fromSec(), fromMillis(), fromMicros() and fromNanoSec() give {sec: -1, nsec: -500000000}. areEqual() finds the two different,
# and compare() finds -1.9 s later than -1.5 s. toString(), even with its argument that allows negative times, prints -1.5 s as
# -2.500000000 or as -1.-500000000. fromDate() of a date before 1970 is a second too early, except at whole seconds.
#
# toSec() and toNanoSec() are right for both forms, so they can be compared and printed. fixTime(time, true) makes the form of
# ROS. genpy 0.6.16, Debian 12, is shown for the form of ROS.
#
# Debian packages: python3 (3.11), nodejs, npm and, without installing them, python3-genpy, python3-genmsg and python3-yaml.
# From npm: @foxglove/rostime 1.1.3.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq python3-genpy=0.6.16-2 python3-genmsg=0.6.0-1 python3-yaml=6.0-3+b2 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund @foxglove/rostime@1.1.3

cat >forms.py <<'PY'
import genpy

for seconds in (-0.25, -1.5, -2):
    duration = genpy.Duration.from_sec(seconds)
    print(f"genpy, {seconds} s: sec {duration.secs}, nsec {duration.nsecs}")
PY
cat >forms.cjs <<'JS'
const time = require("@foxglove/rostime");
const form = ({ sec, nsec }) => `sec ${sec}, nsec ${nsec}`;
const zero = { sec: 0, nsec: 0 };
const shown = (made) => `${form(made)}, toString() ${time.toString(made, true)}, toSec() ${time.toSec(made)}`;
for (const seconds of [-0.25, -1.5, -2]) {
  const difference = time.subtract(zero, time.fromSec(-seconds));
  const made = time.fromSec(seconds);
  console.log(`subtract(), ${seconds} s: ${shown(difference)}`);
  console.log(`fromSec(), ${seconds} s: ${shown(made)}`);
  const fixed = time.fixTime(made, true);
  console.log(`  areEqual() ${time.areEqual(difference, made)}, with fixTime() ${time.areEqual(difference, fixed)}`);
}
for (const [name, made] of Object.entries({
  "fromMillis()": time.fromMillis(-1500),
  "fromMicros()": time.fromMicros(-1500000),
  "fromNanoSec()": time.fromNanoSec(-1500000000n),
}))
  console.log(`${name}, -1.5 s: ${form(made)}`);

const later = time.isGreaterThan(time.fromSec(-1.9), time.subtract(zero, time.fromSec(1.5)));
console.log(`-1.9 s is greater than -1.5 s: ${later}`);
for (const milliseconds of [-1, -1000, -1500]) {
  const made = time.fromDate(new Date(milliseconds));
  console.log(`fromDate(), ${milliseconds} ms: ${form(made)}, toDate() ${time.toDate(made).getTime()} ms`);
}
JS
{
  PYTHONPATH=usr/lib/python3/dist-packages /usr/bin/python3 forms.py
  node forms.cjs
} >seen
diff - seen <<'SEEN'
genpy, -0.25 s: sec -1, nsec 750000000
genpy, -1.5 s: sec -2, nsec 500000000
genpy, -2 s: sec -2, nsec 0
subtract(), -0.25 s: sec -1, nsec 750000000, toString() -1.750000000, toSec() -0.25
fromSec(), -0.25 s: sec 0, nsec -250000000, toString() 0.-250000000, toSec() -0.25
  areEqual() false, with fixTime() true
subtract(), -1.5 s: sec -2, nsec 500000000, toString() -2.500000000, toSec() -1.5
fromSec(), -1.5 s: sec -1, nsec -500000000, toString() -1.-500000000, toSec() -1.5
  areEqual() false, with fixTime() true
subtract(), -2 s: sec -2, nsec 0, toString() -2.000000000, toSec() -2
fromSec(), -2 s: sec -2, nsec 0, toString() -2.000000000, toSec() -2
  areEqual() true, with fixTime() true
fromMillis(), -1.5 s: sec -1, nsec -500000000
fromMicros(), -1.5 s: sec -1, nsec -500000000
fromNanoSec(), -1.5 s: sec -1, nsec -500000000
-1.9 s is greater than -1.5 s: true
fromDate(), -1 ms: sec -1, nsec -1000000, toDate() -1001 ms
fromDate(), -1000 ms: sec -1, nsec 0, toDate() -1000 ms
fromDate(), -1500 ms: sec -2, nsec -500000000, toDate() -2500 ms
SEEN
echo "@foxglove/rostime 1.1.3: as described"
