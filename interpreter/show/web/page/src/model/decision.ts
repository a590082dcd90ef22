// Why a run has completed with its result: the path from the root to the node that decided, as in the summary of a run
// (judge/measure/decision.h). Also: with which moment a recording opens.
import type { Moment } from "./moment";
import { RUNNING } from "./recording";
import type { Run } from "./run";

export interface Deciding {
  node: number;
  children: number;
  agreeing: number; // how many of the children have the same result
}

// The last one of the children that agree with their parent.
function decidingChild(moment: Moment, children: number[], status: number): number | undefined {
  return [...children].reverse().find((child) => moment.ticked[child] === 1 && moment.status[child] > RUNNING &&
    (children.length === 1 || moment.status[child] === status));
}

function pathOf(moment: Moment): Deciding[] {
  if (!moment.isLastOfEnded() || moment.run.end?.reason !== "completed") return [];
  const path: Deciding[] = [];
  for (let node: number | undefined = 0; node !== undefined; ) {
    const { children } = moment.run.shape.nodes[node];
    const status: number = moment.status[node];
    path.push({ node, children: children.length, agreeing: children.filter((child) => moment.status[child] === status).length });
    node = decidingChild(moment, children, status);
  }
  return path;
}

const known = new WeakMap<Moment, Deciding[]>();

// From the root down, after the last tick of a run whose root has completed; else empty.
export function decidingPath(moment: Moment): Deciding[] {
  let path = known.get(moment);
  if (!path) known.set(moment, (path = pathOf(moment)));
  return path;
}

// The line at which a page of an ended run begins. After a success it is the first moment in which a node is held, or a leaf
// was at fault, else the end; after everything else the end, since there it was decided. null: the newest.
export function firstLine(run: Run): number | null {
  if (run.end?.result !== "success") return null;
  const found = run.events.all.find(({ kind }) => kind === "hold" || kind === "fault");
  return found?.line ?? null;
}
