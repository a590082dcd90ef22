// The run, and the part of it that the user looks at. One object; everything that draws subscribes to it.
import { firstLine } from "../model/decision";
import type { Filter } from "../model/events";
import { LARGE, SMALL, opened, type Folds } from "../model/folds";
import { Moment } from "../model/moment";
import { Run } from "../model/run";
import type { Live } from "./live";
import { withMoment } from "./span";

export type Theme = "auto" | "light" | "dark";
export type Arrangement = "diagram" | "outline";

// The ticks of the recording that were asked for, and are here; all without a bound.
export interface TickRange {
  from?: number;
  to?: number;
}

export interface Looking {
  line: number | null; // null: the newest
  selected: number | null;
  folds: Folds;
  onlyActive: boolean; // what does not run is folded
  follow: boolean; // what runs is kept in sight
  arrangement: Arrangement;
  zoom: number | null; // of the tree; null: so that all of it is in sight
  hidden: ReadonlySet<string>; // chips of events
  onlySelected: boolean; // events of the selected node
  span: [number, number] | null; // of the timeline, in seconds; null: all
  lanesHeight: number; // pixels
  plotted: number | null; // the synchronized node of the chart; null: what was last active
  theme: Theme;
  help: boolean;
  playing: boolean;
  speed: number;
}

const LEAST_ZOOM = 0.2;

export class Store {
  run = new Run();
  live: Live | null = null; // null: a recording
  range: TickRange = {};
  looking: Looking = {
    line: null, selected: null, folds: new Map(), onlyActive: false, follow: true,
    arrangement: innerWidth < 720 ? "outline" : "diagram", zoom: 1, hidden: new Set(), onlySelected: false, span: null, lanesHeight: 162,
    plotted: null, theme: "auto", help: false, playing: false, speed: 1,
  };
  trouble = ""; // why there is not more of the run
  colorVersion = 0;
  scale = 1; // with which the tree was last drawn
  private listeners = new Set<() => void>();
  private frame = 0;
  private known: { version: number; line: number; moment: Moment } | null = null;

  get line(): number {
    return Math.max(0, Math.min(this.looking.line ?? this.run.last, this.run.last));
  }
  get filter(): Filter {
    const { hidden, onlySelected, selected } = this.looking;
    return { hidden, only: onlySelected ? selected : null };
  }
  get moment(): Moment {
    const { line, run } = this;
    const known = this.known;
    if (known && known.line === line && (known.version === run.version || line < run.last)) return known.moment;
    const moment = new Moment(run, line);
    this.known = { version: run.version, line, moment };
    return moment;
  }

  set(change: Partial<Looking>) {
    this.looking = { ...this.looking, ...change };
    this.changed();
  }
  // All that happens within a frame is drawn once.
  changed() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      for (const listener of this.listeners) listener();
    });
  }
  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  feed(text: string) {
    const begins = this.run.header === null;
    this.live?.kept.add(text);
    try {
      this.run.feed(text);
    } catch (error) {
      this.trouble = `The run cannot be read further: ${(error as Error).message}`;
    }
    if (begins && this.run.shape.nodes.length > (innerWidth < 720 ? SMALL : LARGE)) this.looking = { ...this.looking, onlyActive: true };
    this.changed();
  }
  isAnotherRun(text: string): boolean {
    const { header } = this.run;
    return header !== null && JSON.stringify(header) !== JSON.stringify(JSON.parse(text));
  }
  beginAgain() {
    this.run = new Run();
    this.known = null;
    this.looking = { ...this.looking, line: null, selected: null, folds: new Map(), span: null, plotted: null };
  }
  // Nothing more comes of a recording.
  complete() {
    if (!this.run.end && !this.trouble && this.range.to === undefined) this.trouble = "The recording is cut: it has no closing line.";
    if (this.looking.line === null) this.looking = { ...this.looking, line: firstLine(this.run) };
    this.changed();
  }

  show(line: number) {
    const shown = Math.max(0, Math.min(line, this.run.last));
    this.set({ line: shown, span: withMoment(this, this.run.times[shown] ?? 0) });
  }
  goTo(line: number) {
    this.looking = { ...this.looking, playing: false };
    this.show(line);
  }
  step(by: number) {
    this.goTo(this.line + by);
  }
  goToEvent(direction: 1 | -1) {
    const { events } = this.run;
    const line = direction > 0 ? events.nextLine(this.line, this.filter) : events.previousLine(this.line, this.filter);
    if (line !== null) this.goTo(line);
  }
  play() {
    const { playing } = this.looking;
    if (!playing && this.line === this.run.last) this.show(0);
    this.set({ playing: !playing });
  }
  // What runs is not kept in sight any more: the user looks elsewhere.
  letGo() {
    if (this.looking.follow) this.set({ follow: false });
  }
  fit() {
    this.set({ zoom: this.looking.zoom === null ? 1 : null });
  }
  magnify(factor: number) {
    this.set({ zoom: Math.max(Math.min(LEAST_ZOOM, this.scale), Math.min(3, this.scale * factor)) });
  }
  select(node: number, reveal = false) {
    const { folds, onlyActive } = this.looking;
    this.set({ selected: node, folds: reveal ? opened(this.moment, folds, onlyActive, node) : folds });
  }
  fold(node: number, open: boolean) {
    const folds = new Map(this.looking.folds);
    folds.set(node, open);
    this.set({ folds });
  }
  foldBelow(node: number, open: boolean) {
    const folds = new Map(this.looking.folds);
    const { nodes } = this.run.shape;
    for (let below = node; below < nodes[node].end; ++below) {
      if (nodes[below].children.length > 0 && (open || below > node)) folds.set(below, open);
    }
    this.set({ folds });
  }
}
