// The events up to this moment, newest first. A series of them is one line, until it is opened.
import { CHIPS, isFolded, isShown, type EventKind, type RunEvent } from "../../model/events";
import { heldSpans, percent, sumOf, timesText } from "../../model/lanes";
import { seconds } from "../../model/words";
import type { Store } from "../../store/store";
import { Panel } from "../parts/panel";
import { whatHappened } from "./event_text";

const MOST = 120, FARTHEST = 50_000;

const SIGNS: Record<EventKind, string> = {
  start: "▶", success: "✓", failure: "✗", skipped: "»", halt: "■", hold: "‖", release: "▶",
  fault: "!", entry: "=", log: "…", overrun: "!", lost: "!", end: "■",
};

function isWarning(event: RunEvent): boolean {
  return event.kind === "fault" || event.kind === "overrun" || event.kind === "lost" || event.level === "warning";
}

function newest(store: Store): RunEvent[] {
  const { all } = store.run.events, { filter } = store;
  const found: RunEvent[] = [], folded = new Set();
  const last = store.run.events.placeAfter(store.line);
  for (let place = last; place-- > Math.max(0, last - FARTHEST) && found.length < MOST; ) {
    const event = all[place];
    if (folded.has(event.series) || !isShown(filter, event)) continue;
    if (isFolded(event)) folded.add(event.series);
    found.push(event);
  }
  return found;
}

// "base held 45 % of 2.98 s (87 times), head 20 % (40 times)"
function holdsText(store: Store, event: RunEvent, keeper: number): string {
  const { run } = store, { inStep, names } = run.shape.nodes[keeper];
  const from = run.times[event.series!.from], to = run.times[event.line] + run.period;
  const parts = inStep.map((child, place) => ({ name: names[place], spans: heldSpans(run, child, from, to) }))
    .filter(({ spans }) => spans.length > 0);
  return parts.slice(0, 4).map(({ name, spans }, place) =>
    `${name} ${place === 0 ? "held " : ""}${percent(sumOf(spans, from, to), to - from)}` +
    `${place === 0 ? ` of ${(to - from).toFixed(2)} s` : ""} (${timesText(spans.length)})`).join(", ") +
    (parts.length > 4 ? ` and ${parts.length - 4} more` : "");
}

// Of a series that is open, at its newest event.
function Fold({ store, event }: { store: Store; event: RunEvent }) {
  const fold = () => {
    event.series!.open = false;
    store.changed();
  };
  return <button type="button" class="more" aria-expanded={true} title="show these events as one" onClick={fold}>as one</button>;
}

function Series({ store, event }: { store: Store; event: RunEvent }) {
  const { nodes } = store.run.shape, { kind, node, series, number } = event;
  const keeper = kind === "hold" || kind === "release" ? nodes[node!].keeper! : null;
  const open = () => {
    series!.open = true;
    store.changed();
  };
  return (
    <>
      {keeper === null ? <><What store={store} event={event} /><span class="dim">, {timesText(number)} in succession </span></>
        : <><Name store={store} node={keeper} />{`: ${holdsText(store, event, keeper)} `}</>}
      <button type="button" class="more" aria-expanded={false} title="show each of these events" onClick={open}>each</button>
    </>
  );
}

function Name({ store, node }: { store: Store; node: number }) {
  const { path, apart } = store.run.shape.nodes[node];
  return <button type="button" class="node" title={path} onClick={() => store.select(node, true)}>{apart}</button>;
}

function What({ store, event }: { store: Store; event: RunEvent }) {
  return (
    <>
      {isWarning(event) && <b>{event.kind === "log" ? "warning: " : `${event.kind}: `}</b>}
      {event.node !== null && <><Name store={store} node={event.node} />{" "}</>}
      {whatHappened(store, event)}
    </>
  );
}

function Row({ store, event, isNewest }: { store: Store; event: RunEvent; isNewest: boolean }) {
  return (
    <li class={`event ${event.kind}${isWarning(event) ? " warning" : ""}${event.line === store.line ? " fresh" : ""}`}>
      <button type="button" class="time" onClick={() => store.goTo(event.line)}>{seconds(store.run.times[event.line] ?? 0)}</button>
      <span class="symbol" aria-hidden="true">{SIGNS[event.kind === "release" && isFolded(event) ? "hold" : event.kind]}</span>
      <span class="what">{isFolded(event) ? <Series store={store} event={event} /> : <What store={store} event={event} />}
        {isNewest && event.series?.open && <>{" "}<Fold store={store} event={event} /></>}</span>
    </li>
  );
}

export function Log({ store }: { store: Store }) {
  const { selected, hidden, onlySelected } = store.looking;
  const turn = (name: string) => {
    const next = new Set(hidden);
    if (!next.delete(name)) next.add(name);
    store.set({ hidden: next });
  };
  const events = newest(store);
  return (
    <Panel title="Events" note="up to this moment, newest first">
      <p class="buttons filters" role="group" aria-label="Which events; [ and ] stop at these">
        {Object.keys(CHIPS).map((name) => (
          <button type="button" key={name} aria-pressed={!hidden.has(name)} onClick={() => turn(name)}>{name}</button>
        ))}
        {selected !== null && <button type="button" aria-pressed={onlySelected}
          onClick={() => store.set({ onlySelected: !onlySelected })}>this node</button>}
      </p>
      <ol class="events" aria-label="Events">{events.map((event, place) => (
        <Row key={place} store={store} event={event} isNewest={events.findIndex(({ series }) => series === event.series) === place} />
      ))}</ol>
    </Panel>
  );
}
