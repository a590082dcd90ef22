// The tree: only what is in sight is drawn; what runs is kept in sight.
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { isOpen, shownNodes } from "../../model/folds";
import type { Moment } from "../../model/moment";
import { RUNNING } from "../../model/recording";
import type { Looking, Store } from "../store";
import { Card, cardId } from "./card";
import { treeKey } from "./keys";
import { layOut, type Box, type Layout } from "./layout";
import { Arrows, BarrierLines, Edges } from "./lines";

interface Sight {
  x: number;
  y: number;
  width: number;
  height: number;
}

const BEYOND = 240; // is drawn already

// The same array as long as the same nodes are shown.
function useShown(moment: Moment, looking: Looking): number[] {
  const before = useRef<number[]>([]);
  const shown = shownNodes(moment, looking.folds, looking.onlyActive);
  const old = before.current;
  if (shown.length === old.length && shown.every((node, place) => node === old[place])) return old;
  return (before.current = shown);
}

function useSight(): [Sight, preact.RefObject<HTMLDivElement | null>, () => void] {
  const scroller = useRef<HTMLDivElement>(null);
  const [sight, setSight] = useState<Sight>({ x: 0, y: 0, width: 800, height: 600 });
  const look = () => {
    const it = scroller.current;
    if (it) setSight({ x: it.scrollLeft, y: it.scrollTop, width: it.clientWidth, height: it.clientHeight });
  };
  useLayoutEffect(() => {
    look();
    const observer = new ResizeObserver(look);
    if (scroller.current) observer.observe(scroller.current);
    return () => observer.disconnect();
  }, []);
  return [sight, scroller, look];
}

function inSight(layout: Layout, sight: Sight, zoom: number): Box[] {
  const left = sight.x / zoom - BEYOND, right = (sight.x + sight.width) / zoom + BEYOND;
  const top = sight.y / zoom - BEYOND, bottom = (sight.y + sight.height) / zoom + BEYOND;
  return layout.boxes.filter(
    (box) => box.x < right && box.x + box.width > left && box.y < bottom && box.y + box.height > top);
}

// The innermost nodes that run, of those that are shown.
function innermostRunning(moment: Moment, layout: Layout): number[] {
  const { nodes } = moment.run.shape;
  const running = layout.boxes.map((box) => box.node).filter((node) => moment.status[node] === RUNNING);
  const above = new Set(running.map((node) => nodes[node].parent));
  return running.filter((node) => !above.has(node));
}

interface Extent {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

function extentOf(layout: Layout, nodes: Iterable<number>): Extent | null {
  const extent = { left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity };
  for (const node of nodes) {
    const box = layout.at.get(node);
    if (!box) continue;
    extent.left = Math.min(extent.left, box.x);
    extent.right = Math.max(extent.right, box.x + box.width);
    extent.top = Math.min(extent.top, box.y);
    extent.bottom = Math.max(extent.bottom, box.y + box.height);
  }
  return extent.left === Infinity ? null : extent;
}

// With as many of the nodes above them as there is room for.
function withAbove(store: Store, layout: Layout, wanted: number[], width: number, height: number): Extent | null {
  const { nodes } = store.run.shape;
  const all = new Set(wanted);
  let extent = extentOf(layout, all);
  for (let rows = new Set(wanted); extent && rows.size > 0; ) {
    rows = new Set([...rows].map((node) => nodes[node].parent).filter((parent) => parent !== null));
    for (const node of rows) all.add(node);
    const more = extentOf(layout, all);
    if (!more || more.right - more.left > width || more.bottom - more.top > height) break;
    extent = more;
  }
  return extent;
}

function scrollTo(scroller: HTMLDivElement, extent: Extent | null, zoom: number) {
  if (!extent) return;
  const fit = (low: number, high: number, at: number, size: number) => {
    if (low * zoom >= at + 4 && high * zoom <= at + size - 4) return at;
    if ((high - low) * zoom > size) high = low + size / zoom;
    return Math.max(0, ((low + high) / 2) * zoom - size / 2);
  };
  const x = fit(extent.left, extent.right, scroller.scrollLeft, scroller.clientWidth);
  const y = fit(extent.top, extent.bottom, scroller.scrollTop, scroller.clientHeight);
  if (x !== scroller.scrollLeft || y !== scroller.scrollTop) scroller.scrollTo({ left: x, top: y });
}

export function Tree({ store, looking }: { store: Store; looking: Looking }) {
  const { moment } = store;
  const { zoom, selected } = looking;
  const [sight, scroller, look] = useSight();
  const shown = useShown(moment, looking);
  const room = looking.arrangement === "outline" ? Math.max(240, sight.width / zoom) : 0;
  const layout = useMemo(() => layOut(store.run.shape, shown, looking.arrangement, room),
    [store.run.shape, shown, looking.arrangement, room]);
  useEffect(() => {
    if (looking.arrangement !== "diagram" || !scroller.current) return;
    const fits = scroller.current.clientWidth / layout.width;
    if (fits < 1) store.set({ zoom: Math.max(fits, 0.85) });
  }, [store.run.shape]);
  const boxes = inSight(layout, sight, zoom);
  const running = looking.follow ? innermostRunning(moment, layout) : [];
  const followed = running.join();

  useEffect(() => {
    const it = scroller.current;
    if (it) scrollTo(it, withAbove(store, layout, running, it.clientWidth / zoom, it.clientHeight / zoom), zoom);
  }, [followed, layout, zoom]);
  useEffect(() => {
    if (scroller.current && selected !== null) scrollTo(scroller.current, extentOf(layout, [selected]), zoom);
  }, [selected]);

  const letGo = () => looking.follow && store.set({ follow: false });
  return (
    <div class="tree" ref={scroller} onScroll={look} onWheel={letGo} onTouchMove={letGo}>
      <svg role="tree" aria-label="Behavior tree" tabindex={0} width={layout.width * zoom} height={layout.height * zoom}
        viewBox={`0 0 ${layout.width} ${layout.height}`}
        aria-activedescendant={selected === null ? undefined : cardId(selected)}
        onKeyDown={(event) => treeKey(store, shown, event)}>
        <g aria-hidden="true">
          <Edges moment={moment} layout={layout} boxes={boxes} />
          <BarrierLines moment={moment} layout={layout} boxes={boxes} />
        </g>
        {boxes.map((box) => (
          <Card key={box.node} store={store} moment={moment} box={box} selected={selected === box.node}
            open={isOpen(moment, looking.folds, looking.onlyActive, box.node)} />
        ))}
        <g aria-hidden="true"><Arrows moment={moment} layout={layout} /></g>
      </svg>
    </div>
  );
}
