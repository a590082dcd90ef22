// The page's model of a run, without a browser: gaps, lines with the whole state, lines that come twice, long runs.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { BUILD, loadModel, lockstep, path, SOURCE, tree } from "./support.mjs";

let model;
before(async () => (model = await loadModel()));

const HEADER = {
  lockstep_recording: 1, tree: "Test", file: "t.xml", version: "0", rate_hz: 10, clock: "virtual", seed: 0, arguments: {},
  nodes: [
    { index: 0, path: "Test/pull", kind: "ParallelAbsolute", name: "pull", parent: null, barriers: [0.5, 1] },
    { index: 1, path: "Test/pull/arm", kind: "Advance", name: "arm", parent: 0 },
    { index: 2, path: "Test/pull/base", kind: "Advance", name: "base", parent: 0 },
  ],
  entries: [{ key: "door", type: "string" }],
};

function runOf(...lines) {
  const run = new model.Run();
  for (const line of [HEADER, ...lines]) run.feed(JSON.stringify(line));
  return run;
}
const running = (node, progress, held = 0) => [node, "running", progress, held ? 0 : 1, held];

test("a state stands until a line changes it, also over ticks that have no line", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0), running(2, 0)], limits: [[0, 0.5]] },
    { tick: 1, time_s: 0.1 },
    { lost: { ticks: 3, from: 2 } },
    { tick: 5, time_s: 0.5, nodes: [running(2, 0.5, 1), running(1, 0.25)] });
  assert.equal(run.lost, 3);
  assert.equal(run.lineAtTick(4), 1);
  const early = new model.Moment(run, 1), late = new model.Moment(run, 2);
  assert.deepEqual([early.held[2], late.held[2]], [0, 1]);
  assert.equal(model.waitOf(early, 2), null);
  assert.equal(model.waitOf(late, 2).text, "waits for arm at barrier 0.5");
  assert.deepEqual(model.waitOf(late, 2).for, [1]);
});

test("a question that was held at a cut is none until its node asks again", () => {
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, nodes: [{ index: 0, path: "q", kind: "Ask", name: "q", parent: null, options: ["yes", "no"] }] }));
  run.feed(JSON.stringify({ tick: 5, time_s: 0.5, nodes: [running(0, 0, 1)], whole: [] }));
  run.feed(JSON.stringify({ tick: 6, time_s: 0.6, nodes: [running(0, 0)], reasons: [[0, "Well?"]] }));
  const asked = [0, 1].map((line) => model.questionsOf(new model.Moment(run, line)).map((it) => it.text));
  assert.deepEqual(asked, [[], ["Well?"]]);
});

test("in the recording of a team, a tick of one robot is not between two ticks of another one", () => {
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, nodes: [
    { index: 0, path: "team", kind: "Team", name: "team", parent: null },
    { index: 1, path: "team/left", kind: "Robot", name: "left", parent: 0 },
    { index: 2, path: "team/left/guard", kind: "Condition", name: "guard", parent: 1 },
    { index: 3, path: "team/right", kind: "Robot", name: "right", parent: 0 }] }));
  const tick = (robot, ticked) => [robot, "running", 0, ticked, 0], guard = (ticked) => [2, "success", 1, ticked, 0];
  const left = [tick(1, 1), guard(1), tick(3, 0)], right = [tick(1, 0), guard(0), tick(3, 1)];
  const others = [tick(1, 1), guard(0), tick(3, 0)];
  [left, right, left, right, others, right, left].forEach((nodes, tick) => run.feed(JSON.stringify({ tick, time_s: tick / 20, nodes })));
  const successes = run.events.all.filter((it) => it.kind === "success" && it.node === 2);
  assert.deepEqual(successes.map(({ line }) => line), [0, 6]);
});

test("a node that waits for another robot has where that was heard last, and how long ago", () => {
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, nodes: [
    { index: 0, path: "Test/step", kind: "InStep", name: "step", parent: null, barriers: [0.5] },
    { index: 1, path: "Test/step/arm", kind: "Advance", name: "arm", parent: 0 },
    { index: 2, path: "Test/step/right", kind: "TeamMember", name: "right", parent: 0 }] }));
  const lines = [
    { nodes: [running(0, 0), running(1, 0.5, 1), running(2, 0.25)], limits: [[0, 0.5]], heard: [[2, 7, 3]] },
    { nodes: [], heard: [[2, 7, 4]] },
    { nodes: [] },
    { nodes: [], heard: [[2, 7, 4]] },
    { nodes: [[2, "failure", 0.25, 1, 0]], reasons: [[2, "not heard for 0.3 s"]] }];
  lines.forEach((line, tick) => run.feed(JSON.stringify({ tick, time_s: tick / 10, ...line })));
  const text = (line) => model.waitOf(new model.Moment(run, line), 1).text;
  assert.equal(text(1), "waits for right at barrier 0.5 (heard at 0.25, 0.00 s ago)");
  assert.equal(text(3), "waits for right at barrier 0.5 (heard at 0.25, 0.20 s ago)");
  assert.equal(text(4), "waits for right: not heard for 0.3 s (heard at 0.25, 0.30 s ago)");
});

test("a member of a barrier at 0 waits for those that are not reached, and an exchange for what it does not own", () => {
  const member = (index, name) => [
    { index, path: `Test/p/${name}`, kind: "SyncProgress", name, parent: 0 },
    { index: index + 1, path: `Test/p/${name}/Go`, kind: "Go", name: "Go", parent: index }];
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, nodes: [
    { index: 0, path: "Test/p", kind: "Parallel", name: "p", parent: null }, ...member(1, "one"), ...member(3, "other"),
    ...member(5, "third"), { index: 7, path: "Test/start", kind: "barrier", name: "start", parent: null, members: [2, 4],
      barriers: [0] },
    { index: 8, path: "Test/road", kind: "resources", name: "road", parent: null, members: [2, 4, 6],
      resources: ["a", "b", "c"] }] }));
  run.feed(JSON.stringify({ tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0)] }));
  const moment = new model.Moment(run, 0), { nodes } = run.shape;
  nodes[2].keeper = 7;
  assert.equal(model.waitOf(moment, 2).text, "waits to begin together with other/Go, of 'start'");
  nodes[2].keeper = nodes[4].keeper = 8;
  run.feed(JSON.stringify({ tick: 1, time_s: 0.1, nodes: [running(2, 0), running(3, 0), running(4, 0)],
    limits: [[1, -(2 ** 52 + 1 * 2 ** 26 + 3)], [3, 6]] }));
  const later = new model.Moment(run, 1);
  assert.equal(model.waitOf(later, 2).text, "owns a, waits for b (other/Go)");
  assert.deepEqual(model.ownersOf(later, nodes[8]).map(({ place }) => place), [0, 1, 1]);
});

test("a member of a pool that robots share waits for the robot that has it", () => {
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, nodes: [
    { index: 0, path: "Test/use", kind: "UseResources", name: "use", parent: null },
    { index: 1, path: "Test/use/drive", kind: "Go", name: "drive", parent: 0 },
    { index: 2, path: "Test/use/roads", kind: "TeamResources", name: "roads", parent: 0 },
    { index: 3, path: "Test/roads", kind: "resources", name: "roads", parent: null, members: [1], resources: ["road"] }] }));
  run.feed(JSON.stringify({ tick: 0, time_s: 0, nodes: [running(0, 0), running(2, 0)], limits: [[0, -1]],
    reasons: [[2, "'left' has 'road'"]] }));
  const moment = new model.Moment(run, 0);
  assert.equal(model.waitOf(moment, 1).text, "waits for road: 'left' has 'road'");
  assert.equal(model.isShared(moment, run.shape.nodes[3]), true);
});

test("a cut of the process is before the first line of the run that continued", () => {
  const resumed = { ...HEADER, first_tick: 3, resumed_after_s: 35.2 };
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0), running(2, 0)] },
    { tick: 1, time_s: 0.1 },
    { lost: { ticks: 1, from: 2 } }, { continued: { ticks: 3 } }, resumed, resumed,
    { tick: 3, time_s: 0.3, nodes: [running(0, 0), running(1, 0.25)], whole: [] });
  assert.deepEqual(run.cuts, [{ line: 2, after: 35.2 }]);
  assert.equal(model.cutText(35.2), "the process was cut here, and the run continued after 35 s");
  assert.deepEqual(runOf({ tick: 0, time_s: 0 }).cuts, []);
});

test("the first line of a run that continues has the whole state: what it leaves out is as before the first tick", () => {
  const [node, other] = [0, 2], run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, nodes: HEADER.nodes.map((it) => ({ ...it, pace: true })) }));
  for (const line of [
    { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0.25, 1), running(2, 0.5)], limits: [[node, 0.5]],
      rounds: [[node, 2, 3]], factors: [[1, 0.2]], reasons: [[1, "it is cold"]], heard: [[other, 7, 3]], entries: [[0, "open"]] },
    { continued: { ticks: 1 } }, { ...HEADER, first_tick: 1, resumed_after_s: 35 },
    { tick: 1, time_s: 0.1, nodes: [running(0, 0)], entries: [[0, "open"]], whole: [[0, "open"]] },
    { tick: 2, time_s: 0.2, nodes: [[0, "success", 1, 1, 0]], limits: [[node, 1]] }]) run.feed(JSON.stringify(line));
  const at = (line) => {
    const moment = new model.Moment(run, line);
    return [[...moment.status], moment.held[1], moment.progress[2], moment.limit(node), run.rounds.get(node).number.at(line),
      run.factors.get(1).at(line), model.valueAt(run.reasons.get(1), line), run.heard.get(other).at(line)];
  };
  assert.deepEqual(at(0), [[1, 1, 1], 1, 0.5, 0.5, 2, 0.2, "it is cold", 0]);
  assert.deepEqual(at(1), [[1, 0, 0], 0, 0, 0, 0, 1, "", undefined]);
  assert.equal(at(2)[3], 1);
  assert.deepEqual(run.events.all.filter(({ line }) => line === 1).map(({ kind, node: of }) => [kind, of]), [["halt", 1], ["halt", 2]]);
});

test("a line with the whole state makes idle what it does not name, and changes nothing else", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0.25), running(2, 0)] },
    { tick: 9, time_s: 0.9, full: true, nodes: [running(0, 0), running(1, 0.25)] });
  const moment = new model.Moment(run, 1);
  assert.deepEqual([...moment.status], [1, 1, 0]);
  assert.equal(run.nodes[1].length, 1);
  assert.deepEqual(run.events.all.map((event) => [event.kind, event.node]), [["start", 1], ["start", 2], ["halt", 2]]);
});

test("who joins a run does not take what there was for what happened", () => {
  const run = runOf(
    { tick: 70, time_s: 7, full: true, nodes: [running(0, 0.5), [1, "success", 1, 1, 0]], entries: [[0, "open"]] },
    { tick: 71, time_s: 7.1, nodes: [[0, "success", 1, 1, 0]], entries: [[0, "shut"]] });
  assert.deepEqual(run.events.all.map((event) => event.text), ["door = shut", "succeeded"]);
  assert.equal(run.entries[0][0].value, "open");
});

test("a part of a recording begins with a whole state: what there was, not what happened", () => {
  const run = runOf(
    { tick: 70, time_s: 7, nodes: [running(0, 0.5), [1, "success", 1, 1, 0], running(2, 0.5, 1)], entries: [],
      whole: [[0, "open"]] },
    { tick: 71, time_s: 7.1, nodes: [[0, "success", 1, 1, 0], [2, "idle", 0, 0, 0]], entries: [[0, "shut"]] });
  assert.deepEqual(run.entries[0], [{ line: 0, value: "open" }, { line: 1, value: "shut" }]);
  assert.deepEqual(run.events.all.map((event) => [event.line, event.text]), [[1, "door = shut"], [1, "succeeded"], [1, "halted"]]);
  assert.deepEqual([run.countsOf(1).succeeded, run.countsOf(2).held, run.countsOf(2).halted], [2, 0, 1]);
  // In the middle, such a line repeats what is known.
  const middle = runOf({ tick: 0, time_s: 0, nodes: [running(2, 0.5, 1)], entries: [[0, "open"]] },
    { tick: 1, time_s: 0.1, nodes: [running(2, 0.5, 1)], whole: [[0, "open"]] });
  assert.deepEqual([middle.entries[0].length, middle.countsOf(2).held], [1, 1]);
  // A tick of several moments.
  const moments = runOf({ tick: 70, time_s: 7, nodes: [running(1, 0, 1)], whole: [],
    moments: [[2, [[2, "success", 1, 0]]], [1, []]] });
  assert.deepEqual([moments.countsOf(1).held, moments.countsOf(2).succeeded, moments.events.all.length], [0, 2, 0]);
});

test("lines that come again after a connection was lost are taken once", () => {
  const line = { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0)], logs: [["Test/pull/arm", "info", "here"]] };
  const run = runOf(line, line, HEADER, line, { tick: 1, time_s: 0.1 }, line);
  assert.equal(run.lines, 2);
  assert.equal(run.events.all.filter((event) => event.kind === "log").length, 1);
});

test("on the wall clock a tick that overran is an event", () => {
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, clock: "wall" }));
  for (const [tick, time_s] of [[0, 0], [1, 0.1], [2, 0.4], [5, 0.7]]) run.feed(JSON.stringify({ tick, time_s }));
  assert.deepEqual(run.events.all.map((event) => [event.kind, event.line]), [["overrun", 2]]);
});

test("a version that the page does not know is refused", () => {
  assert.throws(() => new model.Run().feed(JSON.stringify({ ...HEADER, lockstep_recording: 2 })), /version 1, not 2/);
});

test("a long run keeps every change of state and forgets some progress of long ago", () => {
  const run = runOf({ tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0)] });
  for (let tick = 1; tick < 1000; ++tick) {
    run.feed(JSON.stringify({ tick, time_s: tick / 10, nodes: [running(1, tick / 1000, tick % 100 === 50 ? 1 : 0)] }));
  }
  const column = run.nodes[1], states = column.states.length;
  column.thin();
  assert.ok(column.length < 800 && column.length > 700, `${column.length} changes`);
  assert.equal(column.states.length, states);
  assert.equal(new model.Moment(run, 50).held[1], 1);
  assert.equal(new model.Moment(run, 51).held[1], 0);
  assert.equal(new model.Moment(run, 999).progress[1], 0.999);
  const thinner = new model.Thinner(100, 10);
  for (let change = 0; change < 101; ++change) thinner.count(run.nodes);
  assert.ok(column.length < 700);
  thinner.events(run.events);
  assert.ok(run.events.all.length <= 10 || run.events.all.length <= states);
});

test("activations are told apart, with what was held in them", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(1, 0)] }, { tick: 1, time_s: 0.1, nodes: [running(1, 0.5, 1)] },
    { tick: 2, time_s: 0.2, nodes: [running(1, 0.5)] }, { tick: 3, time_s: 0.3, nodes: [[1, "failure", 0.5, 1, 0]] },
    { tick: 4, time_s: 0.4, nodes: [running(1, 0)] }, { tick: 5, time_s: 0.5, nodes: [[1, "idle", 0, 0, 0]] });
  assert.deepEqual(model.activations(run, 1, 5, 9), [
    { from: 4, to: 5, result: 0, held: 0 }, { from: 0, to: 3, result: 3, held: 0.1 },
  ]);
  assert.equal(model.laneText(run, 1), "held once for 0.10 s, failed once");
});

test("a node is held to the end of the run, not to the beginning of its last tick", () => {
  const run = runOf({ tick: 0, time_s: 0, nodes: [running(1, 0)] }, { tick: 1, time_s: 0.1, nodes: [running(1, 0.5, 1)] },
    { tick: 2, time_s: 0.2, nodes: [] });
  assert.equal(model.laneText(run, 1), "held once for 0.10 s");
  run.feed(JSON.stringify({ end: { result: "stopped", reason: "max_ticks", ticks: 3, time_s: 0.3 } }));
  assert.equal(model.laneText(run, 1), "held once for 0.20 s");
  const held = ([activation]) => activation.held.toFixed(6);
  assert.deepEqual([held(model.activations(run, 1, 1, 9)), held(model.activations(run, 1, 2, 9))], ["0.000000", "0.200000"]);
  assert.deepEqual(model.heldSpans(run, 1, 0, 1), [[0.1, 0.3]]);
});

test("a node that completes in each tick is counted in each", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [[1, "failure", 0, 1, 0], [2, "success", 1, 1, 0]] },
    { tick: 1, time_s: 0.1, nodes: [[2, "success", 1, 0, 0]] },
    { tick: 9, time_s: 0.9, nodes: [[2, "success", 1, 1, 0]] });
  assert.equal(run.countsOf(1).failed, 10);
  assert.equal(run.countsOf(2).succeeded, 2);
  assert.deepEqual(model.laneSpans(run, 1, 0, 2).map((span) => span.again), [true]);
  assert.deepEqual(model.laneSpans(run, 2, 0, 2).map((span) => span.again), [false, false]);
});

test("a node that completes anew with the same result has an event and an activation of its own", () => {
  const count = (ticked) => [1, "success", 0, ticked, 0], ready = [2, "success", 0, 1, 0];
  const run = runOf({ tick: 0, time_s: 0, nodes: [count(1), ready] }, { tick: 1, time_s: 0.1, nodes: [count(0)] },
    { tick: 2, time_s: 0.2, nodes: [count(1)] }, { tick: 3, time_s: 0.3, nodes: [count(0)] }, { tick: 4, time_s: 0.4, nodes: [count(1)] });
  assert.deepEqual(run.events.all.map(({ line, kind, node }) => [line, kind, node]),
    [[0, "success", 1], [0, "success", 2], [2, "success", 1], [4, "success", 1]]);
  assert.deepEqual(model.activations(run, 1, 4, 9).map(({ from, to }) => [from, to]), [[4, 4], [2, 2], [0, 0]]);
  assert.equal(model.activations(run, 2, 4, 9).length, 1);
  assert.equal(model.laneText(run, 1), "succeeded 3 times");
});

test("a page that misses lines has the counts of the program, and says what it has missed", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(1, 0)], full: true, counts: [], written: [] },
    { tick: 1, time_s: 0.1, nodes: [[1, "failure", 0.5, 1, 0]], entries: [[0, "a"]] },
    { tick: 300, time_s: 30, nodes: [running(1, 0)], entries: [[0, "c"]], full: true,
      counts: [[1, 2, 150, 0, 1, 7, 3]], written: [[0, 9]] },
    { tick: 301, time_s: 30.1, nodes: [[1, "failure", 0, 1, 0]] });
  assert.deepEqual(run.countsOf(1), { succeeded: 2, failed: 151, skipped: 0, halted: 1, held: 7, faults: 3 });
  const [said] = run.events.all.filter((event) => event.kind === "lost");
  assert.match(said.text, /too slow.*: 2 succeeded, .*1 halted, 7 held, 3 faults, 7 values of entries/);
  // Who comes late has missed nothing, and knows the counts.
  const late = runOf({ tick: 9, time_s: 0.9, full: true, nodes: [running(1, 0)], counts: [[1, 0, 5, 0, 0, 0, 0]] });
  assert.equal(late.countsOf(1).failed, 5);
  assert.deepEqual(late.events.all, []);
});

const ALL = { hidden: new Set(), only: null };
const stops = ({ events }, filter = ALL) => {
  const found = [];
  for (let line = events.nextLine(-1, filter); line !== null; line = events.nextLine(line, filter)) found.push(line);
  return found;
};

test("the keys stop at the events that are chosen, and never at an entry that changes in every tick", () => {
  const lines = [];
  for (let tick = 0; tick < 90; ++tick) {
    lines.push({ tick, time_s: tick / 10, entries: tick < 80 ? [[0, `${tick}`]] : tick === 85 ? [[0, "end"]] : [],
      nodes: [running(1, 0), ...(tick === 15 ? [[2, "failure", 0, 1, 0]] : [])], ...(tick === 40 ? { logs: [["Test", "info", "x"]] } : {}) });
  }
  const run = runOf(...lines);
  assert.deepEqual(stops(run), [0, 15, 40, 85]); // arm starts, base fails, a log, the last value alone
  assert.equal(run.events.previousLine(84, ALL), 40);
  assert.equal(run.events.previousLine(1, { hidden: new Set(["completions"]), only: null }), null);
  assert.deepEqual(stops(run, { hidden: new Set(["logs", "entries"]), only: null }), [0, 15]);
  assert.deepEqual(stops(run, { hidden: new Set(), only: 2 }), [15]);
});

// The node 1 keeps 2 in step, and 0 keeps 1; 3 is below 2.
const NESTED = { ...HEADER, nodes: [
  { index: 0, path: "T/p", kind: "ParallelAbsolute", name: "p", parent: null, barriers: [0.5] },
  { index: 1, path: "T/p/q", kind: "ParallelAbsolute", name: "q", parent: 0, barriers: [0.5] },
  { index: 2, path: "T/p/q/s", kind: "Sequence", name: "s", parent: 1 },
  { index: 3, path: "T/p/q/s/a", kind: "Advance", name: "a", parent: 2 }] };

test("each hold has its release, and what is below a held node has neither", () => {
  const all = [running(0, 0), running(1, 0), running(2, 0), running(3, 0)];
  const holds = (...lines) => {
    const run = new model.Run();
    run.feed(JSON.stringify(NESTED));
    lines.forEach((nodes, tick) => run.feed(JSON.stringify({ tick, time_s: tick / 10, nodes })));
    return run.events.all.filter(({ kind }) => kind === "hold" || kind === "release").map(({ line, kind, node }) => [line, kind, node]);
  };
  // `q` holds `s`, then is held itself, then all go on, then `q` holds `s` again.
  assert.deepEqual(
    holds(all, [running(2, 0, 1), running(3, 0, 1)], [running(1, 0, 1)], all, [running(2, 0, 1), running(3, 0, 1)], all),
    [[1, "hold", 2], [2, "hold", 1], [3, "release", 1], [3, "release", 2], [4, "hold", 2], [5, "release", 2]]);
  // `q` is held with all below it; then only `s` is, by `q`; then it is halted.
  assert.deepEqual(holds(all, [running(1, 0, 1), running(2, 0, 1), running(3, 0, 1)], [running(1, 0)], [[2, "idle", 0, 0, 0], [3, "idle", 0, 0, 0]]),
    [[1, "hold", 1], [2, "release", 1], [2, "hold", 2]]);
});

test("many short holds are one event, few are each one", () => {
  const held = (many) => runOf(...Array.from({ length: 2 * many }, (_, tick) =>
    ({ tick, time_s: tick / 10, nodes: [running(0, 0), running(1, 0), running(2, 0, 1 - (tick % 2))] })));
  const few = held(3), many = held(200);
  assert.deepEqual(stops(few, { hidden: new Set(["completions"]), only: null }), [0, 1, 2, 3, 4, 5]);
  assert.deepEqual(stops(many, { hidden: new Set(["completions"]), only: null }), [0]);
  const folded = many.events.all.filter(model.isFolded);
  assert.equal(new Set(folded.map(({ series }) => series)).size, 1);
  assert.equal(folded.at(-1).number, 400);
  assert.equal(model.laneText(many, 2), "held 50 % of 39.90 s (200 times)");
  folded[0].series.open = true;
  assert.equal(many.events.all.filter(model.isFolded).length, 0);
});

test("the events of a tick are in the order of their causes", () => {
  const run = new model.Run();
  run.feed(JSON.stringify({ ...HEADER, entries: [{ key: "door", type: "string", writers: [1] }] }));
  run.feed(JSON.stringify({ tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0), running(2, 0)] }));
  run.feed(JSON.stringify({ tick: 1, time_s: 0.1, nodes: [[0, "failure", 0, 1, 0], [1, "failure", 0, 1, 0], [2, "idle", 0, 0, 0]],
    faults: [[1, "broken"]], entries: [[0, "open"]], logs: [["Test/pull/arm", "info", "pulls"]] }));
  run.feed(JSON.stringify({ end: { result: "failure", reason: "completed", ticks: 2, time_s: 0.2 } }));
  assert.deepEqual(run.events.all.filter(({ line }) => line === 1).map(({ kind, node, text }) => [kind, node, text]), [
    ["log", null, "Test/pull/arm: pulls"], ["entry", null, "door = open"], ["fault", 1, "broken"], ["failure", 1, "failed"],
    ["failure", 0, "failed"], ["halt", 2, "halted"], ["end", null, "run ended: failure (completed) after 2 ticks"],
  ]);
});

test("the spread has the bound of the measures: what delta or barriers allow, and the longest step", () => {
  const lines = [[0, 0], [0.1, 0.3], [0.3, 0.5], [0.5, 0.5]].map(([arm, base], tick) =>
    ({ tick, time_s: tick / 10, nodes: [running(0, 0), running(1, arm), running(2, base)], limits: [[0, 0.5]] }));
  const run = runOf(...lines);
  const { largest, allowed, step, unbounded } = model.spreadBound(run, 0, 0, 3);
  assert.deepEqual([largest.toFixed(6), allowed, step, unbounded], ["0.200000", 0.5, 0.3, ""]);
  assert.equal(model.spreadIn(run, 0, 3), 0);
  run.feed(JSON.stringify({ tick: 4, time_s: 0.4, nodes: [running(1, 0.2)] }));
  assert.match(model.spreadBound(run, 0, 0, 4).unbounded, /fell/); // goes on where it was
  assert.equal(model.spreadIn(run, 1, 3), null); // holds none
});

// The summary of a run, and the page's run of its recording.
function measured(file) {
  const recording = path("measured.jsonl"), words = ["run", file, "--plugin-path", join(BUILD, "plugins"), "--clock", "virtual",
    "--max-ticks", "5000", "--json", "--record", recording];
  let summary;
  try {
    summary = lockstep(...words);
  } catch (error) {
    summary = error.stdout; // a run that fails
  }
  const run = new model.Run();
  for (const line of readFileSync(recording, "utf8").trim().split("\n")) run.feed(line);
  return [JSON.parse(summary).synchronized_nodes, run];
}

test("spread, bound and longest step are those of the summary", () => {
  const failing = tree(`<ParallelAbsolute name="both" barriers="0.5">
    <Fallback name="x"><Inverter><AlwaysSuccess/></Inverter><Advance step="0.2"/></Fallback>
    <Sequence name="y" memory="true"><AlwaysSuccess/><AlwaysFailure/></Sequence></ParallelAbsolute>`);
  const files = ["late_progress", "paper/example5", "fetch_and_carry", "nested", "cart", "two_robots"].map((name) => join(SOURCE, `trees/${name}.xml`));
  let count = 0;
  for (const file of [...files, failing]) {
    const [nodes, run] = measured(file);
    for (const { path: of, largest_spread, spread_bound, step_length } of nodes) {
      const { largest, allowed, step, unbounded, isAbout } = model.spreadBound(run, run.shape.byPath.get(of), 0, run.last);
      const numbers = [largest, step, unbounded ? null : Math.min(1, allowed + step)].map((it) => it?.toFixed(9));
      assert.deepEqual(numbers, [largest_spread, step_length, spread_bound].map((it) => it?.toFixed(9)), `${file} ${of} ${unbounded}`);
      assert.equal(isAbout, false);
      ++count;
    }
  }
  assert.ok(count > 6, `${count} nodes`);
});

test("the longest step of a run with ticks that have no line is an estimate", () => {
  const at = (tick, arm) => ({ tick, time_s: tick / 10, nodes: [running(0, 0), running(1, arm), running(2, arm)], limits: [[0, 0.5]] });
  const { step, isAbout, unbounded } = model.spreadBound(runOf(at(0, 0), at(1, 0.1), at(5, 0.5)), 0, 0, 2);
  assert.deepEqual([step.toFixed(6), isAbout, unbounded], ["0.100000", true, ""]);
  // A part that begins within an activation: what was before is not known.
  const part = model.spreadBound(runOf(at(7, 0.2), at(8, 0.3)), 0, 0, 1);
  assert.deepEqual([part.step.toFixed(6), part.isAbout, part.unbounded], ["0.100000", false, ""]);
});

test("numbers have six digits at most, and stay as they are in names", () => {
  for (const [value, wanted] of [["33.66666663299995", "33.6667"], ["0.1;0.30000000000000004", "0.1;0.3"], ["-0.000012345678", "-0.0000123457"],
    ["v1.234567.8", "v1.234567.8"], ["2.5", "2.5"], ["123456789.123456", "123456789"]]) {
    assert.equal(model.shortNumbers(value), wanted);
  }
});

// What a store has of it.
const shown = (run, span = null) => ({ run, line: run.last, looking: { span } });

test("each span has a width: before the first tick, after one, of a part that begins late, without a rate", () => {
  const late = 1e9;
  const idle = [0, "idle", 0, 0, 0];
  const empty = runOf(), once = runOf({ tick: 0, time_s: 0, nodes: [idle] });
  const part = runOf({ tick: 7, time_s: late, full: true, nodes: [running(0, 0), running(1, 0)] });
  const done = runOf({ tick: 7, time_s: late, full: true, nodes: [[0, "success", 1, 1, 0]] });
  const free = new model.Run();
  for (const line of [{ ...HEADER, rate_hz: 0 }, { tick: 0, time_s: 3, nodes: [running(0, 0)] }]) free.feed(JSON.stringify(line));
  for (const run of [empty, once, part, done, free]) {
    for (const [from, to] of [model.spanShown(shown(run)), model.chartSpan(shown(run), 0)]) {
      assert.ok(to - from >= Math.max(1e-3, run.period) * 0.99, `${from} to ${to}`);
      assert.ok(to - from < 10, `${from} to ${to}`);
    }
  }
});

test("a tick of several moments: the events and counts of each, and the state after it", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0)] },
    // Arm fails twice and base succeeds, then arm begins again.
    { tick: 1, time_s: 0.1, nodes: [[2, "success", 0, 1, 0]],
      moments: [[2, [[1, "failure", 1, 0], [2, "idle", 0, 0]]], [1, [[1, "running", 1, 0], [2, "success", 1, 0]]]] },
    { tick: 2, time_s: 0.2, nodes: [[1, "success", 0.5, 1, 0], [2, "idle", 0, 0, 0]] });
  assert.deepEqual(run.events.all.filter((event) => event.line === 1).map((event) => [event.kind, event.node, event.text]),
    [["failure", 1, "failed 2 times"], ["start", 1, "started"], ["success", 2, "succeeded"]]);
  assert.equal(run.status(1, 1), 1);
  const arm = run.countsOf(1), base = run.countsOf(2);
  assert.deepEqual([arm.failed, arm.succeeded, arm.halted, base.succeeded], [2, 1, 0, 1]);
});

test("what a tick with very many moments only counts is counted, and an event", () => {
  const run = runOf(
    { tick: 0, time_s: 0, nodes: [running(0, 0), running(1, 0)], moments: [[1, []]], more: [[1, 3, 400, 0, 1, 0, 0]] });
  assert.deepEqual(run.events.all.filter((event) => event.node === 1).map((event) => event.text),
    ["started", "succeeded 3 times", "failed 400 times"]);
  const { succeeded, failed, halted } = run.countsOf(1);
  assert.deepEqual([succeeded, failed, halted], [3, 400, 1]);
});
