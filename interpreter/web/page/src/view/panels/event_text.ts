// What an event says.
import type { RunEvent } from "../../model/events";
import { Moment } from "../../model/moment";
import { waitOf } from "../../model/waiting";
import type { Store } from "../store";

// Whom a node waited for is worked out when it is looked at: it is a matter of its siblings too.
export function whatHappened(store: Store, event: RunEvent): string {
  if (event.kind !== "hold" || event.explained || event.node === null) return event.text;
  const wait = waitOf(new Moment(store.run, event.line), event.node);
  event.explained = true;
  if (wait?.text) event.text = wait.text;
  return event.text;
}

export function eventText(store: Store, event: RunEvent): string {
  const text = whatHappened(store, event);
  return event.node === null ? text : `${store.run.shape.nodes[event.node].apart} ${text}`;
}
