// Brings nodes into sight.
import type { Shape } from "../../model/shape";
import type { Layout } from "./layout";

interface Extent {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export function extentOf(layout: Layout, nodes: Iterable<number>): Extent | null {
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
export function withAbove(shape: Shape, layout: Layout, wanted: number[], width: number, height: number): Extent | null {
  const { nodes } = shape;
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

export function scrollTo(scroller: HTMLDivElement, extent: Extent | null, zoom: number) {
  if (!extent) return;
  const fit = (low: number, high: number, at: number, size: number) => {
    if (low * zoom >= at + 4 && high * zoom <= at + size - 4) return at;
    if ((high - low) * zoom > size) high = low + size / zoom;
    return Math.max(0, ((low + high) / 2) * zoom - size / 2);
  };
  const x = fit(extent.left, extent.right, scroller.scrollLeft, scroller.clientWidth);
  const y = fit(extent.top, extent.bottom, scroller.scrollTop, scroller.clientHeight);
  scroller.scrollTo({ left: x, top: y }); // also to where it is: it may be on its way to what was wanted before
}
