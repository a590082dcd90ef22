// The text of an event.
import type { RunEvent } from "../../model/events";
import { Moment } from "../../model/moment";
import type { Run } from "../../model/run";
import { waitOf } from "../../model/waiting";
import type { Store } from "../../store/store";

// Many events are of the same line.
let last: Moment | null = null;

function momentAt(run: Run, line: number): Moment {
  if (last?.run !== run || last.line !== line) last = new Moment(run, line);
  return last;
}

// Whom a node waited for is worked out when it is looked at: it is a matter of its siblings too.
export function whatHappened(store: Store, event: RunEvent): string {
  if (event.kind !== "hold" || event.explained || event.node === null) return event.text;
  const wait = waitOf(momentAt(store.run, event.line), event.node);
  event.explained = true;
  if (wait?.text) event.text = wait.text;
  return event.text;
}

export function eventText(store: Store, event: RunEvent): string {
  const text = whatHappened(store, event);
  return event.node === null ? text : `${store.run.shape.nodes[event.node].apart} ${text}`;
}
