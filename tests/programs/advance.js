#!/usr/bin/env node
// Advance of the plugin motion.
const say = (what) => process.stdout.write(JSON.stringify(what) + "\n");
say({lockstep: 1, leaves: [{id: "Advance", progress: true,
     ports: [{name: "step", type: "double", default: 0.01}]}]});
const leaves = {};
require("readline").createInterface({input: process.stdin}).on("line", (line) => {
  const {do: what, leaf, ports} = JSON.parse(line);
  if (what === "start") leaves[leaf] = {done: 0, step: ports.step};
  if (what === "create" || what === "halt") say({leaf, done: true});
  if (what !== "tick") return;
  const it = leaves[leaf];
  it.done = Math.min(1, it.done + it.step);
  say({leaf, status: it.done >= 1 - 1e-9 ? "success" : "running", progress: it.done});
});
