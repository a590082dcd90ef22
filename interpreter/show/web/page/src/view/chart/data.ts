// The numbers of the chart, as many as its columns can show.
import { STATUS } from "../../model/columns";
import { IDLE, RUNNING, SUCCESS } from "../../model/recording";
import type { Run } from "../../model/run";
import { spanOf, wholeSpan } from "../../store/span";
import type { Store } from "../../store/store";
import type { Numbers } from "./plot";

export const MOST_SERIES = 12;

// The span that the timeline shows. If that is the whole run, the activation of the node that is going on, else the last or
// the first.
export function chartSpan(store: Pick<Store, "run" | "looking" | "line">, keeper: number): [number, number] {
  const { run, looking } = store;
  if (looking.span) return looking.span;
  const { states } = run.nodes[keeper];
  const runs = (place: number) => (states.values[place] & STATUS) === RUNNING;
  let begin = Math.max(0, states.placeAt(store.line));
  while (begin > 0 && !runs(begin)) --begin;
  while (begin < states.length && !runs(begin)) ++begin;
  if (begin >= states.length) return wholeSpan(store);
  let end = begin;
  while (begin > 0 && runs(begin - 1)) --begin;
  while (end < states.length && runs(end)) ++end;
  const from = run.times[states.lines[begin]], to = run.times[end < states.length ? states.lines[end] : run.last];
  const margin = Math.max((to - from) * 0.03, run.period);
  return spanOf(run, Math.max(run.times[0], from - margin), to + margin);
}

// The lines to draw: all, or the first and last of each column.
export function linesIn(run: Run, from: number, to: number, most: number): number[] {
  const first = run.lineAtTime(from), last = Math.min(run.last, run.lineAtTime(to) + 1);
  const count = last - first + 1;
  const step = Math.max(1, count / most);
  const lines: number[] = [];
  for (let place = 0; place < count; place += step) lines.push(first + Math.floor(place));
  if (lines[lines.length - 1] !== last) lines.push(last);
  return lines;
}

// As it is after the tick of the line; null: it has none.
function progressAt(run: Run, node: number, line: number): number | null {
  const column = run.nodes[node], place = column.at(line);
  if (place < 0) return null;
  const status = column.flags[place] & STATUS;
  if (status === IDLE) return null;
  return status === SUCCESS ? 1 : column.progress[place];
}

export function chartData(run: Run, keeper: number, from: number, to: number, most: number): Numbers {
  const lines = linesIn(run, from, to, most);
  const children = run.shape.nodes[keeper].inStep.slice(0, MOST_SERIES);
  // While the node is idle, what it holds has no progress.
  const active = lines.map((line) => (run.shape.nodes[keeper].isGroup ? 1 : run.status(keeper, line)));
  return [
    lines.map((line) => run.times[line]),
    ...children.map((child) => lines.map((line, place) => (active[place] ? progressAt(run, child, line) : null))),
  ];
}
