// All that is known of the node that is selected.
import { activations, laneText } from "../../model/lanes";
import type { Moment } from "../../model/moment";
import { shortNumbers } from "../../model/numbers";
import { reasonOf } from "../../model/reasons";
import { STATUSES } from "../../model/recording";
import { valueAt } from "../../model/run";
import { heardText, isShared, marksOf, ownersOf, paceText, short, spanOf, waitOf } from "../../model/waiting";
import { seconds, stateOf, symbolOf } from "../../model/words";
import type { Store } from "../../store/store";
import { Panel } from "../parts/panel";
import { Breakpoints } from "./breakpoints";

const MOST = 6;

function facts(moment: Moment, node: number): [string, string][] {
  const it = moment.run.shape.nodes[node];
  const { states } = moment.run.nodes[node];
  const since = states.placeAt(moment.line);
  const rows: [string, string][] = [["Path", it.path], ["Kind", it.kind]];
  const from = since < 0 ? "" : ` since ${seconds(moment.run.times[states.lines[since]])}`;
  rows.push(["State", `${symbolOf(moment, node)} ${stateOf(moment, node)}${from}`]);
  rows.push(["Progress", moment.progress[node].toFixed(4)]);
  if (moment.round(node)) rows.push(["Round", moment.round(node)]);
  rows.push(["In this run", laneText(moment.run, node)]);
  const wait = waitOf(moment, node);
  if (wait) rows.push(["Waiting", wait.text]);
  const reason = reasonOf(moment, node);
  if (reason) rows.push(["Reason", reason]);
  if (it.isRobot && heardText(moment, node)) rows.push(["Last word", heardText(moment, node)]);
  const pace = paceText(moment, node);
  if (pace) rows.push(["Pace", pace]);
  if (it.synchronization === "resources") {
    const other = isShared(moment, it) ? "not of this robot" : "free";
    for (const { resource, place } of ownersOf(moment, it)) rows.push([resource, place === null ? other : it.names[place]]);
    return rows;
  }
  if (it.synchronization === "absolute") rows.push(["Barriers", marksOf(moment, it).map(short).join(", ") || "none left"]);
  if (it.synchronization === "relative") rows.push(["Delta", short(moment.limit(node))]);
  if (it.synchronization === "absolute" || it.synchronization === "relative") {
    const { least, most } = spanOf(moment, it);
    rows.push(["Now", `the slowest at ${least.toFixed(2)}; no child passes ${Number.isFinite(most) ? short(most) : "1"}`]);
  }
  return rows;
}

// The entry of "{goal}", or undefined.
function entryOf(moment: Moment, text: string): number | undefined {
  const { header } = moment.run;
  const found = text.startsWith("{") && text.endsWith("}") ? (header?.entries ?? []).findIndex(({ key }) => key === text.slice(1, -1)) : -1;
  return found < 0 ? undefined : found;
}

// Of a SubTree its own entries: its ports with a value of their own are among them.
function portsOf({ run }: Moment, node: number): [string, string][] {
  const { nodes } = run.shape, names: string[] = [];
  if (nodes[node].kind !== "SubTree") return Object.entries(run.header?.nodes[node].ports ?? {});
  for (let at: number | null = node; at !== null; at = nodes[at].parent) {
    if (nodes[at].kind === "SubTree") names.unshift(nodes[at].segment);
  }
  const prefix = `${names.join("/")}/`;
  return (run.header?.entries ?? []).filter(({ key }) => key.startsWith(prefix) && !key.slice(prefix.length).includes("/"))
    .map(({ key }) => [key.slice(prefix.length), `{${key}}`]);
}

// Each with its value at this moment, where it is an entry.
function Ports({ moment, node }: { moment: Moment; node: number }) {
  const ports = portsOf(moment, node);
  if (ports.length === 0) return null;
  const hasEntries = ports.some(([, text]) => entryOf(moment, text) !== undefined);
  return (
    <table aria-label="Ports">
      <thead><tr><th>port</th><th>value</th><th>{hasEntries && "entry"}</th></tr></thead>
      <tbody>
        {ports.map(([name, text]) => {
          const entry = entryOf(moment, text);
          const value = entry === undefined ? text : valueAt(moment.run.entries[entry], moment.line);
          return (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td class="value" title={value ?? ""}>{value === null ? "–" : shortNumbers(value)}</td>
              <td class="dim">{entry === undefined ? "" : text.slice(1, -1)}</td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

function Activations({ store, moment, node }: { store: Store; moment: Moment; node: number }) {
  const { times } = moment.run;
  const found = activations(moment.run, node, moment.line, MOST);
  if (found.length === 0) return <p class="dim">has not been active yet</p>;
  return (
    <table aria-label="Activations, newest first">
      <thead><tr><th>began</th><th>took</th><th>held</th><th>result</th></tr></thead>
      <tbody>
        {found.map(({ from, to, result, held }) => (
          <tr key={from}>
            <td><button type="button" class="node" onClick={() => store.goTo(from)}>{seconds(times[from])}</button></td>
            <td>{seconds((to === null ? moment.time : times[to]) - times[from])}</td>
            <td>{held > 0 ? seconds(held) : ""}</td>
            <td>{to !== null && result === 0 ? "halted" : STATUSES[result]}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function Details({ store }: { store: Store }) {
  const { moment, looking } = store;
  const node = looking.selected;
  if (node === null) return null;
  const it = store.run.shape.nodes[node];
  return (
    <Panel title={`Node ${it.apart}`}>
      <dl>{facts(moment, node).map(([name, value]) => <div key={name}><dt>{name}</dt><dd>{value}</dd></div>)}</dl>
      <Breakpoints store={store} node={node} />
      <Ports moment={moment} node={node} />
      <Activations store={store} moment={moment} node={node} />
      {it.children.length > 0 && (
        <p class="buttons">
          <button type="button" onClick={() => store.foldBelow(node, true)}>unfold all below</button>
          <button type="button" onClick={() => store.foldBelow(node, false)}>fold all below</button>
        </p>
      )}
    </Panel>
  );
}
