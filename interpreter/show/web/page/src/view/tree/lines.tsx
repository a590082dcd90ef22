// The lines between the cards: edges, barriers through siblings, and arrows from a waiting node to the one that it waits for.
import type { Moment } from "../../model/moment";
import { IDLE } from "../../model/recording";
import { isLimit, marksOf, spanOf, waitOf } from "../../model/waiting";
import { PADDING } from "./card";
import { GAP_X, type Box, type Layout } from "./layout";

interface Props {
  moment: Moment;
  layout: Layout;
  boxes: Box[]; // those in sight
}

function edge(layout: Layout, parent: Box, child: Box): string {
  const y = child.y + child.height / 2;
  if (layout.arrangement === "outline") {
    return `M${parent.x + 8} ${parent.y + parent.height}V${y}H${child.x}`;
  }
  const x = child.x - GAP_X / 2 + 2;
  return `M${parent.x + parent.width} ${parent.y + parent.height / 2}H${x}V${y}H${child.x}`;
}

export function Edges({ moment, layout, boxes }: Props) {
  const { nodes } = moment.run.shape;
  const paths = new Map<number, { d: string; active: boolean }>();
  const add = (child: number) => {
    const parent = nodes[child].parent;
    const from = parent === null ? undefined : layout.at.get(parent);
    const to = layout.at.get(child);
    if (from && to) paths.set(child, { d: edge(layout, from, to), active: moment.status[child] !== IDLE });
  };
  for (const { node } of boxes) {
    add(node);
    const { children } = nodes[node];
    if (children.length === 0) continue;
    add(children[0]);
    add(children[children.length - 1]);
  }
  const activeLast = [...paths].sort((a, b) => Number(a[1].active) - Number(b[1].active));
  return (
    <g>{activeLast.map(([child, { d, active }]) => <path key={child} class={active ? "edge active" : "edge"} d={d} />)}</g>
  );
}

// Barriers go through all children of a node: behind the cards, so that they are seen between them.
export function BarrierLines({ moment, layout, boxes }: Props) {
  const { nodes } = moment.run.shape;
  const keepers = new Set<number>();
  for (const { node } of boxes) {
    const { keeper } = nodes[node];
    if (keeper !== null && !nodes[keeper].isGroup) keepers.add(keeper);
  }
  return <g>{[...keepers].map((keeper) => <Through key={keeper} moment={moment} layout={layout} keeper={keeper} />)}</g>;
}

function Through({ moment, layout, keeper }: { moment: Moment; layout: Layout; keeper: number }) {
  const it = moment.run.shape.nodes[keeper];
  const first = layout.at.get(it.inStep[0]), last = layout.at.get(it.inStep[it.inStep.length - 1]);
  if (layout.arrangement === "outline" || !first || !last || first === last) return null;
  const { most } = spanOf(moment, it);
  return (
    <>
      {marksOf(moment, it).slice(0, 20).map((mark) => {
        const x = first.x + PADDING + mark * (first.width - 2 * PADDING);
        const current = isLimit(mark, most);
        return (
          <line key={mark} class={current ? "through current" : "through"} x1={x} x2={x}
            y1={first.y - 4} y2={last.y + last.height + 4} />
        );
      })}
    </>
  );
}

// In front of siblings on their left, else from side to side.
function arrow(from: Box, to: Box): string {
  const y1 = from.y + from.height / 2, y2 = to.y + to.height / 2;
  const bend = 14 + Math.min(16, Math.abs(y2 - y1) / 20);
  const side = y2 < y1 ? 8 : -8; // beside the edges
  const left = Math.min(from.x, to.x) - bend;
  return `M${from.x} ${y1 - side}C${left} ${y1 - side} ${left} ${y2 + side} ${to.x - 2} ${y2 + side}`;
}

export function Arrows({ moment, layout, boxes }: Props) {
  const { nodes } = moment.run.shape;
  const paths: { text: string; d: string }[] = [];
  for (const from of boxes) {
    const wait = waitOf(moment, from.node);
    for (const other of wait?.for ?? []) {
      const to = layout.at.get(other);
      if (to) paths.push({ text: `${nodes[from.node].segment} ${wait?.text}`, d: arrow(from, to) });
    }
  }
  return (
    <g class="arrows">
      <defs>
        <marker id="head" viewBox="0 0 8 8" refX={6} refY={4} markerWidth={9} markerHeight={9}
          markerUnits="userSpaceOnUse" orient="auto">
          <path d="M0 0.5L7 4L0 7.5Z" />
        </marker>
      </defs>
      {paths.map(({ text, d }) => (
        <path key={d} class="arrow" d={d} marker-end="url(#head)"><title>{text}</title></path>
      ))}
    </g>
  );
}
