// Draws lanes on a canvas: a full bar while the node runs, a hatched one while it is held, a thin line and a
// sign from its completion on, a thicker one while it completes in each tick. Many short holds are a share of the time.
import { HELD_STATE, laneSpans, type LaneSpan } from "../../model/lanes";
import { FAILURE, RUNNING, SUCCESS } from "../../model/recording";
import type { Run } from "../../model/run";
import type { Colors } from "../parts/colors";

export const LANE = 18; // pixels
export const RULER = 20;
export const END = 18; // pixels behind the last tick, for the signs of its results

export interface Window {
  from: number; // seconds
  to: number;
  width: number; // pixels
}

export function xOf(time: number, window: Window): number {
  return ((time - window.from) / (window.to - window.from)) * window.width;
}
export function timeOf(x: number, window: Window): number {
  return window.from + (x / window.width) * (window.to - window.from);
}

function hatch(context: CanvasRenderingContext2D, color: string, background: string): CanvasPattern | string {
  const tile = document.createElement("canvas");
  tile.width = tile.height = 6;
  const paint = tile.getContext("2d");
  if (!paint) return color;
  paint.fillStyle = background;
  paint.fillRect(0, 0, 6, 6);
  paint.strokeStyle = color;
  paint.lineWidth = 2;
  for (const shift of [-6, 0, 6]) {
    paint.beginPath();
    paint.moveTo(shift - 1, 7);
    paint.lineTo(shift + 7, -1);
    paint.stroke();
  }
  return context.createPattern(tile, "repeat") ?? color;
}

const SIGNS = ["", "", "✓", "✗", "»"], SIGN = 14; // pixels

interface Pen {
  context: CanvasRenderingContext2D;
  colors: Colors;
  held: CanvasPattern | string;
}

// Also of the share of the time that a node was held, from below.
function fillHeld({ context, colors, held }: Pen, x: number, width: number, y: number, share = 1) {
  const height = Math.max(2, share * (LANE - 6)), top = y + LANE - 3 - height;
  context.fillStyle = held;
  context.fillRect(x, top, width, height);
  context.fillStyle = colors.held;
  context.fillRect(x, top - 1, width, 1.5);
  if (share === 1) context.fillRect(x, y + LANE - 3.5, width, 1.5);
}

function fillRunning({ context, colors }: Pen, x: number, width: number, y: number) {
  context.fillStyle = colors.running;
  context.fillRect(x, y + 3, width, LANE - 6);
}

function drawSpan(pen: Pen, { state, again }: LaneSpan, x: number, end: number, y: number, isLast: boolean) {
  const width = Math.max(1, end - x), { context, colors } = pen;
  if (state === RUNNING) return fillRunning(pen, x, width, y);
  if (state === HELD_STATE) return fillHeld(pen, x, width, y);
  context.fillStyle = state === SUCCESS ? colors.success : state === FAILURE ? colors.failure : colors.dim;
  const thick = again ? 5 : 1.5, hasSign = width > SIGN + 4 || isLast, behind = hasSign && !again ? SIGN : 0;
  context.fillRect(x, y + 3, 2, LANE - 6);
  context.fillRect(x + behind, y + (LANE - thick) / 2, Math.max(0, width - behind), thick);
  if (hasSign) context.fillText(SIGNS[state], x + 4, y + LANE / 2 + (again ? -5 : 1));
}

// Where holds are too short to be seen one by one, a lane shows their share of the time, of each cell of so many pixels.
const CELL = 24, DENSE = 3; // holds of a cell

function drawShares(pen: Pen, run: Run, spans: LaneSpan[], window: Window, y: number) {
  const cells = new Map<number, { holds: number; held: number; active: number; from: number; to: number }>();
  for (const { state, from, to } of spans) {
    if (state !== RUNNING && state !== HELD_STATE) continue;
    const x = Math.max(0, xOf(run.times[from], window)), end = Math.min(window.width, xOf(run.times[to], window));
    for (let place = Math.floor(x / CELL); place * CELL < end; ++place) {
      const begin = Math.max(x, place * CELL), stop = Math.min(end, (place + 1) * CELL);
      const cell = cells.get(place) ?? { holds: 0, held: 0, active: 0, from: begin, to: stop };
      cells.set(place, cell);
      cell.active += stop - begin;
      cell.to = stop;
      if (state === HELD_STATE) cell.held += stop - begin, ++cell.holds;
    }
  }
  for (const { holds, held, active, from, to } of cells.values()) {
    if (holds < DENSE) continue;
    pen.context.clearRect(from, y, to - from, LANE);
    fillRunning(pen, from, to - from, y);
    fillHeld(pen, from, to - from, y, held / active);
  }
}

function drawLane(pen: Pen, run: Run, node: number, window: Window, y: number) {
  const from = run.lineAtTime(window.from), to = run.lineAtTime(window.to);
  let done = -1; // pixel that has its span already
  const spans = laneSpans(run, node, from, to);
  for (const span of spans) {
    const x = xOf(run.times[span.from], window), end = xOf(run.times[span.to], window);
    if (x > window.width) break;
    const isLast = span.to === run.last && end <= window.width;
    if (end <= done && span.state !== FAILURE && !isLast) continue;
    drawSpan(pen, span, Math.max(x, -2), Math.min(end, window.width + 2), y, isLast);
    done = Math.floor(end);
  }
  drawShares(pen, run, spans, window, y);
}

// A step of 1, 2 or 5 times a power of ten with a label about every 90 pixels.
function rulerStep({ from, to, width }: Window): number {
  const least = ((to - from) / width) * 90;
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= least) ?? 10 * power;
}

export function drawRuler(context: CanvasRenderingContext2D, window: Window, colors: Colors, height: number) {
  const step = rulerStep(window);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "top";
  for (let mark = Math.ceil(window.from / step); mark * step <= window.to; ++mark) {
    const x = Math.round(xOf(mark * step, window)) + 0.5;
    context.fillStyle = colors.line;
    context.fillRect(x, RULER - 6, 1, height);
    const text = `${(mark * step).toFixed(digits)} s`;
    if (x + 4 + context.measureText(text).width > window.width) continue; // only whole ones
    context.fillStyle = colors.dim;
    context.fillText(text, x + 4, 3);
  }
}

export function drawLanes(context: CanvasRenderingContext2D, run: Run, nodes: number[], first: number,
  window: Window, colors: Colors, height: number) {
  const pen: Pen = { context, colors, held: hatch(context, colors.held, colors.panel) };
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "middle";
  const rows = Math.ceil(height / LANE);
  const begin = Math.max(0, Math.floor(first / LANE));
  for (let row = begin; row < Math.min(nodes.length, begin + rows + 1); ++row) {
    drawLane(pen, run, nodes[row], window, row * LANE - first);
  }
}
