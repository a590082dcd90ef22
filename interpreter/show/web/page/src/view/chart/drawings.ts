// The parts of the chart beside its lines: barriers or the delta band, when each child was held, the moment.
import type uPlot from "uplot";
import type { Run } from "../../model/run";
import type { Store } from "../../store/store";
import { SERIES, type Colors } from "../parts/colors";
import { chartData, heldSpans, MOST_SERIES } from "./data";

function barriers(plot: uPlot, run: Run, keeper: number, paint: Colors) {
  const { ctx, bbox } = plot;
  const { barriers: fixed } = run.shape.nodes[keeper];
  ctx.strokeStyle = paint.mark;
  ctx.setLineDash([3, 3]);
  ctx.lineWidth = devicePixelRatio;
  for (const mark of fixed.slice(0, 60)) {
    const y = plot.valToPos(mark, "y", true);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
  }
  ctx.setLineDash([]);
}

// From the least progress to the farthest that delta allows.
function band(plot: uPlot, run: Run, keeper: number, paint: Colors) {
  const { min, max } = plot.scales.x;
  if (min === undefined || max === undefined) return;
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

export function drawBehind(plot: uPlot, store: Store, keeper: number, paint: Colors) {
  const { run } = store;
  plot.ctx.save();
  if (run.shape.nodes[keeper].synchronization === "relative") band(plot, run, keeper, paint);
  else barriers(plot, run, keeper, paint);
  plot.ctx.restore();
}

// Below the axis, a row for each child.
function held(plot: uPlot, run: Run, keeper: number, paint: Colors) {
  const { ctx, bbox } = plot;
  const { min, max } = plot.scales.x;
  if (min === undefined || max === undefined) return;
  const ratio = devicePixelRatio, top = bbox.top + bbox.height + 28 * ratio;
  run.shape.nodes[keeper].inStep.slice(0, MOST_SERIES).forEach((child, row) => {
    ctx.fillStyle = paint[`series${row % SERIES}`];
    for (const [from, to] of heldSpans(run, child, min, max)) {
      const x = Math.max(bbox.left, plot.valToPos(from, "x", true));
      const end = Math.min(bbox.left + bbox.width, plot.valToPos(to, "x", true));
      if (end > x) ctx.fillRect(x, top + row * 6 * ratio, Math.max(1, end - x), 4 * ratio);
    }
  });
}

export function drawInFront(plot: uPlot, store: Store, keeper: number, paint: Colors) {
  const { ctx, bbox } = plot;
  ctx.save();
  held(plot, store.run, keeper, paint);
  const x = plot.valToPos(store.moment.time, "x", true);
  if (x >= bbox.left && x <= bbox.left + bbox.width) {
    // Everything after the moment is pale.
    ctx.globalAlpha = 0.6;
    ctx.fillStyle = paint.panel;
    ctx.fillRect(x, bbox.top, bbox.left + bbox.width - x, bbox.height);
    ctx.globalAlpha = 1;
    ctx.fillStyle = paint.text;
    ctx.fillRect(x, bbox.top, devicePixelRatio, bbox.height);
  }
  ctx.restore();
}
