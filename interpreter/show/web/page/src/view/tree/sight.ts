// The part of the tree that can be seen.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Box, Layout } from "./layout";

interface Sight {
  x: number;
  y: number;
  width: number;
  height: number;
}

const BEYOND = 240; // is drawn already

export function useSight(): [Sight, preact.RefObject<HTMLDivElement | null>, () => void] {
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

export function inSight(layout: Layout, sight: Sight, zoom: number): Box[] {
  const left = sight.x / zoom - BEYOND, right = (sight.x + sight.width) / zoom + BEYOND;
  const top = sight.y / zoom - BEYOND, bottom = (sight.y + sight.height) / zoom + BEYOND;
  return layout.boxes.filter(
    (box) => box.x < right && box.x + box.width > left && box.y < bottom && box.y + box.height > top);
}
