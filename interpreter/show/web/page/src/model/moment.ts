// The state of all nodes in one line of the run.
import { HELD, STATUS, TICKED } from "./columns";
import { IDLE, RUNNING, SUCCESS } from "./recording";
import type { Run } from "./run";

// The progress of the children of a synchronized node.
export interface Span {
  least: number;
  most: number; // how far a child may be
  slowest: number[]; // the places of those that are at the least
}

export class Moment {
  readonly status: Uint8Array;
  readonly progress: Float64Array; // as it is shown: 1 after success, 0 when idle
  readonly ticked: Uint8Array;
  readonly held: Uint8Array;

  readonly spans = new Map<number, Span>(); // of synchronized nodes, once they were asked for

  constructor(readonly run: Run, readonly line: number) {
    const count = run.nodes.length;
    this.status = new Uint8Array(count);
    this.progress = new Float64Array(count);
    this.ticked = new Uint8Array(count);
    this.held = new Uint8Array(count);
    for (let node = 0; node < count; ++node) {
      const column = run.nodes[node];
      const place = column.at(line);
      if (place < 0) continue;
      const flags = column.flags[place];
      const status = (this.status[node] = flags & STATUS);
      this.progress[node] = status === SUCCESS ? 1 : status === IDLE ? 0 : column.progress[place];
      this.ticked[node] = flags & TICKED ? 1 : 0;
      this.held[node] = flags & HELD ? 1 : 0;
    }
  }

  // Before the first tick there is nothing.
  get tick(): number {
    return this.run.ticks[this.line] ?? 0;
  }
  get time(): number {
    return this.run.times[this.line] ?? 0;
  }
  // The limit of a synchronized node; 0 when it has none yet, infinity when no barrier is left.
  limit(node: number): number {
    return this.run.limits.get(node)?.at(this.line) ?? 0;
  }
  // How fast a node is to be, in (0, 1].
  factor(node: number): number {
    return this.status[node] === RUNNING ? this.run.factors.get(node)?.at(this.line) || 1 : 1;
  }
  // For how long a node that stands for another robot has heard no new word, in seconds; null: it has never heard one.
  silence(node: number): number | null {
    const line = this.run.heard.get(node)?.at(this.line);
    return line === undefined ? null : this.time - this.run.times[line];
  }
  round(node: number): string {
    const round = this.run.rounds.get(node);
    const number = round?.number.at(this.line) ?? 0;
    if (!round || number === 0) return "";
    const of = round.of.at(this.line) ?? 0;
    return of === 0 ? `${number}` : `${number}/${of}`;
  }
  isLastOfEnded(): boolean {
    return this.run.end !== null && this.line === this.run.last;
  }
}
