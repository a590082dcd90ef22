// Finds which node waits for which, and where: the same sentences as those of `lockstep replay`.
import type { Moment, Span } from "./moment";
import { IDLE, PROGRESS_EPSILON, RUNNING, SKIPPED } from "./recording";
import type { ShapeNode } from "./shape";

const FEW = 8;

export interface Wait {
  node: number;
  keeper: number;
  for: number[]; // those that it waits for, of many a few
  text: string;
}

function isLeftOut(moment: Moment, keeper: ShapeNode, child: number): boolean {
  const status = moment.status[child];
  return (status === SKIPPED && !moment.held[child]) || (keeper.ignoresIdle && status === IDLE);
}

// The span of a node that compares progress. Worked out once in a moment, however many it holds.
export function spanOf(moment: Moment, keeper: ShapeNode): Span {
  const known = moment.spans.get(keeper.index);
  if (known) return known;
  const counted = keeper.inStep.map((child) => !isLeftOut(moment, keeper, child));
  let least = 1;
  keeper.inStep.forEach((child, place) => {
    if (counted[place]) least = Math.min(least, moment.progress[child]);
  });
  const slowest = [...keeper.inStep.keys()].filter(
    (place) => counted[place] && moment.progress[keeper.inStep[place]] <= least + PROGRESS_EPSILON);
  const limit = moment.limit(keeper.index);
  const most = Math.min(1, keeper.synchronization === "relative" ? least + limit : limit);
  const span = { least, most, slowest };
  moment.spans.set(keeper.index, span);
  return span;
}

function listed(places: number[], names: string[]): string {
  const first = names[places[0]], second = names[places[1]];
  if (places.length <= 2) return places.length === 1 ? first : `${first} and ${second}`;
  return `${first}, ${second} and ${places.length - 2} more`;
}

// As printf's %.6g of a barrier or delta.
export function short(value: number): string {
  return String(Number(value.toPrecision(6)));
}

function waitAtBarrier(moment: Moment, keeper: ShapeNode, node: number): Wait {
  const { least, slowest } = spanOf(moment, keeper);
  const whom = listed(slowest, keeper.names);
  const limit = moment.limit(keeper.index);
  const of = keeper.isGroup ? ` of '${keeper.segment}'` : "";
  let text = `waits for ${whom}`;
  if (keeper.synchronization === "relative") {
    text += `, ${(moment.progress[node] - least).toFixed(2)} ahead (delta ${limit}${of})`;
  } else if (Number.isFinite(limit)) {
    text += ` at barrier ${short(limit)}${of}`;
  }
  return { node, keeper: keeper.index, for: slowest.slice(0, FEW).map((place) => keeper.inStep[place]), text };
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

// The owner of each resource of a pool; null: it is free.
export function ownersOf(moment: Moment, pool: ShapeNode): { resource: string; place: number | null }[] {
  const found = pool.resources.map((resource) => ({ resource, place: null as number | null }));
  pool.inStep.forEach((node, place) => {
    const set = memberLimit(moment, node);
    if (set <= 0 || moment.status[node] !== RUNNING) return;
    found.forEach((one, bit) => {
      if (Math.floor(set / 2 ** bit) % 2 === 1) one.place = place;
    });
  });
  return found;
}

// "1;2 Socrates/…/eat, 3;4 Aristotle/…/eat"
export function ownersText(moment: Moment, pool: ShapeNode): string {
  const by = new Map<number, string[]>();
  for (const { resource, place } of ownersOf(moment, pool)) {
    if (place !== null) by.set(place, [...(by.get(place) ?? []), resource]);
  }
  return [...by].map(([place, resources]) => `${resources.join(";")} ${pool.names[place]}`).join(", ");
}

function waitForResources(moment: Moment, pool: ShapeNode, node: number): Wait {
  const wanted = new Set(resourcesIn(pool, memberLimit(moment, node)));
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

function isWaiting(moment: Moment, node: number): boolean {
  const { nodes } = moment.run.shape;
  const { keeper, parent } = nodes[node];
  if (keeper === null) return false;
  if (nodes[keeper].synchronization === "resources") return memberLimit(moment, node) < 0;
  // Under a parent that is held itself, the parent says what is waited for.
  return moment.held[node] === 1 && (parent === null || !moment.held[parent]);
}

export function waitOf(moment: Moment, node: number): Wait | null {
  if (!isWaiting(moment, node)) return null;
  const { nodes } = moment.run.shape;
  const keeper = nodes[nodes[node].keeper!];
  return keeper.synchronization === "resources"
    ? waitForResources(moment, keeper, node)
    : waitAtBarrier(moment, keeper, node);
}

// All that wait.
export function waiting(moment: Moment): number[] {
  return moment.run.shape.nodes.map((node) => node.index).filter((node) => isWaiting(moment, node));
}

// The barriers to draw: those that the header has, else the current one.
export function marksOf(moment: Moment, keeper: ShapeNode): number[] {
  if (keeper.barriers.length > 0) return keeper.barriers;
  const { most } = spanOf(moment, keeper);
  return most > 0 && keeper.synchronization !== "resources" ? [most] : [];
}

// Whether a mark is where children are held now.
export function isLimit(mark: number, most: number): boolean {
  return Math.abs(mark - most) < PROGRESS_EPSILON;
}
