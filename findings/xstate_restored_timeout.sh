#!/usr/bin/env bash
# xstate 5.33.3: a machine that is restored from a snapshot never takes the delayed transitions of the states it is in.
#
# getPersistedSnapshot() is documented to keep a machine over a restart. The documentation says that entry actions do not run
# again, and that invoked actors are started again. A transition of `after` is neither: it is not in the snapshot, and start()
# does not plan it. So a robot that drives for at most a second drives on forever after a restart, and no error tells of it. A
# state that is entered later has its delays. A delayed event of raise() is lost too.
#
# Around it: let an invoked actor wait, as `waiting` below. It starts anew, with the whole delay.
#
# Debian packages: nodejs, npm. From npm: xstate 5.33.3.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund xstate@5.33.3

cat >restore.mjs <<'JS'
import { createActor, createMachine, fromCallback, raise, SimulatedClock } from "xstate";

let clock;
const second = 1000;
const wait = fromCallback(({ sendBack }) => {
  const timer = clock.setTimeout(() => sendBack({ type: "late" }), second);
  return () => clock.clearTimeout(timer);
});
const states = {
  after: { driving: { after: { [second]: "stopped" } }, stopped: {} },
  raise: { driving: { entry: raise({ type: "late" }, { delay: second }), on: { late: "stopped" } }, stopped: {} },
  waiting: { driving: { invoke: { src: wait }, on: { late: "stopped" } }, stopped: {} },
};
const again = { on: { again: { target: ".driving", reenter: true } } };

for (const [name, inner] of Object.entries(states)) {
  const machine = createMachine({ ...again, initial: "driving", states: inner });
  const report = [];
  const run = (what, actor, time) => {
    clock.increment(time);
    report.push(`${what} ${actor.getSnapshot().value}`);
  };
  clock = new SimulatedClock();
  const actor = createActor(machine, { clock }).start();
  run("after 0.5 s:", actor, second / 2);
  const saved = JSON.stringify(actor.getPersistedSnapshot());
  run("after 1.5 s:", actor, second);

  clock = new SimulatedClock();
  const restored = createActor(machine, { clock, snapshot: JSON.parse(saved) }).start();
  run("restored, after an hour:", restored, 3600 * second);
  restored.send({ type: "again" });
  run("entered again, after 1.5 s:", restored, 1.5 * second);
  console.log(`${name}: ${report.join("; ")}`);
}
JS
node restore.mjs >seen
diff - seen <<'SEEN'
after: after 0.5 s: driving; after 1.5 s: stopped; restored, after an hour: driving; entered again, after 1.5 s: stopped
raise: after 0.5 s: driving; after 1.5 s: stopped; restored, after an hour: driving; entered again, after 1.5 s: stopped
waiting: after 0.5 s: driving; after 1.5 s: stopped; restored, after an hour: stopped; entered again, after 1.5 s: stopped
SEEN
echo "xstate 5.33.3: as described"
