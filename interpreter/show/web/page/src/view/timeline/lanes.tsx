// Each node that was active as a lane; a drag goes to a moment, the wheel with Ctrl zooms.
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { laneNodes, laneText } from "../../model/lanes";
import { RUNNING } from "../../model/recording";
import { cutText } from "../../model/words";
import { spanShown, zoomed } from "../../store/span";
import type { Store } from "../../store/store";
import { colors } from "../parts/colors";
import { fittedName } from "../parts/measure";
import { END, LANE, RULER, drawLanes, drawRuler, timeOf, xOf, type Window } from "./draw_lanes";

interface Size {
  width: number;
  height: number;
  scroll: number;
}

function sharp(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context?.scale(ratio, ratio);
  return context;
}

function useSize(): [Size, preact.RefObject<HTMLDivElement | null>, () => void] {
  const rows = useRef<HTMLDivElement>(null);
  const [size, setSize] = useState<Size>({ width: 600, height: 120, scroll: 0 });
  const look = () => {
    const it = rows.current;
    if (it) setSize({ width: Math.max(100, it.clientWidth - labelWidth()), height: it.clientHeight, scroll: it.scrollTop });
  };
  useLayoutEffect(() => {
    look();
    const observer = new ResizeObserver(look);
    if (rows.current) observer.observe(rows.current);
    return () => observer.disconnect();
  }, []);
  return [size, rows, look];
}

const px = (value: number) => `${value}px`;

function labelWidth(): number {
  return innerWidth < 720 ? 92 : 170;
}

export function Lanes({ store, all }: { store: Store; all: boolean }) {
  const { run, looking, moment } = store;
  const [size, rows, look] = useSize();
  const canvas = useRef<HTMLCanvasElement>(null), ruler = useRef<HTMLCanvasElement>(null);
  const [from, to] = spanShown(store);
  const window: Window = { from, to, width: size.width - END };
  const nodes = useMemo(() => laneNodes(run, all, looking.selected), [run, all, looking.selected, run.version]);
  const left = labelWidth();

  useEffect(() => {
    const lanes = canvas.current && sharp(canvas.current, size.width, size.height);
    if (lanes) drawLanes(lanes, run, nodes, size.scroll, window, colors(), size.height);
    const marks = ruler.current && sharp(ruler.current, size.width, RULER);
    if (marks) drawRuler(marks, window, colors(), RULER);
  }, [run.version, nodes, from, to, size.width, size.height, size.scroll, looking.theme, store.colorVersion]);

  // The lane of what runs is in sight.
  const active = looking.follow ? nodes.findIndex((node) => moment.status[node] === RUNNING && !moment.held[node]) : -1;
  useEffect(() => {
    const it = rows.current;
    if (!it || active < 0) return;
    const top = active * LANE;
    if (top < it.scrollTop || top + LANE * 2 > it.scrollTop + it.clientHeight) it.scrollTop = top - LANE * 2;
  }, [active]);

  const chosen = looking.selected === null ? -1 : nodes.indexOf(looking.selected);
  useEffect(() => {
    const it = rows.current, top = chosen * LANE;
    if (it && chosen >= 0 && (top < it.scrollTop || top + LANE > it.scrollTop + it.clientHeight)) it.scrollTop = top - it.clientHeight / 2;
  }, [chosen]);

  const scrub = (event: PointerEvent) => {
    if (event.type === "pointermove" && !(event.buttons & 1)) return;
    const target = event.currentTarget as HTMLElement;
    if (event.type === "pointerdown") target.setPointerCapture(event.pointerId);
    const x = event.clientX - target.getBoundingClientRect().left;
    store.goTo(run.lineAtTime(timeOf(Math.min(x, window.width), window)));
  };
  const wheel = (event: WheelEvent) => {
    if (!event.ctrlKey && !event.metaKey && !event.shiftKey) return;
    event.preventDefault();
    const target = event.currentTarget as HTMLElement;
    const at = timeOf(event.clientX - target.getBoundingClientRect().left, window);
    if (event.shiftKey) store.set({ span: zoomed(store, 1, at, (event.deltaY || event.deltaX) / size.width) });
    else store.set({ span: zoomed(store, event.deltaY > 0 ? 1.3 : 1 / 1.3, at) });
  };
  const cursor = xOf(moment.time, window);
  const firstRow = Math.max(0, Math.floor(size.scroll / LANE) - 2);
  const lastRow = Math.min(nodes.length, Math.ceil((size.scroll + size.height) / LANE) + 2);
  return (
    <div class="lanes">
      <div class="ruler" style={{ marginLeft: px(left) }} onPointerDown={scrub} onPointerMove={scrub} onWheel={wheel}>
        <canvas ref={ruler} aria-hidden="true" />
      </div>
      <div class="rows" ref={rows} style={{ height: px(looking.lanesHeight) }} onScroll={look} tabIndex={0} role="group" aria-label="Lanes of the nodes">
        <div class="drawing" style={{ left: px(left), height: px(size.height), width: px(size.width) }} onPointerDown={scrub}
          onPointerMove={scrub} onWheel={wheel}>
          <canvas ref={canvas} aria-hidden="true" />
        </div>
        <ul style={{ height: px(nodes.length * LANE), width: px(left), marginTop: px(-size.height) }}>
          {nodes.slice(firstRow, lastRow).map((node, place) => (
            <li key={node} style={{ top: px((firstRow + place) * LANE), height: px(LANE) }}>
              <button type="button" class={looking.selected === node ? "lane selected" : "lane"}
                title={run.shape.nodes[node].path} aria-label={`${run.shape.nodes[node].apart}: ${laneText(run, node)}`}
                onClick={() => store.select(node, true)}>{fittedName(run.shape.nodes[node].apart, 13, left - 10, looking.selected === node ? 600 : 400)}</button>
            </li>
          ))}
        </ul>
      </div>
      {run.cuts.map(({ line, after }) => ({ after, x: xOf(run.times[line] ?? run.times[run.last] ?? 0, window) })).map(({ after, x }) => x >= 0 && x <= window.width && (
        <div class="cut" role="img" style={{ left: px(left + x) }} title={cutText(after)} aria-label={cutText(after)} />
      ))}
      {cursor < window.width && (
        <div class="later" style={{ left: px(left + Math.max(0, cursor)), width: px(size.width - Math.max(0, cursor)) }} />
      )}
      {cursor >= 0 && cursor <= window.width && <div class="cursor" style={{ left: px(left + cursor) }} />}
    </div>
  );
}
