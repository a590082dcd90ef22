// Progress over time of those that a synchronized node holds, as `lockstep log plot` draws it, and how far apart they are.
import { useMemo } from "preact/hooks";
import { STATUS } from "../../model/columns";
import { RUNNING } from "../../model/recording";
import type { Run } from "../../model/run";
import { spreadBound, spreadIn } from "../../model/spread";
import { short, waitOf } from "../../model/waiting";
import { stateOf } from "../../model/words";
import type { Store } from "../../store/store";
import { SERIES } from "../parts/colors";
import { Panel } from "../parts/panel";
import { chartData, chartSpan, linesIn, MOST_SERIES } from "./data";
import { drawBehind, drawHeld, drawLine } from "./drawings";
import { Plot } from "./plot";

// Those that some tick has reached.
function synchronized(run: Run): number[] {
  return run.shape.nodes
    .filter(({ index, inStep, synchronization }) => inStep.length > 0 && synchronization !== "resources" && run.nodes[index].states.length > 0)
    .map((node) => node.index);
}

// The one that runs, else the one that ran last.
function lastActive(store: Store, keepers: number[]): number {
  let best = keepers[0], latest = -1;
  for (const keeper of keepers) {
    const { states } = store.run.nodes[keeper];
    const place = states.placeAt(store.line);
    if (place < 0) continue;
    const since = (states.values[place] & STATUS) === RUNNING ? Infinity : states.lines[place];
    if (since > latest) [best, latest] = [keeper, since];
  }
  return best;
}

export function Chart({ store }: { store: Store }) {
  const { run, looking } = store;
  const keepers = useMemo(() => synchronized(run), [run.version]);
  if (keepers.length === 0) return null;
  const keeper = looking.plotted !== null && keepers.includes(looking.plotted) ? looking.plotted : lastActive(store, keepers);
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
      <Progress key={keeper} store={store} keeper={keeper} />
      <Spread key={-1 - keeper} store={store} keeper={keeper} />
    </Panel>
  );
}

function Progress({ store, keeper }: { store: Store; keeper: number }) {
  const { run, moment } = store, { inStep, names, segment } = run.shape.nodes[keeper];
  const span = chartSpan(store, keeper), lines = Math.min(names.length, MOST_SERIES);
  return (
    <>
      <Plot store={store} lines={lines} height={200} below={6 * lines} span={span} range={[0, 1]} marks={[0, 0.25, 0.5, 0.75, 1]}
        label={`Progress over time of ${names.join(", ")}, which ${segment} keeps in step`}
        data={(columns) => chartData(run, keeper, ...span, columns)}
        drawBehind={(plot, paint) => drawBehind(plot, run, keeper, paint)}
        drawInFront={(plot, paint) => drawHeld(plot, run, keeper, paint)} />
      <ul class="legend" aria-label={`Progress of ${segment} at this moment`}>
        {inStep.slice(0, MOST_SERIES).map((node, place) => (
          <li key={node}>
            <i class={`sample series${place % SERIES}`} aria-hidden="true" />
            {names[place]} <b>{moment.progress[node].toFixed(2)}</b>{" "}
            <span class={stateOf(moment, node)}>{waitOf(moment, node)?.text ?? stateOf(moment, node)}</span>
          </li>
        ))}
      </ul>
    </>
  );
}

// The difference between the most and the least advanced child, and what bounds it.
function Spread({ store, keeper }: { store: Store; keeper: number }) {
  const { run } = store, span = chartSpan(store, keeper), [from, to] = span;
  const first = run.lineAtTime(from), last = run.lineAtTime(to);
  const { largest, allowed, step, isAbout, unbounded } = useMemo(() => spreadBound(run, keeper, first, last), [run.version, keeper, first, last]);
  const bound = unbounded ? null : Math.min(1, allowed + step), top = Math.max(largest, bound ?? 0) * 1.15 || 1;
  const now = spreadIn(run, keeper, store.line);
  return (
    <>
      <Plot store={store} lines={1} height={110} span={span} range={[0, top]} label={`Spread of ${run.shape.nodes[keeper].segment} over time, and its bound`}
        data={(columns) => {
          const lines = linesIn(run, from, to, columns);
          return [lines.map((line) => run.times[line]), lines.map((line) => spreadIn(run, keeper, line))];
        }}
        drawBehind={(plot, paint) => bound !== null && drawLine(plot, bound, paint)} />
      <ul class="legend" aria-label="Spread at this moment">
        <li><i class="sample series0" aria-hidden="true" />spread <b>{now === null ? "–" : now.toFixed(3)}</b> <span class="dim">at most {largest.toFixed(3)}</span></li>
        <li><i class="sample bound" aria-hidden="true" />bound <b>{bound === null ? "none" : bound.toFixed(3)}</b>{" "}
          <span class="dim">{unbounded || `${run.shape.nodes[keeper].synchronization === "relative" ? "delta" : "barriers"} ${short(allowed)} + longest step ${isAbout ? "about " : ""}${step.toFixed(4)}`}</span></li>
      </ul>
    </>
  );
}
