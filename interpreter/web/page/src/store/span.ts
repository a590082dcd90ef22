// The part of the run that the timeline and the chart show.
import type { Run } from "../model/run";

// What is shown at: the store.
interface Shown {
  readonly run: Run;
  readonly looking: { readonly span: [number, number] | null };
}

function wholeSpan(shown: Shown): [number, number] {
  const { run } = shown;
  const first = run.times[0] ?? 0, last = run.times[run.last] ?? 0;
  return [first, Math.max(last, first + Math.max(run.period, 1e-3))];
}

export function spanShown(shown: Shown): [number, number] {
  return shown.looking.span ?? wholeSpan(shown);
}

// Around a time; `by` moves it by a part of its width. null: all of it.
export function zoomed(shown: Shown, factor: number, around: number, by = 0): [number, number] | null {
  const [first, last] = wholeSpan(shown);
  const [from, to] = spanShown(shown);
  const least = Math.max(shown.run.period * 5, 1e-3);
  const width = Math.max(least, (to - from) * factor);
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
