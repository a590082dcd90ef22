// The part of a run that does not change: the nodes, which node holds which, how they are drawn.
import type { Header, HeaderNode } from "./recording";

type Synchronization = "absolute" | "relative" | "resources" | null;

export interface ShapeNode {
  index: number;
  path: string;
  segment: string; // the last of its path
  apart: string; // as much of the path as tells it from all others
  kind: string;
  parent: number | null;
  depth: number;
  children: number[];
  end: number; // behind the last node below it
  synchronization: Synchronization;
  barriers: number[]; // empty where an entry gives them
  resources: string[];
  inStep: number[]; // synchronized: the nodes that it holds
  names: string[]; // what it calls them
  ignoresIdle: boolean;
  keeper: number | null; // the synchronized node that holds this one
  isGroup: boolean; // a barrier or a pool beside the tree
  isGuard: boolean;
  isRobot: boolean; // it stands for another robot of a team
}

export interface Shape {
  nodes: ShapeNode[];
  roots: number[]; // the tree, then what is beside it
  byPath: ReadonlyMap<string, number>;
}

function synchronizationOf(node: HeaderNode): Synchronization {
  if (node.barriers !== undefined) return "absolute";
  if (node.delta !== undefined) return "relative";
  return node.resources ? "resources" : null;
}

// The least end of each path that no other has: "approach/DriveTo", "left/…/lift".
function namesApart(paths: string[]): string[] {
  const parts = paths.map((path) => path.split("/"));
  const names: string[] = new Array(paths.length);
  let open = paths.map((_, place) => place);
  for (let count = 1; open.length > 0; ++count) {
    const ends = new Map<string, number>();
    const endOf = (place: number) => parts[place].slice(-count).join("/");
    for (const place of open) ends.set(endOf(place), (ends.get(endOf(place)) ?? 0) + 1);
    open = open.filter((place) => {
      const alone = ends.get(endOf(place)) === 1 || count >= parts[place].length;
      if (alone) names[place] = withoutMiddle(parts[place].slice(-count));
      return !alone;
    });
  }
  return names;
}

function withoutMiddle(segments: string[]): string {
  return segments.length <= 2 ? segments.join("/") : `${segments[0]}/…/${segments[segments.length - 1]}`;
}

// "left/lift" where "lift" alone is the name of several; "left/…/lift" leaves out what is between.
function shortNames(paths: string[]): string[] {
  const parts = paths.map((path) => path.split("/"));
  const names = parts.map((segments, i) => {
    for (let count = 1; count < segments.length; ++count) {
      const end = segments.slice(-count).join("/");
      const same = parts.filter((other) => other.slice(-count).join("/") === end);
      if (same.length > 1) continue;
      return withoutMiddle(segments.slice(-count));
    }
    return paths[i];
  });
  return new Set(names).size === names.length ? names : paths;
}

export function shapeOf(header: Header): Shape {
  const apart = namesApart(header.nodes.map((node) => node.path));
  const nodes: ShapeNode[] = header.nodes.map((node) => ({
    apart: apart[node.index],
    index: node.index,
    path: node.path,
    segment: node.path.slice(node.path.lastIndexOf("/") + 1),
    kind: node.kind,
    parent: node.parent,
    depth: 0,
    children: [],
    end: node.index + 1,
    synchronization: synchronizationOf(node),
    barriers: node.barriers ?? [],
    resources: node.resources ?? [],
    inStep: [],
    names: [],
    ignoresIdle: node.idle === "ignore",
    keeper: null,
    isGroup: node.parent === null && node.index > 0,
    isGuard: node.guard === true,
    isRobot: node.kind === "TeamMember",
  }));
  for (const node of nodes) {
    if (node.parent === null) continue;
    node.depth = nodes[node.parent].depth + 1;
    nodes[node.parent].children.push(node.index);
  }
  for (let index = nodes.length; index-- > 0; ) {
    const { parent, end } = nodes[index];
    if (parent !== null) nodes[parent].end = Math.max(nodes[parent].end, end);
  }
  for (const node of nodes) {
    if (!node.synchronization) continue;
    const members = header.nodes[node.index].members;
    node.inStep = members ?? node.children;
    const calls = node.inStep.map((child) => nodes[child]);
    node.names = members
      ? shortNames(calls.map((child) => child.path.slice(child.path.indexOf("/") + 1)))
      : calls.map((child) => child.segment);
    for (const child of calls) child.keeper = node.index;
  }
  return {
    nodes, roots: nodes.filter((node) => node.parent === null).map((node) => node.index),
    byPath: new Map(nodes.map(({ path, index }) => [path, index])),
  };
}
