#!/usr/bin/env bash
# node-pid-controller 1.0.1: the first update, and each one in the same millisecond as the last, counts as a whole second.
#
# Without `dt`, the time between two updates is documented to be calculated. If it is 0 ms, or there was no update yet, the
# controller takes 1 s in its place. With an error of 1 m, the integral is 1 m s after the first update of a loop at 100 Hz,
# in place of 0.01. So a robot starts with the correction of a hundred steps. In a loop without a fixed rate, each two updates
# within a millisecond add a second again. reset() does not help: the next update is a first one.
#
# Around it: give `dt`, as here 0.01, and call update() at this rate. `i_max` bounds the integral.
#
# Debian packages: nodejs, npm. From npm: node-pid-controller 1.0.1. Date.now() is replaced, so that the times are exact.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund node-pid-controller@1.0.1

cat >steps.cjs <<'JS'
const Controller = require("node-pid-controller");
let now = 1_700_000_000_000;
Date.now = () => now;

// The output is the integral alone, of an error that stays 1 m.
function run(what, times, dt) {
  const controller = new Controller({ k_p: 0, k_i: 1, k_d: 0, dt });
  controller.setTarget(1);
  const start = now;
  const outputs = times.map((time) => {
    now = start + time;
    return controller.update(0).toFixed(3);
  });
  console.log(`${what}: ${outputs.join(" ")}`);
}
run("at 0, 10, 20 and 30 ms", [0, 10, 20, 30]);
run("at 0, 10, 10 and 20 ms", [0, 10, 10, 20]);
run("at 0, 10, 20 and 30 ms, dt 0.01", [0, 10, 20, 30], 0.01);
JS
node steps.cjs >seen
diff - seen <<'SEEN'
at 0, 10, 20 and 30 ms: 1.000 1.010 1.020 1.030
at 0, 10, 10 and 20 ms: 1.000 1.010 2.010 2.020
at 0, 10, 20 and 30 ms, dt 0.01: 0.010 0.020 0.030 0.040
SEEN
echo "node-pid-controller 1.0.1: as described"
