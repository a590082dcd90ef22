// The upper edge of the timeline: dragged, or moved with the arrow keys, it makes the lanes higher or lower.
import type { Store } from "../../store/store";
import { LANE } from "./draw_lanes";

const LEAST = 3 * LANE;

// As much as leaves room for the tree.
function most(): number {
  return Math.max(LEAST, Math.round(innerHeight * 0.6));
}

export function Grip({ store }: { store: Store }) {
  const { lanesHeight } = store.looking;
  const set = (height: number) => store.set({ lanesHeight: Math.round(Math.min(most(), Math.max(LEAST, height))) });
  const down = (event: PointerEvent) => {
    const target = event.currentTarget as HTMLElement, from = event.clientY;
    target.setPointerCapture(event.pointerId);
    const move = ({ clientY }: PointerEvent) => set(lanesHeight + from - clientY);
    target.addEventListener("pointermove", move);
    target.addEventListener("lostpointercapture", () => target.removeEventListener("pointermove", move), { once: true });
  };
  const key = (event: KeyboardEvent) => {
    const by = { ArrowUp: LANE, ArrowDown: -LANE }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    set(lanesHeight + by);
  };
  return (
    <div class="grip" role="separator" aria-orientation="horizontal" aria-label="Height of the timeline" tabIndex={0}
      title="drag: the height of the timeline" aria-valuemin={LEAST} aria-valuemax={most()} aria-valuenow={lanesHeight}
      onPointerDown={down} onKeyDown={key} />
  );
}
