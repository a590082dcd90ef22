// The tree: only what is in sight is drawn; what runs, or has decided, is kept in sight.
import { useEffect, useMemo, useRef } from "preact/hooks";
import { decidingPath } from "../../model/decision";
import { isOpen, shownNodes } from "../../model/folds";
import type { Moment } from "../../model/moment";
import { RUNNING } from "../../model/recording";
import type { Looking, Store } from "../../store/store";
import { Card, cardId } from "./card";
import { treeKey } from "./keys";
import { useHand } from "./hand";
import { layOut, type Layout } from "./layout";
import { Arrows, BarrierLines, Edges } from "./lines";
import { extentOf, scrollTo, withAbove } from "./scroll";
import { inSight, useSight } from "./sight";

// The same array as long as the same nodes are shown.
function useShown(moment: Moment, looking: Looking): number[] {
  const before = useRef<number[]>([]);
  const shown = shownNodes(moment, looking.folds, looking.onlyActive);
  const old = before.current;
  if (shown.length === old.length && shown.every((node, place) => node === old[place])) return old;
  return (before.current = shown);
}

// The innermost nodes that run, of those that are shown.
function innermostRunning(moment: Moment, layout: Layout): number[] {
  const { nodes } = moment.run.shape;
  const running = layout.boxes.map((box) => box.node).filter((node) => moment.status[node] === RUNNING && !nodes[node].isGroup);
  const above = new Set(running.map((node) => nodes[node].parent));
  return running.filter((node) => !above.has(node));
}

// At the end: the node that decided.
function followedNodes(moment: Moment, layout: Layout): number[] {
  const decision = decidingPath(moment);
  return decision.length > 0 ? [decision[decision.length - 1].node] : innermostRunning(moment, layout);
}

export function Tree({ store, looking }: { store: Store; looking: Looking }) {
  const { moment } = store;
  const { selected } = looking;
  const [sight, scroller, look] = useSight();
  const shown = useShown(moment, looking);
  const room = looking.arrangement === "outline" ? Math.max(240, sight.width / (looking.zoom ?? 1)) : 0;
  const layout = useMemo(() => layOut(store.run.shape, shown, looking.arrangement, room),
    [store.run.shape, shown, looking.arrangement, room]);
  const zoom = (store.scale = looking.zoom ?? Math.min(1, sight.width / layout.width, sight.height / layout.height) * 0.995);
  useEffect(() => {
    if (looking.arrangement !== "diagram" || !scroller.current) return;
    const fits = scroller.current.clientWidth / layout.width;
    if (fits < 1) store.set({ zoom: Math.max(fits, 0.85) });
  }, [store.run.shape]);
  const hand = useHand(store, scroller);
  const boxes = inSight(layout, sight, zoom);
  const running = looking.follow ? followedNodes(moment, layout) : [];
  const followed = `${running.length} ${running.slice(0, 50).join()}`;

  useEffect(() => {
    const it = scroller.current;
    if (it) scrollTo(it, withAbove(store.run.shape, layout, running, it.clientWidth / zoom, it.clientHeight / zoom), zoom);
  }, [followed, layout, zoom]);
  useEffect(() => {
    if (scroller.current && selected !== null) scrollTo(scroller.current, extentOf(layout, [selected]), zoom);
  }, [selected]);

  return (
    <div class="tree" ref={scroller} onScroll={look} {...hand.onPointer}>
      <svg role="tree" aria-label="Behavior tree" tabindex={0} width={layout.width * zoom} height={layout.height * zoom}
        viewBox={`0 0 ${layout.width} ${layout.height}`}
        aria-activedescendant={selected === null ? undefined : cardId(selected)}
        onKeyDown={(event) => hand.onKeyDown(event) || treeKey(store, shown, event)}>
        <g aria-hidden="true">
          <Edges moment={moment} layout={layout} boxes={boxes} />
          <BarrierLines moment={moment} layout={layout} boxes={boxes} />
        </g>
        {boxes.map((box) => (
          <Card key={box.node} store={store} moment={moment} box={box} selected={selected === box.node}
            open={isOpen(moment, looking.folds, looking.onlyActive, box.node)} />
        ))}
        <g aria-hidden="true"><Arrows moment={moment} layout={layout} boxes={boxes} /></g>
      </svg>
    </div>
  );
}
