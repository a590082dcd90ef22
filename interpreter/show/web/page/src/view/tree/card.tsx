// A node of the tree, as it is drawn.
import { tallyBelow } from "../../model/folds";
import type { Moment } from "../../model/moment";
import { RUNNING } from "../../model/recording";
import type { ShapeNode } from "../../model/shape";
import { isShared, ownersOf, short } from "../../model/waiting";
import { kindText, labelOf, sentenceOf, stateOf, symbolOf } from "../../model/words";
import type { Store } from "../../store/store";
import { Bar, Race } from "../parts/bar";
import { fitted, fittedName, textWidth } from "../parts/measure";
import type { Box } from "./layout";

interface Props {
  store: Store;
  moment: Moment;
  box: Box;
  open: boolean;
  selected: boolean;
}

export const PADDING = 10;
const NOTE_GAP = 10;

export function cardId(node: number): string {
  return `node-${node}`;
}

export function Card({ store, moment, box, open, selected }: Props) {
  const node = moment.run.shape.nodes[box.node];
  const isInner = node.children.length > 0;
  const comparing = node.synchronization !== null && node.synchronization !== "resources";
  const bar = node.keeper !== null || comparing ? 8 : 4;
  const place = { x: PADDING, y: box.height - bar - 7, width: box.width - 2 * PADDING, height: bar };
  return (
    <g id={cardId(box.node)} role="treeitem" aria-label={labelOf(moment, box.node)} aria-level={node.depth + 1}
      aria-selected={selected} {...(isInner ? { "aria-expanded": open } : {})}
      class={`card ${stateOf(moment, box.node)}${selected ? " selected" : ""}`}
      transform={`translate(${box.x} ${box.y})`}
      onClick={() => store.select(box.node)} onDblClick={() => isInner && store.fold(box.node, !open)}>
      <g aria-hidden="true">
        <rect class="box" width={box.width} height={box.height} rx={6} />
        <rect class="stripe" width={4} height={box.height} rx={2} />
        <First moment={moment} box={box} />
        <Second moment={moment} box={box} open={open} />
        {comparing && <Race moment={moment} node={box.node} place={place} />}
        {node.synchronization === null && <Bar moment={moment} node={box.node} place={place} />}
        {hasBreakpoint(store, box.node) && <circle class="stop" cx={2} cy={box.height / 2} r={5}><title>a breakpoint</title></circle>}
        {isInner && <Fold store={store} box={box} open={open} name={node.segment} />}
      </g>
    </g>
  );
}

function hasBreakpoint({ live }: Store, node: number): boolean {
  return live?.state.breakpoints?.some((one) => one.node === node) ?? false;
}

function First({ moment, box }: { moment: Moment; box: Box }) {
  const { segment } = moment.run.shape.nodes[box.node];
  const number = numberText(moment, box.node);
  const room = box.width - 2 * PADDING - 17 - textWidth(number, 12) - 6;
  return (
    <>
      <text class="symbol" x={PADDING} y={17}>{symbolOf(moment, box.node)}</text>
      <text class="name" x={PADDING + 17} y={17}>{fittedName(segment, 13, room, 600)}</text>
      <text class="number" x={box.width - PADDING} y={17} text-anchor="end">{number}</text>
    </>
  );
}

// Its progress; of a pool, how much of it is free, or belongs to this one of the robots that share it.
function numberText(moment: Moment, index: number): string {
  const node = moment.run.shape.nodes[index];
  const factor = moment.factor(index);
  const slowed = factor === 1 ? "" : ` ×${factor.toFixed(2)}`;
  if (node.synchronization !== "resources") return moment.progress[index].toFixed(2) + slowed;
  const free = ownersOf(moment, node).filter(({ place }) => place === null).length, all = node.resources.length;
  return isShared(moment, node) ? `owns ${all - free} of ${all}` : `${free} of ${all} free`;
}

// Why it waits, else its kind and its round; what a folded node hides.
function Second({ moment, box, open }: { moment: Moment; box: Box; open: boolean }) {
  const node = moment.run.shape.nodes[box.node];
  const sentence = sentenceOf(moment, box.node);
  const right = rightText(moment, box.node, open);
  const isLimit = node.synchronization !== null && open;
  const room = box.width - 2 * PADDING - (right ? textWidth(right, 11, isLimit ? 600 : 400) + NOTE_GAP : 0);
  return (
    <>
      <text class={sentence ? "sentence" : "kind"} x={PADDING} y={30}>
        {fitted(sentence || kindText(node.kind, node.segment), 11, room, sentence ? 600 : 400)}
      </text>
      {right && <text class={isLimit ? "limit" : "kind"} x={box.width - PADDING} y={30} text-anchor="end">{right}</text>}
    </>
  );
}

function rightText(moment: Moment, index: number, open: boolean): string {
  const node = moment.run.shape.nodes[index];
  if (node.children.length === 0 || open) return limitText(moment, node) || roundText(moment, index);
  const { held, by } = tallyBelow(moment, index);
  const parts = [by[1] > 0 ? `▶${by[1]}` : "", held > 0 ? `‖${held}` : "", by[3] > 0 ? `✗${by[3]}` : ""];
  return [`+${node.end - index - 1}`, ...parts.filter(Boolean)].join(" ");
}

function roundText(moment: Moment, index: number): string {
  return moment.round(index) && `round ${moment.round(index)}`;
}

// Where those that it holds wait now.
function limitText(moment: Moment, node: ShapeNode): string {
  const limit = moment.limit(node.index);
  if (moment.status[node.index] !== RUNNING) return "";
  if (node.synchronization === "relative") return `delta ${short(limit)}`;
  if (node.synchronization !== "absolute") return "";
  return Number.isFinite(limit) ? `barrier ${short(limit)}` : "no barrier left";
}

function Fold({ store, box, open, name }: { store: Store; box: Box; open: boolean; name: string }) {
  const turn = (event: Event) => {
    event.stopPropagation();
    store.fold(box.node, !open);
  };
  return (
    <g class="fold" transform={`translate(${box.width} ${box.height / 2})`} onClick={turn}>
      <title>{`${open ? "fold" : "unfold"} ${name}`}</title>
      <circle class="touch" r={14} />
      <circle r={7} />
      <path d={open ? "M-3.5 0H3.5" : "M-3.5 0H3.5M0 -3.5V3.5"} />
    </g>
  );
}
