// The blackboard: each entry with its value, and all that it has been.
import { useState } from "preact/hooks";
import { Moment } from "../../model/moment";
import { valueAt, type EntryChange } from "../../model/run";
import { shortNumbers } from "../../model/numbers";
import { seconds } from "../../model/words";
import { spanShown } from "../../store/span";
import type { Store } from "../../store/store";
import { linesIn } from "../chart/data";
import { Plot, type Numbers } from "../chart/plot";
import { Panel } from "../parts/panel";

const MOST = 50;

function upTo(changes: EntryChange[], line: number): number {
  let count = changes.length;
  while (count > 0 && changes[count - 1].line > line) --count;
  return count;
}

// Those that may have written it: of the nodes with a port or a script that writes it, the ones that had a tick.
function writersOf(store: Store, entry: number, change: EntryChange): string {
  const { run } = store;
  const all = run.header?.entries?.[entry].writers;
  if (!all || change.line === 0) return "";
  const moment = new Moment(run, change.line);
  const ticked = all.filter((node) => moment.ticked[node]);
  const names = (ticked.length > 0 ? ticked : all).map((node) => run.shape.nodes[node].apart);
  return names.length === 0 ? "" : `by ${names.slice(0, 3).join(" or ")}${names.length > 3 ? " or others" : ""}`;
}

function shown(value: string | null | undefined): string {
  if (value === undefined) return "–";
  return value === null ? "(longer than 256 bytes)" : shortNumbers(value);
}

function numberOf(value: string | null): number | null {
  const flag = value === "true" ? 1 : value === "false" ? 0 : null;
  return flag ?? (value === null || value.trim() === "" || !Number.isFinite(Number(value)) ? null : Number(value));
}

interface Samples {
  data: Numbers;
  low: number;
  high: number;
}

// As many as there are columns. Null: they are not all numbers, or truth values, or all the same.
function samplesOf(store: Store, entry: number, columns: number): Samples | null {
  const { run } = store, lines = linesIn(run, ...spanShown(store), columns);
  let low = Infinity, high = -Infinity;
  const values: (number | null)[] = [];
  for (const line of lines) {
    const value = valueAt(run.entries[entry], line), number = numberOf(value);
    if (value !== null && number === null) return null;
    values.push(number);
    low = Math.min(low, number ?? Infinity);
    high = Math.max(high, number ?? -Infinity);
  }
  return high > low ? { data: [lines.map((line) => run.times[line]), values], low, high } : null;
}

function Curve({ store, entry }: { store: Store; entry: number }) {
  const samples = samplesOf(store, entry, 400);
  if (!samples) return null;
  const { data, low, high } = samples, margin = (high - low) * 0.06;
  return (
    <tr><td colSpan={4}>
      <Plot store={store} lines={1} height={110} stepped span={spanShown(store)} range={[low - margin, high + margin]}
        label={`${store.run.header!.entries![entry].key} over time`} data={() => data} />
    </td></tr>
  );
}

const WIDTH = 48, HEIGHT = 14;

// The same, as small as a word.
function SmallCurve({ store, entry }: { store: Store; entry: number }) {
  const samples = samplesOf(store, entry, WIDTH);
  if (!samples) return null;
  const { data: [times, values], low, high } = samples, [from, to] = spanShown(store);
  let path = "";
  times.forEach((time, place) => {
    const value = values[place];
    if (value === null) return;
    const x = ((time! - from) / (to - from)) * WIDTH, y = HEIGHT - 1 - ((value - low) / (high - low)) * (HEIGHT - 2);
    path += path === "" ? `M${x.toFixed(1)} ${y.toFixed(1)}` : `H${x.toFixed(1)}V${y.toFixed(1)}`;
  });
  return <svg class="small-curve" width={WIDTH} height={HEIGHT} aria-hidden="true"><path d={path} /></svg>;
}

function Entry({ store, entry }: { store: Store; entry: number }) {
  const [open, setOpen] = useState(false);
  const { run, line } = store;
  const { key, type } = run.header!.entries![entry];
  const changes = run.entries[entry];
  const count = upTo(changes, line);
  const now = changes[count - 1];
  return (
    <>
      <tr class={now?.line === line && !run.isEarlier(line) ? "fresh" : ""}>
        <th scope="row"><button type="button" class="node" aria-expanded={open} title={type}
          onClick={() => setOpen(!open)}>{key}</button></th>
        <td class="value" title={now?.value ?? ""}>{shown(now?.value)}</td>
        <td><SmallCurve store={store} entry={entry} /></td>
        <td class="dim">{now ? (run.isEarlier(now.line) ? "earlier" : seconds(run.times[now.line])) : ""}</td>
      </tr>
      {open && <Curve store={store} entry={entry} />}
      {open && changes.slice(Math.max(0, count - MOST), count).reverse().map((change) => (
        <tr key={change.line} class="history">
          <td>{writersOf(store, entry, change) || (run.isEarlier(change.line) ? "earlier" : change.line === 0 ? "at the start" : "")}</td>
          <td class="value" title={change.value ?? ""}>{shown(change.value)}</td>
          <td /><td><button type="button" class="node" onClick={() => store.goTo(change.line)}>{seconds(run.times[change.line])}</button></td>
        </tr>
      ))}
    </>
  );
}

export function Entries({ store }: { store: Store }) {
  const entries = store.run.header?.entries ?? [];
  if (entries.length === 0) return null;
  return (
    <Panel title="Blackboard" note={`${entries.length} ${entries.length === 1 ? "entry" : "entries"}`}>
      <table aria-label="Blackboard">
        <thead><tr><th>entry</th><th>value</th><th /><th>since</th></tr></thead>
        <tbody>{entries.map((_, entry) => <Entry key={entry} store={store} entry={entry} />)}</tbody>
      </table>
    </Panel>
  );
}
