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
export function innermostRunning(moment: Moment, layout: Layout): number[] {
  const { nodes } = moment.run.shape;
  const running = layout.boxes.map((box) => box.node).filter((node) => moment.status[node] === RUNNING);
  const above = new Set(running.map((node) => nodes[node].parent));
  return running.filter((node) => !above.has(node));
}

function scrollTo(scroller: HTMLDivElement, layout: Layout, wanted: number[], zoom: number) {
  const boxes = wanted.map((node) => layout.at.get(node)).filter((box) => box !== undefined);
  if (boxes.length === 0) return;
  const fit = (low: number, high: number, at: number, size: number) => {
    if (low * zoom >= at + 4 && high * zoom <= at + size - 4) return at;
    if ((high - low) * zoom > size) high = low + size / zoom;
    return Math.max(0, ((low + high) / 2) * zoom - size / 2);
  };
  const x = fit(Math.min(...boxes.map((box) => box.x)), Math.max(...boxes.map((box) => box.x + box.width)),
    scroller.scrollLeft, scroller.clientWidth);
  const y = fit(Math.min(...boxes.map((box) => box.y)), Math.max(...boxes.map((box) => box.y + box.height)),
    scroller.scrollTop, scroller.clientHeight);
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
  const boxes = inSight(layout, sight, zoom);
  const running = looking.follow ? innermostRunning(moment, layout) : [];
  const followed = running.join();

  useEffect(() => {
    if (scroller.current && running.length > 0) scrollTo(scroller.current, layout, running, zoom);
  }, [followed, layout, zoom]);
  useEffect(() => {
    if (scroller.current && selected !== null) scrollTo(scroller.current, layout, [selected], zoom);
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
