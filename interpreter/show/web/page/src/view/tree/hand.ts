// The tree under the hand: a drag, or the arrow keys with Shift, pan it, the wheel makes it larger or smaller around the pointer. In an outline the wheel
// scrolls, as in any list.
import type { RefObject } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Store } from "../../store/store";

const ARROWS: Record<string, [number, number]> = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
const STEP = 80; // pixels
const LEAST = 4; // pixels of a drag; less is a click

export function useHand(store: Store, scroller: RefObject<HTMLDivElement | null>) {
  const aim = useRef<{ x: number; y: number; scale: number } | null>(null); // what stays under the pointer
  const { scale } = store;
  useLayoutEffect(() => {
    const it = scroller.current, at = aim.current;
    aim.current = null;
    if (!it || !at) return;
    const by = scale / at.scale;
    it.scrollTo({ left: (it.scrollLeft + at.x) * by - at.x, top: (it.scrollTop + at.y) * by - at.y, behavior: "instant" });
  }, [scale]);

  const wheel = (event: WheelEvent) => {
    store.letGo();
    const zooms = event.ctrlKey || event.metaKey || (store.looking.arrangement === "diagram" && !event.shiftKey);
    if (!zooms) return;
    event.preventDefault();
    const { left, top } = scroller.current!.getBoundingClientRect();
    aim.current = { x: event.clientX - left, y: event.clientY - top, scale: store.scale };
    const pixels = event.deltaMode === 0 ? event.deltaY : event.deltaY * 30;
    store.magnify(Math.exp(-Math.max(-120, Math.min(120, pixels)) / 500));
  };

  // A finger scrolls already.
  const down = (event: PointerEvent) => {
    const it = scroller.current;
    if (!it || event.pointerType === "touch" || event.button !== 0) return;
    const { scrollLeft, scrollTop } = it;
    let drags = false;
    const move = ({ clientX, clientY }: PointerEvent) => {
      const x = clientX - event.clientX, y = clientY - event.clientY;
      if (!drags && Math.hypot(x, y) < LEAST) return;
      if (!drags) {
        drags = true;
        it.classList.add("dragged");
        store.letGo();
      }
      it.scrollTo({ left: scrollLeft - x, top: scrollTop - y, behavior: "instant" });
    };
    const up = () => {
      removeEventListener("pointermove", move);
      it.classList.remove("dragged");
      if (!drags) return;
      const noClick = (click: Event) => click.stopPropagation();
      it.addEventListener("click", noClick, { capture: true, once: true });
      setTimeout(() => it.removeEventListener("click", noClick, { capture: true }));
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up, { once: true });
  };
  // With Shift; without, the arrow keys go to another node. True: it was one of these.
  const key = (event: KeyboardEvent): boolean => {
    const [x, y] = ARROWS[event.key] ?? [];
    if (!event.shiftKey || x === undefined) return false;
    event.preventDefault();
    event.stopPropagation();
    store.letGo();
    scroller.current?.scrollBy({ left: x * STEP, top: y * STEP, behavior: "instant" });
    return true;
  };
  return { onPointer: { onWheel: wheel, onPointerDown: down, onTouchMove: () => store.letGo() }, onKeyDown: key };
}
