// Lines over time, with the moment that is shown. A click goes to a moment.
import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import type { Store } from "../../store/store";
import { SERIES, colors, type Colors } from "../parts/colors";

export type Numbers = (number | null)[][]; // times, then the values of each line

interface Props {
  store: Store;
  label: string;
  lines: number;
  height: number;
  below?: number; // pixels below the axis, for `drawInFront`
  span: [number, number]; // seconds
  range: [number, number];
  marks?: number[]; // on the vertical axis
  stepped?: boolean;
  data: (columns: number) => Numbers;
  drawBehind?: (plot: uPlot, paint: Colors) => void;
  drawInFront?: (plot: uPlot, paint: Colors) => void;
}

// Pixels between two marks: as much as the longer label needs.
function labelSpace(_: uPlot, __: number, from: number, to: number): number {
  if (!(to > from)) return 50; // nothing has come yet
  const decimals = Math.max(0, Math.ceil(-Math.log10((to - from) / 5)));
  return Math.max(50, 7 * (Math.max(from, to).toFixed(decimals).length + 4));
}

function drawMoment(plot: uPlot, store: Store, paint: Colors) {
  const { ctx, bbox } = plot, x = plot.valToPos(store.moment.time, "x", true);
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  ctx.globalAlpha = 0.6; // what comes after the moment is pale
  ctx.fillStyle = paint.panel;
  ctx.fillRect(x, bbox.top, bbox.left + bbox.width - x, bbox.height);
  ctx.globalAlpha = 1;
  ctx.fillStyle = paint.text;
  ctx.fillRect(x, bbox.top, devicePixelRatio, bbox.height);
}

function options(props: RefObject<Props>, width: number, paint: Colors): uPlot.Options {
  const { lines, height, below = 0, marks, stepped } = props.current!;
  const axis = { stroke: paint.dim, grid: { stroke: paint.faint, width: 1 }, ticks: { stroke: paint.line, width: 1 } };
  const draw = (which: "drawBehind" | "drawInFront", plot: uPlot) => {
    plot.ctx.save();
    props.current![which]?.(plot, colors());
    if (which === "drawInFront") drawMoment(plot, props.current!.store, colors());
    plot.ctx.restore();
  };
  return {
    width, height, legend: { show: false }, cursor: { show: false }, pxAlign: false,
    scales: { x: { time: false, auto: false, range: () => props.current!.span }, y: { auto: false, range: () => props.current!.range } },
    axes: [
      { ...axis, size: 26, values: (_, at) => at.map((mark) => `${Number(mark.toPrecision(6))} s`), space: labelSpace },
      { ...axis, size: 56, space: 24, values: (_, at) => at.map((mark) => String(Number(mark.toPrecision(6)))), ...(marks ? { splits: () => marks } : {}) },
    ],
    padding: [8, 20, 4 + below, 0],
    series: [{}, ...Array.from({ length: lines }, (_, place) => ({
      stroke: paint[`series${place % SERIES}`], width: 2,
      dash: place < SERIES ? [[], [7, 4], [2, 3], [10, 3, 2, 3], [4, 4], [12, 4]][place] : [2, 2],
      points: { show: false }, spanGaps: false, ...(stepped ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
    }))],
    hooks: { drawClear: [(plot) => draw("drawBehind", plot)], draw: [(plot) => draw("drawInFront", plot)] },
  };
}

export function Plot(props: Props) {
  const { store, label, height, span: [from, to], range: [low, high] } = props;
  const place = useRef<HTMLDivElement>(null), plot = useRef<uPlot | null>(null), latest = useRef(props);
  latest.current = props;
  const { theme } = store.looking;
  useEffect(() => {
    if (!place.current) return;
    const made = (plot.current = new uPlot(options(latest, place.current.clientWidth || 320, colors()),
      Array.from({ length: latest.current.lines + 1 }, () => []) as never, place.current));
    const observer = new ResizeObserver(([entry]) => made.setSize({ width: entry.contentRect.width, height }));
    observer.observe(place.current);
    return () => {
      observer.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [store, height, props.lines, theme, store.colorVersion]);
  useEffect(() => {
    plot.current?.setData(latest.current.data(400) as uPlot.AlignedData);
  }, [store.run.version, from, to, low, high, height, props.lines, theme, store.colorVersion]);
  useEffect(() => plot.current?.redraw(false), [store.line]);
  const go = (event: MouseEvent) => {
    const over = place.current?.querySelector(".u-over")?.getBoundingClientRect();
    if (!over || over.width === 0) return;
    store.goTo(store.run.lineAtTime(from + ((event.clientX - over.left) / over.width) * (to - from)));
  };
  return <div class="chart" ref={place} role="img" onClick={go} aria-label={label} />;
}
