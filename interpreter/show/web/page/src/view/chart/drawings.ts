// The parts of the charts beside their lines: barriers or the delta band, a bound, when each child was held.
import type uPlot from "uplot";
import { heldSpans } from "../../model/lanes";
import type { Run } from "../../model/run";
import { SERIES, type Colors } from "../parts/colors";
import { chartData, MOST_SERIES } from "./data";

export function drawLine(plot: uPlot, value: number, paint: Colors) {
  const { ctx, bbox } = plot, y = plot.valToPos(value, "y", true);
  ctx.strokeStyle = paint.mark;
  ctx.setLineDash([3, 3]);
  ctx.lineWidth = devicePixelRatio;
  ctx.beginPath();
  ctx.moveTo(bbox.left, y);
  ctx.lineTo(bbox.left + bbox.width, y);
  ctx.stroke();
  ctx.setLineDash([]);
}

// From the least progress to the farthest that delta allows.
function band(plot: uPlot, run: Run, keeper: number, paint: Colors) {
  const { min, max } = plot.scales.x;
  if (min == null || max == null) return;
  const [times, ...series] = chartData(run, keeper, min, max, 300);
  const limits = run.limits.get(keeper);
  const { ctx } = plot;
  ctx.fillStyle = paint.mark;
  ctx.globalAlpha = 0.18;
  for (let place = 0; place + 1 < times.length; ++place) {
    const values = series.map((one) => one[place]).filter((one) => one !== null) as number[];
    if (values.length === 0) continue;
    const least = Math.min(...values);
    const most = Math.min(1, least + (limits?.at(run.lineAtTime(times[place]!)) ?? 0));
    const x = plot.valToPos(times[place]!, "x", true), next = plot.valToPos(times[place + 1]!, "x", true);
    const y = plot.valToPos(most, "y", true);
    ctx.fillRect(x, y, next - x + 0.5, plot.valToPos(least, "y", true) - y);
  }
  ctx.globalAlpha = 1;
}

export function drawBehind(plot: uPlot, run: Run, keeper: number, paint: Colors) {
  if (run.shape.nodes[keeper].synchronization === "relative") band(plot, run, keeper, paint);
  else run.shape.nodes[keeper].barriers.slice(0, 60).forEach((mark) => drawLine(plot, mark, paint));
}

// When each child was held: below the axis, a row for each. Holds that are shorter than a pixel make it as dark as their
// share of the time.
export function drawHeld(plot: uPlot, run: Run, keeper: number, paint: Colors) {
  const { ctx, bbox } = plot;
  const { min, max } = plot.scales.x;
  if (min == null || max == null) return;
  const ratio = devicePixelRatio, top = bbox.top + bbox.height + 28 * ratio;
  run.shape.nodes[keeper].inStep.slice(0, MOST_SERIES).forEach((child, row) => {
    ctx.fillStyle = paint[`series${row % SERIES}`];
    let last = -Infinity;
    for (const [from, to] of heldSpans(run, child, min, max)) {
      const x = Math.max(bbox.left, plot.valToPos(from, "x", true));
      const end = Math.min(bbox.left + bbox.width, plot.valToPos(to, "x", true));
      if (end > x) ctx.fillRect(x, top + row * 6 * ratio, x - last < 2 ? end - x : Math.max(1, end - x), 4 * ratio);
      last = end;
    }
  });
}
