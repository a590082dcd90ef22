// The states of a node over time, in spans of one state.
import { HELD, STATUS, TICKED } from "./columns";
import { RUNNING } from "./recording";
import type { Run } from "./run";

export interface LaneSpan {
  state: number; // a status, or HELD_STATE
  from: number; // line
  to: number; // line of the next state; the last of the run
  again: boolean; // it completes in each tick
}

export const HELD_STATE = 5;

function stateNumber(flags: number): number {
  return flags & HELD ? HELD_STATE : flags & STATUS;
}

// Is reached by more than the first tick from one line on?
function isAgain(run: Run, node: number, from: number, to: number): boolean {
  const column = run.nodes[node], place = column.at(from);
  if (!(column.flags[place] & TICKED) || (column.flags[place] & STATUS) <= RUNNING) return false;
  const end = place + 1 < column.length ? Math.min(to, column.lines[place + 1]) : to;
  return run.ticks[end] > run.ticks[from] + 1;
}

// Those that touch the lines `from` to `to`, without idle ones.
export function laneSpans(run: Run, node: number, from: number, to: number): LaneSpan[] {
  const { states } = run.nodes[node];
  const spans: LaneSpan[] = [];
  for (let place = Math.max(0, states.placeAt(from)); place < states.length; ++place) {
    if (states.lines[place] > to) break;
    const state = stateNumber(states.values[place]);
    const end = place + 1 < states.length ? states.lines[place + 1] : run.last;
    if (state !== 0) spans.push({ state, from: states.lines[place], to: end, again: isAgain(run, node, states.lines[place], end) });
  }
  return spans;
}

interface Activation {
  from: number; // lines
  to: number | null; // where it ended
  result: number; // status; RUNNING when it has not ended, IDLE when it was halted
  held: number; // seconds
}

// The last of those that began by `line`, newest first.
export function activations(run: Run, node: number, line: number, most: number): Activation[] {
  const { states } = run.nodes[node];
  const found: Activation[] = [];
  let current: Activation | null = null;
  const end = (at: number, result: number) => {
    if (current) found.push({ ...current, to: at, result });
    current = null;
  };
  for (let place = 0; place < states.length && states.lines[place] <= line; ++place) {
    const at = states.lines[place], state = stateNumber(states.values[place]);
    const status = states.values[place] & STATUS;
    if (status === 1) {
      current ??= { from: at, to: null, result: 1, held: 0 };
      const next = place + 1 < states.length ? states.lines[place + 1] : run.last;
      if (state === HELD_STATE) current.held += run.times[Math.min(next, line)] - run.times[at];
    } else if (status === 0) {
      end(at, 0);
    } else {
      current ??= { from: at, to: null, result: 1, held: 0 };
      end(at, status);
    }
  }
  if (current) found.push(current);
  return found.slice(-most).reverse();
}

// Nodes that were ever active, in pre-order.
export function laneNodes(run: Run, all: boolean): number[] {
  return run.shape.nodes
    .filter(({ index, children, keeper, isGroup }) => {
      if (run.nodes[index].states.length === 0) return false;
      return all || (!isGroup && (children.length === 0 || keeper !== null));
    })
    .map((node) => node.index);
}

const heldTimes = new WeakMap<object, { length: number; held: number }>();

// Seconds, in spans that have ended or go on.
function heldFor(run: Run, node: number): number {
  const { states } = run.nodes[node];
  const known = heldTimes.get(states);
  const goesOn = states.length > 0 && stateNumber(states.values[states.length - 1]) === HELD_STATE;
  if (known?.length === states.length && !goesOn) return known.held;
  let held = 0;
  for (const { state, from, to } of laneSpans(run, node, 0, run.last)) {
    if (state === HELD_STATE) held += run.times[to] - run.times[from];
  }
  heldTimes.set(states, { length: states.length, held });
  return held;
}

// "held 3 times for 0.51 s, succeeded once": in the whole run.
export function laneText(run: Run, node: number): string {
  const counts = run.countsOf(node);
  const times = (count: number) => (count === 1 ? "once" : `${count} times`);
  const parts = [
    counts.held > 0 ? `held ${times(counts.held)} for ${heldFor(run, node).toFixed(2)} s` : "",
    counts.succeeded > 0 ? `succeeded ${times(counts.succeeded)}` : "",
    counts.failed > 0 ? `failed ${times(counts.failed)}` : "",
    counts.skipped > 0 ? `skipped ${times(counts.skipped)}` : "",
  ];
  return parts.filter(Boolean).join(", ") || "ran";
}
