// The blackboard: each entry with its value, and all that it has been.
import { useState } from "preact/hooks";
import { Moment } from "../../model/moment";
import type { EntryChange } from "../../model/run";
import { seconds } from "../../model/words";
import type { Store } from "../../store/store";
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
  return value === null ? "(longer than 256 bytes)" : value;
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
      <tr class={now?.line === line ? "fresh" : ""}>
        <th scope="row"><button type="button" class="node" aria-expanded={open} title={type}
          onClick={() => setOpen(!open)}>{key}</button></th>
        <td class="value">{shown(now?.value)}</td>
        <td class="dim">{now ? seconds(run.times[now.line]) : ""}</td>
      </tr>
      {open && changes.slice(Math.max(0, count - MOST), count).reverse().map((change) => (
        <tr key={change.line} class="history">
          <td>{writersOf(store, entry, change) || (change.line === 0 ? "at the start" : "")}</td>
          <td class="value">{shown(change.value)}</td>
          <td><button type="button" class="node" onClick={() => store.goTo(change.line)}>{seconds(run.times[change.line])}</button></td>
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
        <thead><tr><th>entry</th><th>value</th><th>since</th></tr></thead>
        <tbody>{entries.map((_, entry) => <Entry key={entry} store={store} entry={entry} />)}</tbody>
      </table>
    </Panel>
  );
}
