// The events of a run, in order: for the log, and for going from one event to the next.
import { HELD, STATUS } from "./columns";
import { FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, type End, type LogLine } from "./recording";
import type { Run } from "./run";

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
}

// Those that the keys for the next and the previous event stop at.
const LANDMARKS: ReadonlySet<EventKind> = new Set<EventKind>([
  "success", "failure", "hold", "release", "fault", "entry", "overrun", "lost", "end",
]);

export class Events {
  all: RunEvent[] = [];

  private add(run: Run, kind: EventKind, node: number | null, text: string, level?: string) {
    this.all.push({ line: Math.max(0, run.last), kind, node, text, level });
  }

  change(run: Run, node: number, before: number, after: number) {
    const was = before & STATUS, is = after & STATUS;
    if (is !== was) this.statusChange(run, node, was, is);
    if ((before & HELD) === (after & HELD)) return;
    if (run.shape.nodes[node].keeper === null) return; // what is below a held node
    if (after & HELD) this.add(run, "hold", node, "is held");
    else if (is === RUNNING) this.add(run, "release", node, "goes on");
  }

  private statusChange(run: Run, node: number, was: number, is: number) {
    const { children, isGroup } = run.shape.nodes[node];
    if (isGroup) return; // it runs as long as it has members
    const isLeaf = children.length === 0;
    if (is === SUCCESS) this.add(run, "success", node, "succeeded");
    else if (is === FAILURE) this.add(run, "failure", node, "failed");
    else if (is === SKIPPED) this.add(run, "skipped", node, "skipped");
    else if (is === RUNNING && isLeaf) this.add(run, "start", node, "started");
    else if (is === IDLE && was === RUNNING && isLeaf) this.add(run, "halt", node, "halted");
  }

  fault(run: Run, node: number, message: string) {
    this.add(run, "fault", node, message);
  }
  entry(run: Run, entry: number, value: string | null) {
    const key = run.header?.entries?.[entry]?.key ?? "?";
    this.add(run, "entry", null, `${key} = ${value ?? "(too long to be recorded)"}`);
  }
  log(run: Run, [who, level, text]: LogLine) {
    this.add(run, "log", null, `${who}: ${text}`, level);
  }
  lost(run: Run, ticks: number, from: number) {
    this.add(run, "lost", null, `${ticks} ticks from tick ${from} on are not here: there was no room for them`);
  }
  missed(run: Run, what: string) {
    this.add(run, "lost", null, `this page was too slow to be told of each: ${what}`);
  }
  end(run: Run, end: End) {
    const fault = end.fault ? `: ${end.fault}` : "";
    this.add(run, "end", null, `run ended: ${end.result} (${end.reason}) after ${end.ticks} ticks${fault}`);
    for (const note of end.notes ?? []) this.add(run, "end", null, note);
  }

  // On the wall clock a tick begins later than the rate says if the one before it took too long.
  lateness(run: Run) {
    const line = run.last;
    if (run.header?.clock !== "wall" || line < 1 || run.ticks[line] !== run.ticks[line - 1] + 1) return;
    const took = run.times[line] - run.times[line - 1];
    if (took < 1.5 * run.period) return;
    this.add(run, "overrun", null,
      `tick ${run.ticks[line - 1]} overran: the next began ${ms(took)} after it, not ${ms(run.period)}`);
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
      if (LANDMARKS.has(this.all[place].kind)) return this.all[place].line;
    }
    return null;
  }
  previousLine(line: number): number | null {
    for (let place = this.placeAfter(line - 1); place-- > 0; ) {
      if (LANDMARKS.has(this.all[place].kind)) return this.all[place].line;
    }
    return null;
  }
}

function ms(seconds: number): string {
  return `${(seconds * 1000).toFixed(seconds < 0.01 ? 2 : 1)} ms`;
}
