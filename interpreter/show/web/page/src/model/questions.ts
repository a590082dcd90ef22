// What a run asks people at a moment. The text of a question is the reason of the node while it is running. One that was
// held at a cut has none until it asks again.
import type { Moment } from "./moment";
import { RUNNING } from "./recording";
import { valueAt } from "./run";

export interface Question {
  node: number;
  text: string;
  options: string[];
  severity: string; // info, warning or critical
  left: number | null; // seconds until its time is over
  fallback: string; // the answer then; "": it fails
}

export function questionsOf(moment: Moment): Question[] {
  const { run, line } = moment;
  return (run.header?.nodes ?? []).flatMap(({ index, options, severity, timeout_s, default: fallback }) => {
    if (!options || moment.status[index] !== RUNNING) return [];
    const text = valueAt(run.reasons.get(index), line);
    if (!text) return [];
    const states = run.nodes[index].states, place = states.placeAt(line);
    const since = place < 0 ? moment.time : run.times[states.lines[place]];
    const left = timeout_s === undefined ? null : Math.max(0, timeout_s - (moment.time - since));
    return [{ node: index, text, options, severity: severity ?? "info", left, fallback: fallback ?? "" }];
  });
}
