// The events of a run, in order: for the log, and for going from one event to the next.
import { HELD, STATUS, TICKED } from "./columns";
import { IDLE, RUNNING, SUCCESS, type End, type Header, type LogLine } from "./recording";
import type { Shape } from "./shape";

export type EventKind =
  | "start" | "success" | "failure" | "skipped" | "halt" | "hold" | "release"
  | "fault" | "entry" | "log" | "overrun" | "lost" | "end";

export interface RunEvent {
  line: number;
  kind: EventKind;
  node: number | null;
  text: string; // without the node
  level?: string; // of a log
  explained?: boolean; // of a hold: the text says why
  again?: boolean; // the same happened at most two lines before, as where a leaf writes an entry in each tick
}

// Those that the keys for the next and the previous event stop at, at the first line of a row of them.
const LANDMARKS: ReadonlySet<EventKind> = new Set<EventKind>([
  "success", "failure", "hold", "release", "fault", "entry", "overrun", "lost", "end",
]);

function isLandmark({ kind, again }: RunEvent): boolean {
  return LANDMARKS.has(kind) && !again;
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
}

export class Events {
  all: RunEvent[] = [];
  private readonly latest = new Map<string, number>(); // the last line of each kind of event of a node or an entry

  constructor(private readonly run: Happening) {}

  private add(kind: EventKind, node: number | null, text: string, level?: string, what: number | null = node) {
    const line = Math.max(0, this.run.last), key = `${kind} ${what}`, before = this.latest.get(key);
    this.latest.set(key, line);
    this.all.push({ line, kind, node, text, level, again: before !== undefined && line - before <= 2 });
  }

  // `times`: of a moment of a tick that has several, in which each result is an event.
  change(node: number, before: number, after: number, times = 0) {
    const was = before & STATUS, is = after & STATUS;
    if (times > 0 && after & TICKED && is > RUNNING) this.result(node, is, times);
    else if (is !== was) this.statusChange(node, was, is);
    if ((before & HELD) === (after & HELD)) return;
    if (this.run.shape.nodes[node].keeper === null) return; // what is below a held node
    if (after & HELD) this.add("hold", node, "is held");
    else if (is === RUNNING) this.add("release", node, "goes on");
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
    this.add("fault", node, message);
  }
  entry(entry: number, value: string | null) {
    const key = this.run.header?.entries?.[entry]?.key ?? "?";
    this.add("entry", null, `${key} = ${value ?? "(too long to be recorded)"}`, undefined, entry);
  }
  log([who, level, text]: LogLine) {
    this.add("log", null, `${who}: ${text}`, level);
  }
  lost(ticks: number, from: number) {
    this.add("lost", null, `${ticks} ticks from tick ${from} on are not here: there was no room for them`);
  }
  missed(what: string) {
    this.add("lost", null, `this page was too slow to be told of each: ${what}`);
  }
  end(end: End) {
    const fault = end.fault ? `: ${end.fault}` : "";
    this.add("end", null, `run ended: ${end.result} (${end.reason}) after ${end.ticks} ticks${fault}`);
    for (const note of end.notes ?? []) this.add("end", null, note);
  }

  // On the wall clock a tick begins later than the rate says if the one before it took too long.
  lateness() {
    const { header, last, ticks, times, period } = this.run;
    if (header?.clock !== "wall" || last < 1 || ticks[last] !== ticks[last - 1] + 1) return;
    const took = times[last] - times[last - 1];
    if (took < 1.5 * period) return;
    this.add("overrun", null, `tick ${ticks[last - 1]} overran: the next began ${ms(took)} after it, not ${ms(period)}`);
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
  nextLine(line: number): number | null {
    for (let place = this.placeAfter(line); place < this.all.length; ++place) {
      if (isLandmark(this.all[place])) return this.all[place].line;
    }
    return null;
  }
  previousLine(line: number): number | null {
    for (let place = this.placeAfter(line - 1); place-- > 0; ) {
      if (isLandmark(this.all[place])) return this.all[place].line;
    }
    return null;
  }
}

function ms(seconds: number): string {
  return `${(seconds * 1000).toFixed(seconds < 0.01 ? 2 : 1)} ms`;
}
