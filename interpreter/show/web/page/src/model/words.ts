// Symbols and words for statuses and kinds: the same as in the terminal.
import type { Moment } from "./moment";
import { STATUSES } from "./recording";
import { owned, ownersText, paceText, waitOf } from "./waiting";

const SYMBOLS = ["·", "▶", "✓", "✗", "»"];
const HELD_SYMBOL = "‖";

export function symbolOf(moment: Moment, node: number): string {
  return moment.held[node] ? HELD_SYMBOL : SYMBOLS[moment.status[node]];
}
// "held" is a state of its own for people who look.
export function stateOf(moment: Moment, node: number): string {
  return moment.held[node] ? "held" : STATUSES[moment.status[node]];
}

export function cutText(after: number): string {
  return `the process was cut here, and the run continued after ${after.toFixed(after < 3 ? 1 : 0)} s`;
}

const SIGNS: Record<string, string> = {
  Sequence: "→", Fallback: "?", Parallel: "⇉", ParallelAbsolute: "⇉A", ParallelRelative: "⇉R", barrier: "‖",
};

export function kindText(kind: string, segment: string): string {
  const sign = SIGNS[kind];
  if (!sign) return kind === segment ? "" : kind;
  return `${sign} ${kind}`;
}

export function sentenceOf(moment: Moment, node: number): string {
  const wait = waitOf(moment, node);
  if (wait) return wait.text;
  const it = moment.run.shape.nodes[node], { keeper } = it;
  if (it.synchronization === "resources") return ownersText(moment, it);
  if (keeper === null) return "";
  const pool = moment.run.shape.nodes[keeper];
  return pool.synchronization === "resources" ? owned(moment, pool, node) : "";
}

export function labelOf(moment: Moment, node: number): string {
  const { segment, kind } = moment.run.shape.nodes[node];
  const parts = [segment];
  if (kind !== segment) parts.push(kind);
  parts.push(stateOf(moment, node), `progress ${moment.progress[node].toFixed(2)}`);
  const pace = paceText(moment, node);
  if (pace) parts.push(pace);
  const round = moment.round(node);
  if (round) parts.push(`round ${round}`);
  const sentence = sentenceOf(moment, node);
  if (sentence) parts.push(sentence);
  return parts.join(", ");
}

// A run that has ended before its first tick has no times.
export function seconds(time = 0): string {
  return `${time.toFixed(3)} s`;
}
