// Progress over time of those that a synchronized node holds, as `lockstep log plot` draws it.
import { useEffect, useMemo, useRef } from "preact/hooks";
import uPlot from "uplot";
import type { Run } from "../../model/run";
import { waitOf } from "../../model/waiting";
import { stateOf } from "../../model/words";
import type { Store } from "../../store/store";
import { SERIES, colors, type Colors } from "../parts/colors";
import { Panel } from "../parts/panel";
import { chartData, chartSpan, MOST_SERIES } from "./data";
import { drawBehind, drawInFront } from "./drawings";

const HEIGHT = 200;

function synchronized(run: Run): number[] {
  return run.shape.nodes
    .filter((node) => node.inStep.length > 0 && node.synchronization !== "resources")
    .map((node) => node.index);
}

// The one that runs, else the one that ran last.
function lastActive(store: Store, keepers: number[]): number {
  let best = keepers[0], latest = -1;
  for (const keeper of keepers) {
    const { states } = store.run.nodes[keeper];
    const place = states.placeAt(store.line);
    if (place < 0) continue;
    const since = (states.values[place] & 7) === 1 ? Infinity : states.lines[place];
    if (since > latest) [best, latest] = [keeper, since];
  }
  return best;
}

// Pixels between two marks: as much as the longer label needs.
function labelSpace(_: uPlot, __: number, from: number, to: number): number {
  if (!(to > from)) return 50; // nothing has come yet
  const decimals = Math.max(0, Math.ceil(-Math.log10((to - from) / 5)));
  return Math.max(50, 7 * (Math.max(from, to).toFixed(decimals).length + 4));
}

function options(store: Store, keeper: number, names: string[], width: number, paint: Colors): uPlot.Options {
  const axis = { stroke: paint.dim, grid: { stroke: paint.faint, width: 1 }, ticks: { stroke: paint.line, width: 1 } };
  return {
    width, height: HEIGHT, legend: { show: false }, cursor: { show: false }, pxAlign: false,
    scales: { x: { time: false, auto: false, range: () => chartSpan(store, keeper) }, y: { auto: false, range: () => [0, 1] } },
    axes: [
      { ...axis, size: 26, values: (_, marks) => marks.map((mark) => `${Number(mark.toPrecision(6))} s`), space: labelSpace },
      { ...axis, size: 48, splits: () => [0, 0.25, 0.5, 0.75, 1] },
    ],
    padding: [8, 20, 4 + 6 * Math.min(names.length, MOST_SERIES), 0],
    series: [{}, ...names.map((name, place) => ({
      label: name, stroke: paint[`series${place % SERIES}`], width: 2,
      dash: place < SERIES ? [[], [7, 4], [2, 3], [10, 3, 2, 3], [4, 4], [12, 4]][place] : [2, 2],
      points: { show: false }, spanGaps: false,
    }))],
    hooks: {
      drawClear: [(plot) => drawBehind(plot, store, keeper, colors())],
      draw: [(plot) => drawInFront(plot, store, keeper, colors())],
    },
  };
}

function usePlot(store: Store, keeper: number, names: string[]) {
  const place = useRef<HTMLDivElement>(null), plot = useRef<uPlot | null>(null);
  const { theme } = store.looking;
  useEffect(() => {
    if (!place.current) return;
    const width = place.current.clientWidth || 320;
    const made = (plot.current = new uPlot(options(store, keeper, names, width, colors()), [[], ...names.map(() => [])] as never, place.current));
    const observer = new ResizeObserver(([entry]) => made.setSize({ width: entry.contentRect.width, height: HEIGHT }));
    observer.observe(place.current);
    return () => {
      observer.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [store, keeper, theme, store.colorVersion]);
  const [from, to] = chartSpan(store, keeper);
  useEffect(() => {
    plot.current?.setData(chartData(store.run, keeper, from, to, 2 * HEIGHT) as uPlot.AlignedData);
  }, [store.run.version, keeper, from, to, theme, store.colorVersion]);
  useEffect(() => plot.current?.redraw(false), [store.line]);
  return place;
}

export function Chart({ store }: { store: Store }) {
  const { run, moment, looking } = store;
  const keepers = useMemo(() => synchronized(run), [run.shape]);
  if (keepers.length === 0) return null;
  const keeper = looking.plotted ?? lastActive(store, keepers);
  return (
    <Panel title="Progress over time" note={keepers.length === 1 ? run.shape.nodes[keeper].segment : undefined}>
      {keepers.length > 1 && (
        <select aria-label="Synchronized node" value={looking.plotted ?? ""}
          onChange={(event) => {
            const { value } = event.target as HTMLSelectElement;
            store.set({ plotted: value === "" ? null : Number(value) });
          }}>
          <option value="">{`the active one: ${run.shape.nodes[keeper].segment}`}</option>
          {keepers.map((node) => <option key={node} value={node}>{run.shape.nodes[node].path}</option>)}
        </select>
      )}
      <Plot key={keeper} store={store} keeper={keeper} />
      <ul class="legend" aria-label={`Progress of ${run.shape.nodes[keeper].segment} at this moment`}>
        {run.shape.nodes[keeper].inStep.slice(0, MOST_SERIES).map((node, place) => (
          <li key={node}>
            <i class={`sample series${place % SERIES}`} aria-hidden="true" />
            {run.shape.nodes[keeper].names[place]} <b>{moment.progress[node].toFixed(2)}</b>{" "}
            <span class={stateOf(moment, node)}>{waitOf(moment, node)?.text ?? stateOf(moment, node)}</span>
          </li>
        ))}
      </ul>
    </Panel>
  );
}

function Plot({ store, keeper }: { store: Store; keeper: number }) {
  const { names, segment } = store.run.shape.nodes[keeper];
  const place = usePlot(store, keeper, names.slice(0, MOST_SERIES));
  const go = (event: MouseEvent) => {
    const over = place.current?.querySelector(".u-over")?.getBoundingClientRect();
    if (!over || over.width === 0) return;
    const [from, to] = chartSpan(store, keeper);
    store.goTo(store.run.lineAtTime(from + ((event.clientX - over.left) / over.width) * (to - from)));
  };
  return (
    <div class="chart" ref={place} role="img" onClick={go}
      aria-label={`Progress over time of ${names.join(", ")}, which ${segment} keeps in step`} />
  );
}
