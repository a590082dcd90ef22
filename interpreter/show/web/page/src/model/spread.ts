// How far apart the children of a synchronized node are, and what bounds it: the measures of judge/measure, in a part of a
// run, from the lines of its recording (record/read/recorded_moments).
import { HELD, STATUS, TICKED, type NodeColumn } from "./columns";
import { IDLE, PROGRESS_EPSILON, RUNNING, SKIPPED, SUCCESS } from "./recording";
import type { Run } from "./run";
import type { Shape, ShapeNode } from "./shape";

// From this one on, a recording names the children that have succeeded.
const LAW_OF_NAMES = 3;

function flagsAt(column: NodeColumn, line: number): number {
  const place = column.at(line);
  return place < 0 ? 0 : column.flags[place];
}

// The nodes around each member of a group, below the node that has all members.
function nodesAround({ nodes }: Shape, members: number[]): number[][] {
  const parent = (node: number) => nodes[node].parent ?? 0;
  let top = members[0] ?? 0;
  for (let other of members) {
    while (other !== top) {
      if (other > top) other = parent(other);
      else top = parent(top);
    }
  }
  return members.map((member) => {
    const around: number[] = [];
    for (let node = parent(member); node > top; node = parent(node)) around.push(node);
    return around;
  });
}

// What a synchronized node compared in a tick, of each node that it holds.
class Sample {
  readonly children: number[];
  readonly progress: Float64Array; // not a number: it was left out, or is a guard
  readonly held: Uint8Array;
  readonly guards: number;
  private readonly places: Int32Array; // of the last line that was read, in the columns
  private readonly members: number[];
  private readonly around: number[][];

  constructor(private readonly run: Run, private readonly keeper: ShapeNode) {
    const { nodes } = run.shape;
    this.children = keeper.inStep;
    this.progress = new Float64Array(this.children.length);
    this.held = new Uint8Array(this.children.length);
    this.places = new Int32Array(this.children.length).fill(-1);
    this.guards = this.children.filter((child) => nodes[child].isGuard).length;
    this.members = keeper.isGroup ? this.children.map((child) => nodes[child].parent ?? child) : this.children;
    this.around = keeper.isGroup ? nodesAround(run.shape, this.members) : [];
  }

  private status(node: number, line: number): number {
    return line < 0 ? IDLE : this.run.status(node, line);
  }
  // Lines are mostly read one after the other.
  private placeAt(child: number, line: number): number {
    const column = this.run.nodes[this.children[child]];
    let place = this.places[child];
    if (place < 0 || place >= column.length || column.lines[place] > line) place = column.at(line);
    else if (place + 1 < column.length && column.lines[place + 1] <= line) place = column.lines[place + 1] === line ? place + 1 : column.at(line);
    return (this.places[child] = place);
  }

  // True if the node asked its children in the tick of the line.
  read(line: number): boolean {
    const { run, keeper, children, progress, held } = this;
    if (!(flagsAt(run.nodes[keeper.index], line) & TICKED)) return false;
    const runs = this.status(keeper.index, line - 1) === RUNNING;
    let isAsked = keeper.isGroup;
    for (let child = 0; child < children.length; ++child) {
      const place = this.placeAt(child, line), column = run.nodes[children[child]];
      const flags = place < 0 ? 0 : column.flags[place], used = place < 0 ? 0 : column.progress[place];
      if (flags & TICKED) isAsked = true;
      const isLeftOut = run.shape.nodes[children[child]].isGuard || this.isLeftOut(child, used, line, runs);
      progress[child] = isLeftOut ? NaN : used;
      held[child] = this.isHeld(child, flags, line) ? 1 : 0;
    }
    return isAsked;
  }

  private isLeftOut(child: number, used: number, line: number, runs: boolean): boolean {
    const { run, keeper, members, around } = this;
    if (run.shape.nodes[this.children[child]].isRobot) return false; // it counts 0 where it has not begun
    if (!runs && !keeper.isGroup) return false;
    const last = this.status(members[child], line - 1);
    if (runs && last === SKIPPED) return true;
    if (!keeper.isGroup || used !== 0) return false;
    if (runs && around[child].some((node) => this.status(node, line - 1) === SKIPPED)) return true;
    return keeper.ignoresIdle && (!runs || last === IDLE);
  }

  // Also if it has been halted since.
  private isHeld(child: number, flags: number, line: number): boolean {
    const { keeper } = this, member = keeper.isGroup ? flagsAt(this.run.nodes[this.members[child]], line) : TICKED;
    if (!(member & TICKED)) return false;
    if (flags & HELD) return true;
    if ((flags & STATUS) !== IDLE) return false;
    if (keeper.isGroup && (member & STATUS) === RUNNING) return true; // waits to begin
    return !(flags & TICKED) && this.status(this.children[child], line - 1) === RUNNING;
  }

  hasSucceeded(child: number, line: number): boolean {
    const { run, keeper } = this, node = this.children[child];
    if (run.status(node, line) === SUCCESS) return true;
    const ended = run.ended.get(line);
    if (!ended) return false;
    return ended.includes(node) || ((run.header?.law ?? 1) < LAW_OF_NAMES && ended.includes(keeper.index));
  }

  least(): number {
    return this.progress.reduce((least, one) => (one < least ? one : least), 1);
  }
  spread(): number {
    return Math.max(0, this.progress.reduce((most, one) => (one > most ? one : most), 0) - this.least());
  }
}

// Null: the node did not ask its children.
export function spreadIn(run: Run, keeper: number, line: number): number | null {
  const sample = new Sample(run, run.shape.nodes[keeper]);
  return line <= run.last && sample.read(line) ? sample.spread() : null;
}

export interface SpreadBound {
  largest: number; // spread
  allowed: number; // the most between the least child and the farthest that a child may be
  step: number; // the longest of a child in a tick
  isAbout: boolean; // the step: some ticks have no line, or are left out
  unbounded: string; // why there is no bound; "": there is one
}

const MOST = 5_000_000; // values that are looked at; of more, some lines are left out

class Measure {
  largest = 0;
  allowed = 0;
  step = 0;
  isAbout = false;
  unbounded = "";
  private readonly sample: Sample;
  private readonly last: Float64Array; // in the last sample
  private readonly wasHeld: Uint8Array;
  private lastLine = -1; // that had a sample
  private goesOn = false; // it runs since that sample
  private runs: boolean;

  constructor(private readonly run: Run, private readonly keeper: ShapeNode, readonly first: number, public next = first) {
    this.sample = new Sample(run, keeper);
    this.last = new Float64Array(keeper.inStep.length);
    this.wasHeld = new Uint8Array(keeper.inStep.length);
    // What was before is not known.
    this.runs = first > 0 ? run.status(keeper.index, first - 1) === RUNNING : (run.ticks[0] ?? 0) > 0;
  }

  upTo(last: number) {
    const { children } = this.sample, stride = Math.max(1, Math.ceil((children.length * (last + 1 - this.next)) / MOST));
    for (; this.next <= last; this.next += stride) this.take(this.next, stride > 1);
    this.next = Math.max(this.next, last + 1);
    this.isAbout ||= children.some((child) => this.run.nodes[child].isThin);
  }

  private take(line: number, isRough: boolean) {
    const { run, keeper, sample } = this, isAsked = sample.read(line), { progress, held } = sample;
    if (run.cuts.some((cut) => cut.line === line)) this.goesOn = false; // leaves may have started again
    if (isAsked) {
      const ticks = this.goesOn ? this.ticksTo(line, isRough) : 1;
      let leftOut = 0;
      for (let child = 0; child < progress.length; ++child) {
        const now = progress[child], before = this.last[child];
        if (now !== now) ++leftOut;
        if (this.goesOn) this.see(Math.abs(now - before) / ticks);
        if (now < 1 && sample.hasSucceeded(child, line)) this.see(1 - now);
        this.judge(now, before, !isRough && this.wasHeld[child] === 1);
        this.last[child] = now;
        this.wasHeld[child] = held[child];
      }
      if (leftOut > sample.guards) this.unbounded ||= "a child was left out";
      const least = sample.least(), limit = run.limits.get(keeper.index)?.at(line) ?? 0;
      this.largest = Math.max(this.largest, sample.spread());
      this.allowed = Math.max(this.allowed, Math.min(1, keeper.synchronization === "relative" ? least + limit : limit) - least);
      this.isAbout ||= ticks > 1;
      this.lastLine = line;
    }
    const isRunning = run.status(keeper.index, line) === RUNNING;
    this.goesOn = (isAsked || this.goesOn) && isRunning;
    this.runs = (this.runs || isAsked) && isRunning;
  }

  // In how many ticks it came from the last sample to this one: those that have no line count, and those that are left out.
  private ticksTo(line: number, isRough: boolean): number {
    const { ticks } = this.run, passed = ticks[line] - ticks[this.lastLine];
    return isRough ? passed : passed - (line - this.lastLine) + 1;
  }

  private see(step: number) {
    if (step > this.step) this.step = step;
  }

  private judge(now: number, before: number, wasHeld: boolean) {
    if (!this.runs) {
      if (now > PROGRESS_EPSILON && !this.keeper.isGroup) this.unbounded ||= "a child had progress before its first tick";
    } else if (now < before - PROGRESS_EPSILON) {
      this.unbounded ||= "the progress of a child fell";
    } else if (wasHeld && now > before + PROGRESS_EPSILON) {
      this.unbounded ||= "the progress of a held child rose";
    }
  }
}

const known = new WeakMap<Run, Map<number, Measure>>();

// Between two lines. Of a run that goes on, only what is new is looked at.
export function spreadBound(run: Run, keeper: number, first: number, last: number): SpreadBound {
  const ofRun = known.get(run) ?? new Map<number, Measure>();
  known.set(run, ofRun);
  let it = ofRun.get(keeper);
  if (!it || it.first !== first || it.next > last + 1) ofRun.set(keeper, (it = new Measure(run, run.shape.nodes[keeper], first)));
  it.upTo(Math.min(last, run.last));
  const { largest, allowed, step, isAbout, unbounded } = it;
  return { largest, allowed, step, isAbout, unbounded };
}
