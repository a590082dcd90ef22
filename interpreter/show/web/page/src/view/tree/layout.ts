// Where each shown node stands: a diagram that grows to the right, or an indented outline.
import { flextree } from "d3-flextree";
import type { Shape, ShapeNode } from "../../model/shape";
import { kindText } from "../../model/words";
import type { Arrangement } from "../../store/store";
import { textWidth } from "../parts/measure";

export interface Box {
  node: number;
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Layout {
  boxes: Box[]; // in pre-order
  at: Map<number, Box>;
  width: number;
  height: number;
  arrangement: Arrangement;
}

export const GAP_X = 36;
const MARGIN = 16, GAP_Y = 10, INDENT = 18;
const WIDEST = 260, NARROWEST = 106, KEPT = 216, POOL = 420; // with its owners
const LONGEST_NOTE = "no barrier left";
const HEIGHT = 47, KEPT_HEIGHT = 54;

function isInStep(node: ShapeNode): boolean {
  return node.keeper !== null || node.synchronization !== null;
}

// Its card also says where its children wait now.
function comparesProgress(node: ShapeNode): boolean {
  return node.synchronization === "absolute" || node.synchronization === "relative";
}

function ownWidth(node: ShapeNode): number {
  const name = textWidth(node.segment, 13, 600) + 70;
  const note = comparesProgress(node) ? textWidth(LONGEST_NOTE, 11, 600) + 34 : 62;
  const kind = textWidth(kindText(node.kind, node.segment), 11) + note;
  if (node.synchronization === "resources") return POOL;
  return Math.ceil(Math.min(WIDEST, Math.max(isInStep(node) ? KEPT : NARROWEST, name, kind)));
}

function cardHeight(node: ShapeNode): number {
  if (node.synchronization === "resources") return HEIGHT;
  return isInStep(node) ? KEPT_HEIGHT : HEIGHT;
}

// Siblings are equally wide, so that their bars can be compared. What is beside the tree has none.
function familyOf(node: ShapeNode): number | null {
  return node.isGroup ? -node.index : node.parent;
}

function familyWidths(shape: Shape, shown: number[]): Map<number | null, number> {
  const widths = new Map<number | null, number>();
  for (const index of shown) {
    const node = shape.nodes[index], family = familyOf(node);
    widths.set(family, Math.max(widths.get(family) ?? 0, ownWidth(node)));
  }
  return widths;
}

function diagram(shape: Shape, shown: number[]): Layout {
  const visible = new Set(shown);
  const widths = familyWidths(shape, shown);
  const sizeOf = (index: number): [number, number] => {
    const node = shape.nodes[index];
    return [cardHeight(node) + GAP_Y, (widths.get(familyOf(node)) ?? NARROWEST) + GAP_X];
  };
  const layout = flextree<number>({
    children: (index) => shape.nodes[index].children.filter((child) => visible.has(child)),
    nodeSize: (node) => sizeOf(node.data),
  });
  const boxes: Box[] = [];
  let top = MARGIN;
  for (const root of shape.roots) {
    const placed: Box[] = [];
    let least = Infinity, most = -Infinity;
    layout(layout.hierarchy(root)).each((at) => {
      const [height, across] = sizeOf(at.data);
      const y = at.x - height / 2;
      least = Math.min(least, y);
      most = Math.max(most, y + height);
      placed.push({ node: at.data, x: MARGIN + at.y, y, width: across - GAP_X, height: height - GAP_Y });
    });
    for (const box of placed) boxes.push({ ...box, y: box.y - least + top });
    top += most - least + GAP_Y;
  }
  return finished(boxes, "diagram");
}

function outline(shape: Shape, shown: number[], room: number): Layout {
  let y = 8;
  const boxes = shown.map((index): Box => {
    const node = shape.nodes[index];
    const x = 8 + Math.min(node.depth * INDENT, room * 0.4);
    const height = cardHeight(node);
    const box = { node: index, x, y, width: Math.max(140, room - x - 22), height };
    y += height + 6;
    return box;
  });
  return finished(boxes, "outline");
}

function finished(boxes: Box[], arrangement: Arrangement): Layout {
  boxes.sort((a, b) => a.node - b.node);
  let width = 0, height = 0;
  for (const box of boxes) {
    width = Math.max(width, box.x + box.width + MARGIN);
    height = Math.max(height, box.y + box.height + MARGIN);
  }
  return { boxes, at: new Map(boxes.map((box) => [box.node, box])), width, height, arrangement };
}

export function layOut(shape: Shape, shown: number[], arrangement: Arrangement, room: number): Layout {
  return arrangement === "outline" ? outline(shape, shown, room) : diagram(shape, shown);
}
