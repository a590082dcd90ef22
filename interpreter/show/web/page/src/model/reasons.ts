// Why a node has its status, in words: what a leaf says, or what a condition has read. As judge/summary/why.h has it.
import type { Moment } from "./moment";
import { IDLE, SUCCESS } from "./recording";
import { valueAt } from "./run";

// "" if nobody says.
export function reasonOf(moment: Moment, node: number): string {
  const { run, line } = moment;
  const own = valueAt(run.reasons.get(node), line);
  if (own) return own;
  const { condition, reads } = run.header?.nodes[node] ?? {};
  if (!condition || moment.status[node] === IDLE) return "";
  const keys = (run.header?.entries ?? []).map((entry) => entry.key);
  const values = (reads ?? []).filter((key) => keys.includes(key))
    .map((key) => [key, valueAt(run.entries[keys.indexOf(key)], line)])
    .map(([key, value]) => (value === null ? `${key} has no value` : `${key} is ${value}`));
  const is = moment.status[node] === SUCCESS ? "is true" : "is false";
  return `${condition} ${is}${values.length > 0 ? `: ${values.join("; ")}` : ""}`;
}
