// The events up to this moment, newest first.
import { useState } from "preact/hooks";
import type { EventKind, RunEvent } from "../../model/events";
import { seconds } from "../../model/words";
import type { Store } from "../../store/store";
import { Panel } from "../parts/panel";
import { whatHappened } from "./event_text";

const MOST = 120, FARTHEST = 50_000;

const GROUPS: Record<string, EventKind[]> = {
  completions: ["start", "success", "failure", "skipped", "halt"],
  waiting: ["hold", "release"],
  troubles: ["fault", "overrun", "lost", "end"],
  entries: ["entry"],
  logs: ["log"],
};
const SIGNS: Record<EventKind, string> = {
  start: "▶", success: "✓", failure: "✗", skipped: "»", halt: "■", hold: "‖", release: "▶",
  fault: "!", entry: "=", log: "…", overrun: "!", lost: "!", end: "■",
};

function isWarning(event: RunEvent): boolean {
  return event.kind === "fault" || event.kind === "overrun" || event.kind === "lost" || event.level === "warning";
}

function newest(store: Store, kinds: Set<EventKind>, only: number | null): RunEvent[] {
  const { events } = store.run;
  const found: RunEvent[] = [];
  const last = events.placeAfter(store.line);
  for (let place = last; place-- > Math.max(0, last - FARTHEST) && found.length < MOST; ) {
    const event = events.all[place];
    if (kinds.has(event.kind) && (only === null || event.node === only)) found.push(event);
  }
  return found;
}

function Row({ store, event }: { store: Store; event: RunEvent }) {
  const node = event.node === null ? null : store.run.shape.nodes[event.node];
  return (
    <li class={`event ${event.kind}${isWarning(event) ? " warning" : ""}${event.line === store.line ? " fresh" : ""}`}>
      <button type="button" class="time" onClick={() => store.goTo(event.line)}>{seconds(store.run.times[event.line] ?? 0)}</button>
      <span class="symbol" aria-hidden="true">{SIGNS[event.kind]}</span>
      <span class="what">
        {isWarning(event) && <b>{event.kind === "log" ? "warning: " : `${event.kind}: `}</b>}
        {node && <><button type="button" class="node" title={node.path}
          onClick={() => store.select(node.index, true)}>{node.apart}</button>{" "}</>}
        {whatHappened(store, event)}
      </span>
    </li>
  );
}

export function Log({ store }: { store: Store }) {
  const [hidden, setHidden] = useState<ReadonlySet<string>>(new Set());
  const [only, setOnly] = useState(false);
  const { selected } = store.looking;
  const kinds = new Set(Object.entries(GROUPS).flatMap(([name, group]) => (hidden.has(name) ? [] : group)));
  const turn = (name: string) => {
    const next = new Set(hidden);
    if (!next.delete(name)) next.add(name);
    setHidden(next);
  };
  const events = newest(store, kinds, only ? selected : null);
  return (
    <Panel title="Events" note="up to this moment, newest first">
      <p class="buttons filters" role="group" aria-label="Which events">
        {Object.keys(GROUPS).map((name) => (
          <button type="button" key={name} aria-pressed={!hidden.has(name)} onClick={() => turn(name)}>{name}</button>
        ))}
        {selected !== null && <button type="button" aria-pressed={only} onClick={() => setOnly(!only)}>this node</button>}
      </p>
      <ol class="events" aria-label="Events">{events.map((event, place) => <Row key={place} store={store} event={event} />)}</ol>
    </Panel>
  );
}
