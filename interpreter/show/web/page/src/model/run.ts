// A run, from the lines of its recording, whoever brings them. Keeps the whole of it, so that any
// moment can be shown.
import { HeardColumn, NodeColumn, NumberColumn, HELD, STATUS, TICKED } from "./columns";
import { Counts, type CountsOfNode } from "./counts";
import { Events } from "./events";
import { STATUSES, type End, type Header, type Line, type LogLine, type TickLine } from "./recording";
import { Thinner } from "./thin";
import { shapeOf, type Shape } from "./shape";

export interface EntryChange {
  line: number;
  value: string | null; // null: too long to be shown
}

// The process was cut before this line, and the run continued in another one.
export interface Cut {
  line: number;
  after: number; // seconds in which there was no run; its own time has none of them
}

const STATUS_NUMBERS = new Map<string, number>(STATUSES.map((name, number) => [name, number]));

export class Run {
  header: Header | null = null;
  shape: Shape = { nodes: [], roots: [], byPath: new Map() };
  ticks: number[] = []; // of each line
  times: number[] = []; // of each line, in seconds
  nodes: NodeColumn[] = [];
  limits = new Map<number, NumberColumn>();
  rounds = new Map<number, { number: NumberColumn; of: NumberColumn }>();
  factors = new Map<number, NumberColumn>(); // of nodes that are paced; 1 before the first
  reasons = new Map<number, EntryChange[]>(); // of leaves that give one; "" is none
  heard = new Map<number, HeardColumn>(); // of nodes that stand for other robots
  entries: EntryChange[][] = [];
  ended = new Map<number, number[]>(); // by line: nodes that succeeded in its tick, and are idle after it
  events = new Events(this);
  private counts = new Counts(0, 0);
  end: End | null = null;
  lost = 0; // ticks without a line
  cuts: Cut[] = [];
  version = 0; // grows with what is fed
  private joins = false; // the line tells what there was, not what happened
  private robotOf: number[] = []; // of each node, in the recording of a team; else empty
  private tickedBefore: number[] = []; // of each node: TICKED, if its robot's last tick reached it
  private turned: number[] = []; // that the line holds, or holds no longer
  private readonly thinner = new Thinner();

  get lines(): number {
    return this.ticks.length;
  }
  get last(): number {
    return this.ticks.length - 1;
  }
  get period(): number {
    return this.header && this.header.rate_hz > 0 ? 1 / this.header.rate_hz : 0;
  }
  // In seconds: until when there is a state.
  get endTime(): number {
    return Math.max(this.times[this.last] ?? 0, this.end?.time_s ?? 0);
  }
  // What is so in the first line may have been so before.
  isEarlier(line: number): boolean {
    return line === 0 && (this.ticks[0] ?? 0) > 0;
  }
  // The last line that is not later.
  lineAtTime(time: number): number {
    return lastNotAbove(this.times, time);
  }
  lineAtTick(tick: number): number {
    return lastNotAbove(this.ticks, tick);
  }

  feed(text: string) {
    const line = JSON.parse(text) as Line;
    ++this.version;
    if ("lockstep_recording" in line) this.begin(line);
    else if ("tick" in line) this.take(line);
    else if ("lost" in line) this.lose(line.lost);
    else if ("end" in line) this.finish(line.end);
  }

  private begin(header: Header) {
    if (header.lockstep_recording !== 1) {
      throw new Error(`this page reads recordings of version 1, not ${header.lockstep_recording}`);
    }
    if (header.resumed_after_s !== undefined) this.resume(header.resumed_after_s);
    if (this.header) return; // of a stream that goes on
    this.header = header;
    this.shape = shapeOf(header);
    this.nodes = header.nodes.map(() => new NodeColumn());
    if (header.nodes[0]?.kind === "Team") {
      header.nodes.forEach(({ parent }, node) => this.robotOf.push(parent ? this.robotOf[parent] : node));
      this.tickedBefore = this.robotOf.map(() => 0);
    }
    this.entries = (header.entries ?? []).map(() => []);
    this.counts = new Counts(header.nodes.length, this.entries.length);
  }

  // Not for a header that comes twice.
  private resume(after: number) {
    const line = this.lines;
    if (this.cuts.at(-1)?.line !== line) this.cuts.push({ line, after });
  }

  private take(line: TickLine) {
    if (this.lines > 0 && line.tick <= this.ticks[this.last]) return; // known already
    this.ticks.push(line.tick);
    this.times.push(line.time_s);
    this.events.lateness();
    const isWhole = line.full === true || line.whole !== undefined;
    this.joins = isWhole && this.lines === 1 && line.tick > 0;
    const before = line.moments ? this.nodes.map((column, node) => this.flagsBefore(node, lastFlags(column))) : null;
    if (isWhole) this.forgetOthers(line);
    for (const [node, status, progress, ticked, held] of line.nodes ?? []) {
      this.change(node, progress, flagsOf(status, ticked, held), before !== null);
    }
    if (before) this.takeMoments(line, before);
    this.events.holds(this.turned, (node) => lastFlags(this.nodes[node]), this.joins);
    this.turned = [];
    const known = (columns: Map<number, unknown>) => (isWhole ? columns.keys() : []);
    for (const [node, limit] of given(line.limits, known(this.limits), (node) => [node, 0])) {
      column(this.limits, node, () => new NumberColumn()).change(this.last, limit ?? Infinity);
    }
    for (const [node, number, of] of given(line.rounds, known(this.rounds), (node) => [node, 0, 0])) {
      const round = column(this.rounds, node, () => ({ number: new NumberColumn(), of: new NumberColumn() }));
      round.number.change(this.last, number);
      round.of.change(this.last, of);
    }
    if (line.succeeded) this.ended.set(this.last, line.succeeded);
    for (const [node, factor] of given(line.factors, known(this.factors), (node) => [node, 1])) {
      column(this.factors, node, () => new NumberColumn()).change(this.last, factor);
    }
    for (const [node, value] of given(line.reasons, known(this.reasons), (node) => [node, ""])) {
      const history = column(this.reasons, node, () => [] as EntryChange[]);
      if (history.at(-1)?.value !== value) history.push({ line: this.last, value });
    }
    for (const [node, run, word] of given(line.heard, known(this.heard), (node) => [node, 0, 0])) {
      column(this.heard, node, () => new HeardColumn()).push(this.last, this.times[this.last], run, word, 2.5 * this.period);
    }
    for (const [node, message] of line.faults ?? []) {
      this.events.fault(node, message);
      this.counts.fault(node);
    }
    for (const [entry, value] of line.whole ?? line.entries ?? []) this.changeEntry(entry, value);
    const missing = this.counts.correct(line);
    if (missing && !this.joins) this.events.missed(missing);
    this.takeLogs(line.logs);
    this.robotOf.forEach((robot, node) => {
      if (lastFlags(this.nodes[robot]) & TICKED) this.tickedBefore[node] = lastFlags(this.nodes[node]) & TICKED;
    });
    this.events.settle();
    this.thinner.events(this.events);
  }

  // A tick of one robot is not between two ticks of another one.
  private flagsBefore(node: number, flags: number): number {
    return this.robotOf.length === 0 ? flags : (flags & ~TICKED) | this.tickedBefore[node];
  }

  // A line with the whole state leaves out the nodes that are idle.
  private forgetOthers(line: TickLine) {
    const named = new Set((line.nodes ?? []).map((node) => node[0]));
    this.nodes.forEach((node, index) => {
      if (node.length > 0 && !named.has(index)) this.change(index, 0, 0, line.moments !== undefined);
    });
  }

  // In such a tick nodes had several results. Each moment says how nodes were that differ from the one after it.
  private takeMoments(line: TickLine, before: number[]) {
    const after = this.nodes.map(lastFlags), state = [...after], rows: { times: number; flags: number[] }[] = [];
    for (const [times, nodes] of [...(line.moments ?? [])].reverse()) {
      for (const [node, status, ticked, held] of nodes) state[node] = flagsOf(status, ticked, held);
      rows.unshift({ times, flags: [...state] });
    }
    if (this.joins && rows.length > 0) before = rows[0].flags;
    for (const { times, flags } of rows) {
      flags.forEach((now, node) => {
        this.counts.moment(node, before[node], now, times, line.tick);
        if (!this.joins) this.events.change(node, before[node], now, times);
      });
      this.events.holds(flags.keys(), (node) => flags[node], this.joins);
      this.events.settle();
      before = flags;
    }
    for (const [node, ...counts] of line.more ?? []) {
      this.counts.add(node, counts);
      if (!this.joins) this.events.more(node, counts);
    }
    this.counts.settle(after, line.tick);
  }

  // `isPart`: what happened is told by the moments of the tick.
  private change(node: number, progress: number, flags: number, isPart = false) {
    const changes = this.nodes[node];
    const before = changes.length === 0 ? 0 : changes.flags[changes.length - 1];
    if (changes.length > 0 && before === flags && changes.progress[changes.length - 1] === progress) return;
    const was = this.flagsBefore(node, before);
    changes.push(this.last, progress, flags, was);
    if (before !== flags && !isPart) this.counts.change(node, flags, this.ticks[this.last], this.joins);
    if ((before ^ flags) & HELD) this.turned.push(node);
    this.thinner.count(this.nodes);
    if (!this.joins && !isPart) this.events.change(node, was, flags);
  }

  private changeEntry(entry: number, value: string | null) {
    const history = this.entries[entry];
    const before = history[history.length - 1];
    if (before && before.value === value) return;
    history.push({ line: this.last, value });
    this.counts.entry(entry);
    if (!this.joins) this.events.entry(entry, value, (node) => (lastFlags(this.nodes[node]) & TICKED) !== 0);
  }

  private takeLogs(logs: LogLine[] | undefined) {
    for (const log of logs ?? []) this.events.log(log);
  }

  private lose(lost: { ticks: number; from: number }) {
    this.lost += lost.ticks;
    this.events.lost(lost.ticks, lost.from);
  }

  private finish(end: End) {
    if (this.end) return;
    this.end = end;
    this.takeLogs(end.logs);
    this.events.end(end);
  }

  // The counts of the whole run, also of ticks that this page has no line of.
  countsOf(node: number): CountsOfNode {
    return this.counts.ofNode(node, this.ticks[this.last] ?? 0);
  }
  // The status of a node in a line.
  status(node: number, line: number): number {
    const place = this.nodes[node].at(line);
    return place < 0 ? 0 : this.nodes[node].flags[place] & STATUS;
  }
}

// What a line gives of nodes. With the whole state, it leaves out the `known` ones that are as before the first tick.
function given<Change extends [number, ...unknown[]]>(changes: Change[] = [], known: Iterable<number>, none: (node: number) => Change): Change[] {
  const named = new Set(changes.map(([node]) => node));
  return [...changes, ...[...known].filter((node) => !named.has(node)).map(none)];
}

function flagsOf(status: string, ticked: number, held: number): number {
  return (STATUS_NUMBERS.get(status) ?? 0) | (ticked ? TICKED : 0) | (held ? HELD : 0);
}
function lastFlags(node: NodeColumn): number {
  return node.length === 0 ? 0 : node.flags[node.length - 1];
}

// The value at a line; null: there is none yet, or it is too long to be shown.
export function valueAt(history: EntryChange[] | undefined, line: number): string | null {
  let low = 0, high = history?.length ?? 0;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (history![middle].line <= line) low = middle + 1;
    else high = middle;
  }
  return low === 0 ? null : history![low - 1].value;
}

function column<T>(columns: Map<number, T>, node: number, make: () => T): T {
  let found = columns.get(node);
  if (!found) columns.set(node, (found = make()));
  return found;
}

function lastNotAbove(values: number[], value: number): number {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}
