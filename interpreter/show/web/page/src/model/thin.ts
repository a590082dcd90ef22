// A run that goes on for days must not fill the memory: of what is old, every second progress between two changes of
// state is forgotten, and the oldest events are.
import type { NodeColumn } from "./columns";
import type { Events } from "./events";

const MOST_CHANGES = 6_000_000, MOST_EVENTS = 400_000;

export class Thinner {
  private changes = 0;

  constructor(private readonly most = MOST_CHANGES, private readonly mostEvents = MOST_EVENTS) {}

  // After a change of a node.
  count(nodes: NodeColumn[]) {
    if (++this.changes <= this.most) return;
    for (const node of nodes) node.thin();
    this.changes = nodes.reduce((sum, node) => sum + node.length, 0);
  }
  events(events: Events) {
    if (events.all.length > this.mostEvents) events.all.splice(0, this.mostEvents >> 1);
  }
}
