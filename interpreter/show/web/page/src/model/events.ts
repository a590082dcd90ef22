// The events of a run, in order: for the log, and for going from one event to the next.
import { completesNewly, HELD, STATUS, TICKED } from "./columns";
import { shortNumbers } from "./numbers";
import { IDLE, RUNNING, SUCCESS, type End, type Header, type LogLine } from "./recording";
import type { Shape } from "./shape";

export type EventKind =
  | "start" | "success" | "failure" | "skipped" | "halt" | "hold" | "release"
  | "fault" | "entry" | "log" | "overrun" | "lost" | "end";

// The same thing again and again: a leaf that writes an entry in each tick, or many short holds by one node.
export interface Series {
  from: number; // line
  count: number;
  open: boolean; // its events are shown one by one
}

export interface RunEvent {
  line: number;
  kind: EventKind;
  node: number | null;
  text: string; // without the node
  level?: string; // of a log
  explained?: boolean; // of a hold: the text says why
  series: Series | null;
  number: number; // of the event in its series, from 1
  cause: number; // orders the events of a tick
}

// The chips, which choose what the log shows and where the keys for the next and the previous event stop.
export const CHIPS: Record<string, EventKind[]> = {
  completions: ["start", "success", "failure", "skipped", "halt"],
  waiting: ["hold", "release"],
  troubles: ["fault", "overrun", "lost", "end"],
  entries: ["entry"],
  logs: ["log"],
};

const CHIP_OF = Object.fromEntries(Object.entries(CHIPS).flatMap(([chip, kinds]) => kinds.map((kind) => [kind, chip])));

export interface Filter {
  hidden: ReadonlySet<string>; // chips
  only: number | null; // node
}

export function isShown({ hidden, only }: Filter, { kind, node }: RunEvent): boolean {
  return (only === null || node === only) && !hidden.has(CHIP_OF[kind]);
}

// A series is folded when it has so many events, each at most so many lines after the one before it. A hold is two events.
const FOLDED = 4, GAP = 2, FOLDED_HOLDS = 16, GAP_OF_HOLDS = 25;

function isHold(kind: EventKind): boolean {
  return kind === "hold" || kind === "release";
}

export function isFolded({ kind, series }: RunEvent): boolean {
  return series !== null && !series.open && series.count >= (isHold(kind) ? FOLDED_HOLDS : FOLDED);
}

// Of a series that is folded, its first event; none of an entry that changes in every tick.
function isStop(filter: Filter, event: RunEvent): boolean {
  const { kind, series, number } = event;
  if (!isShown(filter, event)) return false;
  if (kind === "entry" && series!.count >= FOLDED) return false;
  return !isFolded(event) || number === 1;
}

// Of each status from Success on.
const RESULTS: readonly [EventKind, string][] = [["success", "succeeded"], ["failure", "failed"], ["skipped", "skipped"]];

// The run of the events, at the moment in which they happen.
interface Happening {
  readonly header: Header | null;
  readonly shape: Shape;
  readonly ticks: number[]; // of each line
  readonly times: number[];
  readonly last: number; // line
  readonly period: number;
  status(node: number, line: number): number;
}

const FIRST = -Infinity, LAST = Infinity;

export class Events {
  all: RunEvent[] = [];
  private fresh: RunEvent[] = []; // of the current tick
  private readonly held = new Set<number>(); // that have a hold, and no release yet
  private readonly latest = new Map<string, { line: number; series: Series }>();

  constructor(private readonly run: Happening) {}

  private add(kind: EventKind, node: number | null, text: string, cause = this.causeOf(node), what: string | number | null = node) {
    const line = Math.max(0, this.run.last), series = what === null ? null : this.seriesOf(kind, what, line);
    this.fresh.push({ line, kind, node, text, series, number: series ? ++series.count : 1, cause });
  }
  private seriesOf(kind: EventKind, what: string | number, line: number): Series {
    const holds = isHold(kind), key = holds ? `hold ${this.run.shape.nodes[what as number].keeper}` : `${kind} ${what}`;
    const before = this.latest.get(key);
    const series = before && line - before.line <= (holds ? GAP_OF_HOLDS : GAP) ? before.series : { from: line, count: 0, open: false };
    this.latest.set(key, { line, series });
    return series;
  }

  // A node has its result after those below it.
  private causeOf(node: number | null): number {
    if (node === null) return FIRST;
    const { nodes } = this.run.shape;
    return nodes[node].end * (nodes.length + 1) - node;
  }
  // A node is halted by what has ended above it.
  private causeOfHalt(node: number): number {
    const { nodes } = this.run.shape;
    for (let up = nodes[node].parent; up !== null; up = nodes[up].parent) {
      if (this.run.status(up, this.run.last) > RUNNING) return this.causeOf(up) + 0.5;
    }
    return this.causeOf(node);
  }
  // After all of a tick, or of one of its moments.
  settle() {
    for (const event of this.fresh) {
      if (event.kind === "halt") event.cause = this.causeOfHalt(event.node!);
    }
    this.all.push(...this.fresh.sort((a, b) => a.cause - b.cause || 0)); // of two infinite ones: as they came
    this.fresh = [];
  }

  // `times`: of a moment of a tick that has several, in which each result is an event.
  change(node: number, before: number, after: number, times = 0) {
    const was = before & STATUS, is = after & STATUS;
    if (times > 0 && after & TICKED && is > RUNNING) this.result(node, is, times);
    else if (is !== was || completesNewly(before, after)) this.statusChange(node, was, is);
  }

  // Of all nodes, or of those that have come to be held or ceased to be; after the changes of a tick or a moment. What is below
  // a held node is held with it. `joins`: since when is not known.
  holds(nodes: Iterable<number>, flagsOf: (node: number) => number, joins: boolean) {
    const { shape } = this.run;
    const see = (node: number) => {
      const { parent, isGroup } = shape.nodes[node], flags = flagsOf(node);
      if (!(flags & HELD)) {
        const was = this.held.delete(node);
        if (was && (flags & STATUS) !== IDLE) this.add("release", node, "resumes", FIRST);
      } else if (!isGroup && !this.held.has(node) && !(parent !== null && flagsOf(parent) & HELD)) {
        this.held.add(node);
        if (!joins) this.add("hold", node, "is held", FIRST);
      }
    };
    for (const node of nodes) [node, ...shape.nodes[node].children].forEach(see);
  }

  private result(node: number, status: number, times: number) {
    if (this.run.shape.nodes[node].isGroup) return;
    const [kind, text] = RESULTS[status - SUCCESS];
    this.add(kind, node, times > 1 ? `${text} ${times} times` : text);
  }
  // What a tick with very many moments only counts.
  more(node: number, counts: number[]) {
    RESULTS.forEach((_, place) => {
      if (counts[place] > 0) this.result(node, SUCCESS + place, counts[place]);
    });
  }

  private statusChange(node: number, was: number, is: number) {
    const { children, isGroup } = this.run.shape.nodes[node];
    if (isGroup) return; // it runs as long as it has members
    const isLeaf = children.length === 0;
    if (is > RUNNING) this.result(node, is, 1);
    else if (is === RUNNING && isLeaf) this.add("start", node, "started");
    else if (is === IDLE && was === RUNNING && isLeaf) this.add("halt", node, "halted");
  }

  fault(node: number, message: string) {
    this.add("fault", node, message, this.causeOf(node) - 0.2);
  }
  // After the first of the nodes that may have written it and had a tick.
  entry(entry: number, value: string | null, isTicked: (node: number) => boolean) {
    const { key, writers } = this.run.header!.entries![entry];
    const text = value === null ? "(too long to be recorded)" : shortNumbers(value);
    const writer = writers?.find(isTicked);
    this.add("entry", null, `${key} = ${text}`, writer === undefined ? FIRST : this.causeOf(writer) - 0.3, `entry ${entry}`);
  }
  log([who, level, text]: LogLine) {
    const node = this.run.shape.byPath.get(who);
    this.add("log", null, `${who}: ${text}`, node === undefined ? LAST : this.causeOf(node) - 0.4);
    this.fresh[this.fresh.length - 1].level = level;
  }
  lost(ticks: number, from: number) {
    this.add("lost", null, `${ticks} ticks from tick ${from} on are not in the recording`);
    this.settle();
  }
  missed(what: string) {
    this.add("lost", null, `this page was too slow to be told of each: ${what}`);
  }
  end(end: End) {
    const fault = end.fault ? `: ${end.fault}` : "";
    const ticks = end.ticks === 1 ? "1 tick" : `${end.ticks} ticks`;
    this.add("end", null, `run ended: ${end.result} (${end.reason}) after ${ticks}${fault}`, LAST);
    for (const note of end.notes ?? []) this.add("end", null, note, LAST);
    this.settle();
  }

  // On the wall clock a tick begins later than the rate says if the one before it took too long.
  lateness() {
    const { header, last, ticks, times, period } = this.run;
    if (header?.clock !== "wall" || last < 1 || ticks[last] !== ticks[last - 1] + 1) return;
    const took = times[last] - times[last - 1];
    if (took < 1.5 * period) return;
    this.add("overrun", null, `tick ${ticks[last - 1]} overran: the next began ${ms(took)} after it, not ${ms(period)}`, FIRST, "tick");
  }

  // The place of the first event after `line`.
  placeAfter(line: number): number {
    let low = 0, high = this.all.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.all[middle].line <= line) low = middle + 1;
      else high = middle;
    }
    return low;
  }
  nextLine(line: number, filter: Filter): number | null {
    for (let place = this.placeAfter(line); place < this.all.length; ++place) {
      if (isStop(filter, this.all[place])) return this.all[place].line;
    }
    return null;
  }
  previousLine(line: number, filter: Filter): number | null {
    for (let place = this.placeAfter(line - 1); place-- > 0; ) {
      if (isStop(filter, this.all[place])) return this.all[place].line;
    }
    return null;
  }
}

function ms(seconds: number): string {
  return `${(seconds * 1000).toFixed(seconds < 0.01 ? 2 : 1)} ms`;
}
