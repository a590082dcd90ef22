// Which subtrees are open: what the user has chosen, else what runs in a large tree, or has decided its result, all of a
// small one.
import { decidingPath } from "./decision";
import type { Moment } from "./moment";
import { RUNNING } from "./recording";

export const LARGE = 120, SMALL = 20; // nodes; the latter on a phone

export type Folds = ReadonlyMap<number, boolean>; // node: open?

export function isOpen(moment: Moment, folds: Folds, onlyActive: boolean, node: number): boolean {
  const chosen = folds.get(node);
  if (chosen !== undefined) return chosen;
  if (onlyActive && decidingPath(moment).some((it) => it.node === node)) return true;
  return !onlyActive || moment.status[node] === RUNNING || moment.run.shape.nodes[node].parent === null;
}

// In pre-order, those that no folded node hides.
export function shownNodes(moment: Moment, folds: Folds, onlyActive: boolean): number[] {
  const shown: number[] = [];
  const { nodes } = moment.run.shape;
  for (let index = 0; index < nodes.length; ) {
    shown.push(index);
    const { children, end } = nodes[index];
    index = children.length === 0 || isOpen(moment, folds, onlyActive, index) ? index + 1 : end;
  }
  return shown;
}

// Those above a node that have to be open.
export function opened(moment: Moment, folds: Folds, onlyActive: boolean, node: number): Folds {
  const result = new Map(folds);
  const { nodes } = moment.run.shape;
  for (let up = nodes[node].parent; up !== null; up = nodes[up].parent) {
    if (!isOpen(moment, folds, onlyActive, up)) result.set(up, true);
  }
  return result;
}

// "2 running, 9 idle" of what is below a folded node.
export function tallyBelow(moment: Moment, node: number): { held: number; by: number[] } {
  const by = [0, 0, 0, 0, 0];
  let held = 0;
  const { end } = moment.run.shape.nodes[node];
  for (let below = node + 1; below < end; ++below) {
    if (moment.held[below]) ++held;
    else ++by[moment.status[below]];
  }
  return { held, by };
}
