// How far apart the children of a synchronized node are, and what bounds it (judge/measure): the largest distance that delta
// or the barriers allow, and the longest step of a tick.
import { STATUS } from "./columns";
import { IDLE, PROGRESS_EPSILON, RUNNING, SKIPPED, SUCCESS } from "./recording";
import type { Run } from "./run";
import type { ShapeNode } from "./shape";

// Null: it has none yet.
export function progressAt(run: Run, node: number, line: number): number | null {
  const column = run.nodes[node], place = column.at(line);
  if (place < 0) return null;
  const status = column.flags[place] & STATUS;
  if (status === IDLE) return null;
  return status === SUCCESS ? 1 : column.progress[place];
}

function measured(run: Run, keeper: ShapeNode): number[] {
  return keeper.inStep.filter((child) => !run.shape.nodes[child].isGuard);
}

// Null: the node is not active.
export function spreadIn(run: Run, keeper: number, line: number): number | null {
  const it = run.shape.nodes[keeper];
  if (!it.isGroup && run.status(keeper, line) === IDLE) return null;
  let least = Infinity, most = -Infinity;
  for (const child of measured(run, it)) {
    const progress = progressAt(run, child, line);
    const isLeftOut = run.status(child, line) === SKIPPED || (progress === null && it.ignoresIdle);
    if (isLeftOut) continue;
    least = Math.min(least, progress ?? 0);
    most = Math.max(most, progress ?? 0);
  }
  return most < least ? null : most - least;
}

// The largest delta of the time, or the largest distance of barriers.
function allowedIn(run: Run, keeper: ShapeNode, first: number, last: number): number {
  const limits = run.limits.get(keeper.index);
  const seen: number[] = [];
  for (let place = Math.max(0, limits?.placeAt(first) ?? 0); limits && place < limits.length && limits.lines[place] <= last; ++place) {
    seen.push(limits.values[place]);
  }
  if (keeper.synchronization === "relative") return Math.max(0, ...seen);
  const marks = keeper.barriers.length > 0 ? keeper.barriers : seen.filter(Number.isFinite);
  const all = [0, ...marks, 1].sort((a, b) => a - b);
  return Math.max(...all.slice(1).map((mark, place) => mark - all[place]));
}

export interface SpreadBound {
  largest: number; // spread
  allowed: number;
  step: number; // the longest of a child in a tick
  falls: boolean; // the progress of a child fell: there is no bound
}

interface Known extends SpreadBound {
  first: number; // lines
  last: number;
}

function addSteps(run: Run, child: number, from: number, it: Known) {
  const { lines, flags, progress, length } = run.nodes[child];
  for (let place = Math.max(1, run.nodes[child].at(from)); place < length && lines[place] <= it.last; ++place) {
    const now = progressAt(run, child, lines[place]);
    if (now === null) continue;
    const step = now - (progressAt(run, child, lines[place - 1]) ?? 0);
    it.step = Math.max(it.step, step / (run.ticks[lines[place]] - run.ticks[lines[place - 1]]));
    const goesOn = [place - 1, place].every((one) => (flags[one] & STATUS) === RUNNING);
    it.falls ||= goesOn && progress[place] < progress[place - 1] - PROGRESS_EPSILON;
  }
}

const MOST = 5_000_000; // values that are looked at for the largest spread; of more, some lines are left out

const known = new WeakMap<Run, Map<number, Known>>();

// Between two lines. Of a run that goes on, only what is new is looked at.
export function spreadBound(run: Run, keeper: number, first: number, last: number): SpreadBound {
  const node = run.shape.nodes[keeper], ofRun = known.get(run) ?? new Map<number, Known>();
  known.set(run, ofRun);
  let it = ofRun.get(keeper);
  if (!it || it.first !== first || it.last > last) ofRun.set(keeper, (it = { first, last: first, largest: 0, allowed: 0, step: 0, falls: false }));
  const from = it.last;
  it.last = last;
  const children = measured(run, node), stride = Math.max(1, Math.ceil((children.length * (last - from)) / MOST));
  for (let line = from; line <= last; line += stride) it.largest = Math.max(it.largest, spreadIn(run, keeper, line) ?? 0);
  for (const child of children) addSteps(run, child, from, it);
  it.allowed = allowedIn(run, node, first, last);
  return { ...it };
}
