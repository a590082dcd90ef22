#!/usr/bin/env bash
# mistreevous 4.3.1: a guard that fails within the first step of its node aborts nothing, and no exit callback is called.
#
# Guards are evaluated before every leaf, so a leaf can make the guard of its own parent fail in the middle of a step. From the
# second step on, the running children are aborted, and the exit callbacks of all of them are called. In the first step the
# parent counts as not started yet: it fails, a child that is already running stays in the state running below it, and the exit
# callbacks, which the documentation promises for a node that fails or is aborted, are not called. So what an entry callback has
# started, such as a motor, is never stopped. Conditions that are read once before each step, as `sampled` below, avoid it.
#
# Debian packages: nodejs, npm. From npm: mistreevous 4.3.1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund mistreevous@4.3.1

cat >guard.cjs <<'JS'
const { BehaviourTree, State } = require("mistreevous");
const definition = `root {
  parallel while(Safe) entry(Enter, "both") exit(Exit, "both") {
    action [Drive] entry(Enter, "drive") exit(Exit, "drive")
    action [Look]
    action [Wait]
  }
}`;

function steps(title, unsafeFrom, sampled) {
  console.log(title);
  let safe = true, atStart = true, step = 0, said = [];
  const tree = new BehaviourTree(definition, {
    Safe: () => (sampled ? atStart : safe),
    Enter: (name) => said.push(`enter ${name}`),
    Exit: (result, name) => said.push(`exit ${name}${result.aborted ? " (aborted)" : ""}`),
    Drive: () => State.RUNNING,
    Look: () => { if (step >= unsafeFrom) safe = false; return State.RUNNING; },
    Wait: () => State.RUNNING,
  });
  do {
    ++step;
    atStart = safe;
    tree.step();
    const drive = tree.getTreeNodeDetails().children[0].children[0];
    const states = `tree ${tree.getState()}, drive ${drive.state}`.replaceAll("mistreevous.", "");
    console.log(`  step ${step}: ${said.join(", ") || "no callback"}; ${states}`);
    said = [];
  } while (tree.isRunning() && step < 5);
}
steps("unsafe in step 2:", 2, false);
steps("unsafe in step 1:", 1, false);
steps("unsafe in step 1, the guard is read before each step:", 1, true);
JS
node guard.cjs >seen
diff - seen <<'SEEN'
unsafe in step 2:
  step 1: enter both, enter drive; tree running, drive running
  step 2: exit drive (aborted), exit both (aborted); tree failed, drive ready
unsafe in step 1:
  step 1: enter both, enter drive; tree failed, drive running
unsafe in step 1, the guard is read before each step:
  step 1: enter both, enter drive; tree running, drive running
  step 2: exit drive (aborted), exit both (aborted); tree failed, drive ready
SEEN
echo "mistreevous 4.3.1: as described"
