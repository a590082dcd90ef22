// The states of a node over time, in spans of one state.
import { HELD, STATUS, TICKED, type NumberColumn } from "./columns";
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

// When the state of a place ended, in seconds: with the next one, or with the run.
function endOf(run: Run, states: NumberColumn, place: number): number {
  return place + 1 < states.length ? run.times[states.lines[place + 1]] : run.endTime;
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
  const now = line < run.last ? run.times[line] : run.endTime;
  const end = (at: number, result: number) => {
    if (current) found.push({ ...current, to: at, result });
    current = null;
  };
  for (let place = 0; place < states.length && states.lines[place] <= line; ++place) {
    const at = states.lines[place], state = stateNumber(states.values[place]);
    const status = states.values[place] & STATUS;
    if (status === 1) {
      current ??= { from: at, to: null, result: 1, held: 0 };
      if (state === HELD_STATE) current.held += Math.min(endOf(run, states, place), now) - run.times[at];
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

// In pre-order: leaves and children of synchronized nodes that were ever active, and a node that is selected; or all.
export function laneNodes(run: Run, all: boolean, selected: number | null): number[] {
  return run.shape.nodes
    .filter(({ index, children, keeper, isGroup }) => all || index === selected ||
      (run.nodes[index].states.length > 0 && !isGroup && (children.length === 0 || keeper !== null)))
    .map((node) => node.index);
}

// When a node was held between two times, in seconds.
export function heldSpans(run: Run, node: number, from: number, to: number): [number, number][] {
  const { states } = run.nodes[node];
  const spans: [number, number][] = [];
  for (let place = Math.max(0, states.placeAt(run.lineAtTime(from))); place < states.length; ++place) {
    const begin = run.times[states.lines[place]];
    if (begin > to) break;
    if (states.values[place] & HELD) spans.push([begin, endOf(run, states, place)]);
  }
  return spans;
}

export function sumOf(spans: [number, number][], from = -Infinity, to = Infinity): number {
  return spans.reduce((sum, [begin, end]) => sum + Math.max(0, Math.min(end, to) - Math.max(begin, from)), 0);
}

const known = new WeakMap<object, { length: number; times: [held: number, active: number] }>();

// How long a node was held, and how long it ran or was held, in seconds.
function activeTimes(run: Run, node: number): [held: number, active: number] {
  const { states } = run.nodes[node];
  const before = known.get(states);
  const goesOn = states.length > 0 && (states.values[states.length - 1] & STATUS) === RUNNING;
  if (before?.length === states.length && !goesOn) return before.times;
  const times: [number, number] = [0, 0];
  for (let place = 0; place < states.length; ++place) {
    if ((states.values[place] & STATUS) !== RUNNING) continue;
    const took = endOf(run, states, place) - run.times[states.lines[place]];
    if (states.values[place] & HELD) times[0] += took;
    times[1] += took;
  }
  known.set(states, { length: states.length, times });
  return times;
}

export const MANY_HOLDS = 8; // from which on their share of the time tells more than each of them

export function percent(part: number, whole: number): string {
  return `${Math.round(whole > 0 ? (100 * part) / whole : 0)} %`;
}

function heldText(run: Run, node: number, count: number): string {
  if (count === 0) return "";
  const [held, active] = activeTimes(run, node);
  if (count < MANY_HOLDS) return `held ${timesText(count)} for ${held.toFixed(2)} s`;
  return `held ${percent(held, active)} of ${active.toFixed(2)} s (${timesText(count)})`;
}

export function timesText(count: number): string {
  return count === 1 ? "once" : `${count} times`;
}

// "held 3 times for 0.51 s, succeeded once": in the whole run.
export function laneText(run: Run, node: number): string {
  const counts = run.countsOf(node);
  const parts = [
    heldText(run, node, counts.held),
    counts.succeeded > 0 ? `succeeded ${timesText(counts.succeeded)}` : "",
    counts.failed > 0 ? `failed ${timesText(counts.failed)}` : "",
    counts.skipped > 0 ? `skipped ${timesText(counts.skipped)}` : "",
  ];
  return parts.filter(Boolean).join(", ") || (run.nodes[node].states.length > 0 ? "ran" : "not reached");
}
