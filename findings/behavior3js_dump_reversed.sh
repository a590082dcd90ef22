#!/usr/bin/env bash
# behavior3js 0.2.2: the children of a tree that is saved with dump() and loaded with load() are in the opposite order.
#
# dump() writes the identifiers of the children of every composite from the last to the first, and load() reads them as they
# stand. So a sequence that was saved runs backward, a priority selector prefers its last child, and it is right again after a
# second dump() and load(). The documentation of dump() only warns of the parameters of nodes. Turning around the children of
# every node that dump() returned, before they are stored, avoids it.
#
# Debian packages: nodejs, npm. From npm: behavior3js 0.2.2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund behavior3js@0.2.2

cat >dump.cjs <<'JS'
const b3 = require("behavior3js");
const ticked = [];
const leaves = {};
for (const name of ["Open", "Grasp", "Lift"])
  leaves[name] = b3.Class(b3.Action, { name, tick: () => (ticked.push(name), b3.SUCCESS) });

const tree = new b3.BehaviorTree();
tree.root = new b3.Sequence({ children: Object.values(leaves).map((Leaf) => new Leaf()) });
const copy = (source, change = (data) => data) => {
  const loaded = new b3.BehaviorTree();
  loaded.load(change(JSON.parse(JSON.stringify(source.dump()))), leaves);
  return loaded;
};
const turned = (data) => {
  for (const node of Object.values(data.nodes)) node.children?.reverse();
  return data;
};
const show = (what, shown) => {
  shown.tick({}, new b3.Blackboard());
  console.log(`${what}: ${ticked.splice(0).join(", ")}`);
};
show("as built", tree);
show("saved and loaded", copy(tree));
show("saved and loaded twice", copy(copy(tree)));
show("saved, its children turned around, and loaded", copy(tree, turned));
JS
node dump.cjs >seen
diff - seen <<'SEEN'
as built: Open, Grasp, Lift
saved and loaded: Lift, Grasp, Open
saved and loaded twice: Open, Grasp, Lift
saved, its children turned around, and loaded: Open, Grasp, Lift
SEEN
echo "behavior3js 0.2.2: as described"
