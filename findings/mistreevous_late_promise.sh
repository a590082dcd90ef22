#!/usr/bin/env bash
# mistreevous 4.3.1: the late result of an aborted action ends the next run of the same action.
#
# An action function may return a promise, and the action is running until it is fulfilled. When a guard aborts the action, its
# promise is forgotten, but only until the action runs again: then the result of the first promise is taken for that of the
# second. So an action that was aborted and started again succeeds when its first run ends, while its second run goes on, and
# the result of the second run is lost. A promise that stays pending when its run is over, as `current` below, avoids it.
#
# Debian packages: nodejs, npm. From npm: mistreevous 4.3.1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund mistreevous@4.3.1

cat >abort.cjs <<'JS'
const { BehaviourTree, State } = require("mistreevous");
const turn = () => new Promise((done) => setImmediate(done));

async function aborted(title, wrap) {
  console.log(title);
  let allowed = true;
  const finish = [];
  const tree = new BehaviourTree("root { action [Move] while(Allowed) }", {
    Allowed: () => allowed,
    Move: () => wrap(new Promise((done) => finish.push(done))),
  });
  const step = async (what) => {
    await turn();
    tree.step();
    console.log(`  ${what}: ${tree.getState().replace("mistreevous.", "")}, moves started: ${finish.length}`);
  };
  await step("started");
  allowed = false;
  await step("aborted by its guard");
  allowed = true;
  await step("started again");
  finish[0](State.SUCCEEDED);
  await step("the first move has succeeded");
  if (tree.isRunning()) {
    finish[1](State.FAILED);
    await step("the second move has failed");
  }
}

let runs = 0;
const current = (promise) => {
  const run = ++runs;
  return new Promise((done) => promise.then((state) => run === runs && done(state)));
};
(async () => {
  await aborted("a plain promise:", (promise) => promise);
  await aborted("a promise that only the current run fulfills:", current);
})();
JS
node abort.cjs >seen
diff - seen <<'SEEN'
a plain promise:
  started: running, moves started: 1
  aborted by its guard: failed, moves started: 1
  started again: running, moves started: 2
  the first move has succeeded: succeeded, moves started: 2
a promise that only the current run fulfills:
  started: running, moves started: 1
  aborted by its guard: failed, moves started: 1
  started again: running, moves started: 2
  the first move has succeeded: running, moves started: 2
  the second move has failed: failed, moves started: 2
SEEN
echo "mistreevous 4.3.1: as described"
