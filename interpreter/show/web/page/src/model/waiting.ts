// Finds which node waits for which, and where: the same sentences as those of `lockstep replay`.
import type { Moment, Span } from "./moment";
import { reasonOf } from "./reasons";
import { FAILURE, IDLE, PROGRESS_EPSILON, RUNNING, SKIPPED } from "./recording";
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
  if (moment.run.shape.nodes[child].isRobot) return false; // one that has not begun counts 0
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

// What was heard last of another robot: "heard at 0.24, 0.02 s ago".
export function heardText(moment: Moment, robot: number): string {
  const silence = moment.silence(robot);
  return silence === null ? "" : `heard at ${moment.progress[robot].toFixed(2)}, ${silence.toFixed(2)} s ago`;
}

// While a robot cannot be relied on, all others are held, wherever they are.
function waitForRobot(moment: Moment, keeper: ShapeNode, node: number): Wait | null {
  const lost = [...keeper.inStep.keys()].filter((place) =>
    moment.run.shape.nodes[keeper.inStep[place]].isRobot && moment.status[keeper.inStep[place]] === FAILURE);
  if (lost.length === 0) return null;
  const first = keeper.inStep[lost[0]], whom = listed(lost, keeper.names);
  const last = heardText(moment, first);
  const why = [reasonOf(moment, first), last && `(${last})`].filter((text) => text).join(" ");
  return { node, keeper: keeper.index, for: lost.slice(0, FEW).map((place) => keeper.inStep[place]),
    text: `waits for ${whom}${why ? `: ${why}` : ""}` };
}

function waitAtBarrier(moment: Moment, keeper: ShapeNode, node: number): Wait {
  const lost = waitForRobot(moment, keeper, node);
  if (lost) return lost;
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
  const robot = slowest.map((place) => keeper.inStep[place]).find((other) => moment.run.shape.nodes[other].isRobot);
  if (robot !== undefined && heardText(moment, robot)) text += ` (${heardText(moment, robot)})`;
  return { node, keeper: keeper.index, for: slowest.slice(0, FEW).map((place) => keeper.inStep[place]), text };
}

// How fast a node is that another one paces, and why: "at 0.50 of its speed, to be at 0.5 with arm".
export function paceText(moment: Moment, node: number): string {
  const factor = moment.factor(node);
  const { keeper: index } = moment.run.shape.nodes[node];
  if (factor === 1 || index === null) return "";
  const keeper = moment.run.shape.nodes[index];
  const text = `at ${factor.toFixed(2)} of its speed`;
  const { slowest } = spanOf(moment, keeper);
  const others = slowest.filter((place) => keeper.inStep[place] !== node);
  if (others.length === 0) return text;
  const limit = moment.limit(index), whom = listed(others, keeper.names);
  return keeper.synchronization === "absolute" && Number.isFinite(limit)
    ? `${text}, to be at ${short(limit)} with ${whom}` : `${text}, to stay with ${whom}`;
}

// What a member of a barrier at 0 waits for: the members that no tick has reached.
function waitToBegin(moment: Moment, keeper: ShapeNode, node: number): Wait {
  const late = [...keeper.inStep.keys()].filter((place) =>
    moment.progress[keeper.inStep[place]] === 0 && moment.status[keeper.inStep[place] - 1] !== RUNNING &&
    !isLeftOut(moment, keeper, keeper.inStep[place]));
  const whom = late.length > 0 ? listed(late, keeper.names) : "the other members";
  const text = `waits to begin together with ${whom}, of '${keeper.segment}'`;
  return { node, keeper: keeper.index, for: late.slice(0, FEW).map((place) => keeper.inStep[place]), text };
}

function waitsToBegin(moment: Moment, keeper: ShapeNode, node: number): boolean {
  return keeper.isGroup && moment.status[node] === IDLE && moment.status[node - 1] === RUNNING;
}

// The limit of a member has a set that it owns, or below 0 one that it waits for; or both, as recording.md packs them.
const BOTH = 2 ** 52, SHIFT = 2 ** 26;
function ownedIn(limit: number): number {
  if (limit >= 0) return limit;
  return -limit < BOTH ? 0 : Math.floor((-limit - BOTH) / SHIFT);
}
function wantedIn(limit: number): number {
  if (limit >= 0) return 0;
  return -limit < BOTH ? -limit : -limit % SHIFT;
}

// Sets of resources are sums of powers of two, up to 2^50.
function has(set: number, bit: number): boolean {
  return Math.floor(set / 2 ** bit) % 2 === 1;
}
function resourcesIn(pool: ShapeNode, set: number): string[] {
  return pool.resources.filter((_, bit) => has(set, bit));
}

// The limit of a member is that of the UseResources node above it.
function memberLimit(moment: Moment, child: number): number {
  return moment.limit(child - 1);
}

// The leaf that asks other robots for what a member needs, behind its child; null: they do not share the pool.
function askerOf(moment: Moment, child: number): number | null {
  const { nodes } = moment.run.shape;
  const asker = nodes[child].end;
  return asker < nodes[child - 1].end ? asker : null;
}
export function isShared(moment: Moment, pool: ShapeNode): boolean {
  return pool.inStep.some((child) => askerOf(moment, child) !== null);
}

export function owned(moment: Moment, pool: ShapeNode, node: number): string {
  const set = ownedIn(memberLimit(moment, node));
  return set > 0 ? `owns ${resourcesIn(pool, set).join(";")}` : "";
}

// The owner of each resource of a pool; null: it is free, or a robot may have it that shares the pool.
export function ownersOf(moment: Moment, pool: ShapeNode): { resource: string; place: number | null }[] {
  const found = pool.resources.map((resource) => ({ resource, place: null as number | null }));
  pool.inStep.forEach((node, place) => {
    // One that has not begun may own what it has taken over.
    const set = ownedIn(memberLimit(moment, node));
    if (set === 0 || (moment.status[node] !== RUNNING && moment.status[node - 1] !== RUNNING)) return;
    found.forEach((one, bit) => {
      if (has(set, bit)) one.place = place;
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
  const own = owned(moment, pool, node);
  const kept = resourcesIn(pool, ownedIn(memberLimit(moment, node)));
  const wanted = resourcesIn(pool, wantedIn(memberLimit(moment, node))).filter((name) => !kept.includes(name));
  const owners: number[] = [], parts: string[] = [];
  pool.inStep.forEach((other, place) => {
    const shared = resourcesIn(pool, ownedIn(memberLimit(moment, other))).filter((name) => wanted.includes(name));
    if (shared.length === 0) return;
    owners.push(other);
    parts.push(`${shared.join(";")} (${pool.names[place]})`);
  });
  const asker = askerOf(moment, node);
  const why = asker === null ? "" : reasonOf(moment, asker);
  const what = parts.length > 0 ? parts.join(", ") : wanted.join(";");
  const waits = what ? `waits for ${what}${why ? `: ${why}` : ""}` : "";
  return { node, keeper: pool.index, for: owners, text: [own, waits].filter((part) => part).join(", ") };
}

function isWaiting(moment: Moment, node: number): boolean {
  const { nodes } = moment.run.shape;
  const { keeper, parent } = nodes[node];
  if (keeper === null) return false;
  if (nodes[keeper].synchronization === "resources") return memberLimit(moment, node) < 0;
  if (waitsToBegin(moment, nodes[keeper], node)) return moment.held[node - 1] !== 1;
  // Under a parent that is held itself, the parent says what is waited for.
  return moment.held[node] === 1 && (parent === null || !moment.held[parent]);
}

export function waitOf(moment: Moment, node: number): Wait | null {
  if (!isWaiting(moment, node)) return null;
  const { nodes } = moment.run.shape;
  const keeper = nodes[nodes[node].keeper!];
  if (keeper.synchronization === "resources") return waitForResources(moment, keeper, node);
  return waitsToBegin(moment, keeper, node) ? waitToBegin(moment, keeper, node) : waitAtBarrier(moment, keeper, node);
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
