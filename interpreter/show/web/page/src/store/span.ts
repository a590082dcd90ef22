// The part of the run that the timeline and the chart show.
import type { Run } from "../model/run";

// What is shown at: the store.
interface Shown {
  readonly run: Run;
  readonly looking: { readonly span: [number, number] | null };
}

// The least width of a span: charts and rulers divide by it, and count marks up to its end.
function leastWidth(run: Run, from: number): number {
  return Math.max(run.period, 1e-3, Math.abs(from) * 1e-9);
}

// A span of at least a period.
export function spanOf(run: Run, from: number, to: number): [number, number] {
  return [from, Math.max(to, from + leastWidth(run, from))];
}

export function wholeSpan({ run }: { readonly run: Run }): [number, number] {
  return spanOf(run, run.times[0] ?? 0, run.times[run.last] ?? 0);
}

export function spanShown(shown: Shown): [number, number] {
  return shown.looking.span ?? wholeSpan(shown);
}

// Around a time; `by` moves it by a part of its width. null: all of it.
export function zoomed(shown: Shown, factor: number, around: number, by = 0): [number, number] | null {
  const [first, last] = wholeSpan(shown);
  const [from, to] = spanShown(shown);
  const width = Math.max(5 * leastWidth(shown.run, first), (to - from) * factor);
  if (width >= last - first) return null;
  const part = (around - from) / (to - from);
  const begin = around - part * width + by * width;
  const clamped = Math.max(first, Math.min(begin, last - width));
  return [clamped, clamped + width];
}

// Shifted so that the moment is in it.
export function withMoment(shown: Shown, time: number): [number, number] | null {
  const { span } = shown.looking;
  if (!span || (time >= span[0] && time <= span[1])) return span;
  return zoomed(shown, 1, time, (time - (span[0] + span[1]) / 2) / (span[1] - span[0]));
}
