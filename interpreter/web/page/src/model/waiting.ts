// Who waits for whom, and where: the same sentences as those of `lockstep replay`.
import type { Moment } from "./moment";
import { IDLE, SKIPPED } from "./recording";
import type { ShapeNode } from "./shape";

const EPSILON = 1e-9;

export interface Wait {
  node: number;
  keeper: number;
  for: number[]; // those that it waits for
  text: string;
}

export interface Span {
  least: number;
  most: number; // how far a child may be
}

function isLeftOut(moment: Moment, keeper: ShapeNode, child: number): boolean {
  const status = moment.status[child];
  return (status === SKIPPED && !moment.held[child]) || (keeper.ignoresIdle && status === IDLE);
}

// Of a node that compares progress.
export function spanOf(moment: Moment, keeper: ShapeNode): Span {
  let least = 1;
  for (const child of keeper.inStep) {
    if (!isLeftOut(moment, keeper, child)) least = Math.min(least, moment.progress[child]);
  }
  const limit = moment.limit(keeper.index);
  return { least, most: Math.min(1, keeper.synchronization === "relative" ? least + limit : limit) };
}

function slowest(moment: Moment, keeper: ShapeNode, least: number): number[] {
  return keeper.inStep
    .map((_, place) => place)
    .filter((place) => {
      const child = keeper.inStep[place];
      return !isLeftOut(moment, keeper, child) && moment.progress[child] <= least + EPSILON;
    });
}

function listed(names: string[]): string {
  if (names.length <= 2) return names.join(" and ");
  return `${names[0]}, ${names[1]} and ${names.length - 2} more`;
}

// As printf's %.6g of a barrier or delta.
export function short(value: number): string {
  return String(Number(value.toPrecision(6)));
}

function waitAtBarrier(moment: Moment, keeper: ShapeNode, node: number): Wait {
  const { least } = spanOf(moment, keeper);
  const places = slowest(moment, keeper, least);
  const whom = listed(places.map((place) => keeper.names[place]));
  const limit = moment.limit(keeper.index);
  const of = keeper.isGroup ? ` of '${keeper.segment}'` : "";
  let text = `waits for ${whom}`;
  if (keeper.synchronization === "relative") {
    text += `, ${(moment.progress[node] - least).toFixed(2)} ahead (delta ${limit}${of})`;
  } else if (Number.isFinite(limit)) {
    text += ` at barrier ${short(limit)}${of}`;
  }
  return { node, keeper: keeper.index, for: places.map((place) => keeper.inStep[place]), text };
}

// Sets of resources are sums of powers of two, up to 2^52.
function resourcesIn(pool: ShapeNode, set: number): string[] {
  return pool.resources.filter((_, bit) => Math.floor(Math.abs(set) / 2 ** bit) % 2 === 1);
}

// The limit of a member is that of the UseResources node above it.
function memberLimit(moment: Moment, child: number): number {
  return moment.limit(child - 1);
}

export function owned(moment: Moment, pool: ShapeNode, node: number): string {
  const limit = memberLimit(moment, node);
  return limit > 0 ? `owns ${resourcesIn(pool, limit).join(";")}` : "";
}

function waitForResources(moment: Moment, pool: ShapeNode, node: number): Wait | null {
  const limit = memberLimit(moment, node);
  if (limit >= 0) return null;
  const wanted = new Set(resourcesIn(pool, limit));
  const owners: number[] = [], parts: string[] = [];
  pool.inStep.forEach((other, place) => {
    const its = memberLimit(moment, other);
    const shared = its > 0 ? resourcesIn(pool, its).filter((name) => wanted.has(name)) : [];
    if (shared.length === 0) return;
    owners.push(other);
    parts.push(`${shared.join(";")} (${pool.names[place]})`);
  });
  return { node, keeper: pool.index, for: owners, text: parts.length ? `waits for ${parts.join(", ")}` : "" };
}

export function waitOf(moment: Moment, node: number): Wait | null {
  const { nodes } = moment.run.shape;
  const { keeper, parent } = nodes[node];
  if (keeper === null) return null;
  if (nodes[keeper].synchronization === "resources") return waitForResources(moment, nodes[keeper], node);
  // Under a parent that is held itself, the parent says what is waited for.
  if (!moment.held[node] || (parent !== null && moment.held[parent])) return null;
  return waitAtBarrier(moment, nodes[keeper], node);
}

export function waitsOf(moment: Moment): Wait[] {
  const waits: Wait[] = [];
  for (const { index, keeper } of moment.run.shape.nodes) {
    const wait = keeper === null ? null : waitOf(moment, index);
    if (wait) waits.push(wait);
  }
  return waits;
}

// The barriers to draw: those that the header has, else the current one.
export function marksOf(moment: Moment, keeper: ShapeNode): number[] {
  if (keeper.barriers.length > 0) return keeper.barriers;
  const { most } = spanOf(moment, keeper);
  return most > 0 && keeper.synchronization !== "resources" ? [most] : [];
}
