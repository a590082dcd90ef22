#!/usr/bin/env bash
# behaviortree 2.1.0: a decorator takes a sequence or selector that is still running for one that has ended.
#
# A task that runs gives the value RUNNING, and the decorators pass it on. A branch that runs gives a list of numbers, its place
# in the tree, and the decorators do not know it: around a running sequence, AlwaysSucceedDecorator and InvertDecorator give
# success at once, and AlwaysFailDecorator failure. So the tree goes on, and the task in the sequence begins anew in each step:
# with start(), but without end(). An own decorator that also passes on a list, as PatientInvert below, avoids it.
#
# Debian packages: nodejs, npm. From npm: behaviortree 2.1.0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund behaviortree@2.1.0

cat >branch.cjs <<'JS'
const { BehaviorTree, Sequence, Selector, Task, Decorator, RUNNING, SUCCESS, FAILURE, decorators } = require("behaviortree");
class PatientInvert extends Decorator {
  decorate(run) {
    const result = run();
    return result === RUNNING || typeof result === "object" ? result : !result;
  }
}
const identity = (node) => node;
const wraps = {
  "no decorator": identity,
  AlwaysSucceedDecorator: (node) => new decorators.AlwaysSucceedDecorator({ node }),
  AlwaysFailDecorator: (node) => new decorators.AlwaysFailDecorator({ node }),
  InvertDecorator: (node) => new decorators.InvertDecorator({ node }),
  PatientInvert: (node) => new PatientInvert({ node }),
};
const branches = {
  "a task": identity,
  "a sequence with the task": (task) => new Sequence({ nodes: [task] }),
  "a selector with the task": (task) => new Selector({ nodes: [task] }),
};

for (const [decorator, wrap] of Object.entries(wraps)) {
  for (const [inside, branch] of Object.entries(branches)) {
    let runs = 0, starts = 0;
    const task = new Task({ start: () => void ++starts, run: () => (++runs < 3 ? RUNNING : SUCCESS) });
    const tree = new BehaviorTree({ tree: wrap(branch(task)), blackboard: {} });
    const results = [1, 2, 3].map(() => {
      tree.step();
      return tree.lastResult === SUCCESS ? "success" : tree.lastResult === FAILURE ? "failure" : "running";
    });
    console.log(`${decorator} around ${inside}: ${results.join(", ")}; starts: ${starts}`);
  }
}
JS
node branch.cjs >seen
diff - seen <<'SEEN'
no decorator around a task: running, running, success; starts: 1
no decorator around a sequence with the task: running, running, success; starts: 1
no decorator around a selector with the task: running, running, success; starts: 1
AlwaysSucceedDecorator around a task: running, running, success; starts: 1
AlwaysSucceedDecorator around a sequence with the task: success, success, success; starts: 3
AlwaysSucceedDecorator around a selector with the task: success, success, success; starts: 3
AlwaysFailDecorator around a task: running, running, failure; starts: 1
AlwaysFailDecorator around a sequence with the task: failure, failure, failure; starts: 3
AlwaysFailDecorator around a selector with the task: failure, failure, failure; starts: 3
InvertDecorator around a task: running, running, failure; starts: 1
InvertDecorator around a sequence with the task: success, success, failure; starts: 3
InvertDecorator around a selector with the task: success, success, failure; starts: 3
PatientInvert around a task: running, running, failure; starts: 1
PatientInvert around a sequence with the task: running, running, failure; starts: 1
PatientInvert around a selector with the task: running, running, failure; starts: 1
SEEN
echo "behaviortree 2.1.0: as described"
