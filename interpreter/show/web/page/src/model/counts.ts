// How often nodes completed, were halted and held, how many faults and values there were. From the lines that came, and
// where some are missing from what the program has counted.
import { HELD, STATUS, TICKED } from "./columns";
import { IDLE, RUNNING, type TickLine } from "./recording";

const KINDS = ["succeeded", "failed", "skipped", "halted", "held", "faults"] as const;
const HALTED = 3, HELDS = 4, FAULTS = 5;

export type CountsOfNode = Record<(typeof KINDS)[number], number>;

interface Counted {
  counts: number[];
  since: number; // the tick with which it became as it is
  flags: number;
}

export class Counts {
  private readonly nodes: Counted[];
  private readonly entries: number[];

  constructor(nodes: number, entries: number) {
    this.nodes = Array.from({ length: nodes }, () => ({ counts: KINDS.map(() => 0), since: 0, flags: 0 }));
    this.entries = new Array(entries).fill(0);
  }

  // `joins`: with which tick it became so is not known.
  change(node: number, flags: number, tick: number, joins = false) {
    const it = this.nodes[node], was = it.flags & STATUS;
    it.counts = before(it, tick);
    if (was === RUNNING && (flags & STATUS) === IDLE) ++it.counts[HALTED];
    if (flags & HELD && !(it.flags & HELD) && !joins) ++it.counts[HELDS];
    it.since = tick;
    it.flags = flags;
  }
  // Of a tick of several moments: each of these, what is only counted, and at last the state after it.
  moment(node: number, was: number, now: number, times: number, tick: number) {
    const it = this.nodes[node];
    it.counts = before(it, tick);
    it.since = tick;
    const status = now & STATUS;
    if (now & TICKED && status > RUNNING) it.counts[status - 2] += times;
    if ((was & STATUS) === RUNNING && status === IDLE) ++it.counts[HALTED];
    if (now & HELD && !(was & HELD)) ++it.counts[HELDS];
  }
  add(node: number, counts: number[]) {
    counts.forEach((count, kind) => (this.nodes[node].counts[kind] += count));
  }
  settle(flags: number[], tick: number) {
    this.nodes.forEach((it, node) => {
      it.since = tick + 1;
      it.flags = flags[node];
    });
  }
  fault(node: number) {
    ++this.nodes[node].counts[FAULTS];
  }
  entry(entry: number) {
    ++this.entries[entry];
  }

  // Up to a tick, since which nothing has changed.
  ofNode(node: number, tick: number): CountsOfNode {
    const counts = before(this.nodes[node], tick + 1);
    return Object.fromEntries(KINDS.map((kind, place) => [kind, counts[place]])) as CountsOfNode;
  }

  // Takes over what the program has counted up to the line. In words, what of it did not come: "12 failed, 3 held".
  correct(line: TickLine): string {
    const missing = KINDS.map(() => 0);
    for (const [node, ...told] of line.counts ?? []) {
      const it = this.nodes[node], known = before(it, line.tick + 1);
      told.forEach((count, kind) => {
        missing[kind] += Math.max(0, count - known[kind]);
        it.counts[kind] += count - known[kind];
      });
    }
    let values = 0;
    for (const [entry, told] of line.written ?? []) {
      values += Math.max(0, told - this.entries[entry]);
      this.entries[entry] = told;
    }
    const parts = KINDS.map((kind, place) => [missing[place], kind] as const).filter(([count]) => count > 0);
    return [...parts.map(([count, kind]) => `${count} ${kind}`), ...(values > 0 ? [`${values} values of entries`] : [])].join(", ");
  }
}

// Before a tick. A node that a tick reaches, and that does not run after it, has completed in this tick.
function before({ counts, since, flags }: Counted, tick: number): number[] {
  const status = flags & STATUS, all = [...counts];
  if (flags & TICKED && status > RUNNING) all[status - 2] += tick - since;
  return all;
}
