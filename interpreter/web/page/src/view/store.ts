// What the user looks at, and the run that is looked at. One object; what draws subscribes to it.
import { useEffect, useState } from "preact/hooks";
import { LARGE, opened, type Folds } from "../model/folds";
import { Moment } from "../model/moment";
import { Run } from "../model/run";

export type Theme = "auto" | "light" | "dark";
export type Arrangement = "diagram" | "outline";

export interface Looking {
  line: number | null; // null: the newest
  selected: number | null;
  folds: Folds;
  onlyActive: boolean;
  follow: boolean; // what runs is kept in sight
  arrangement: Arrangement;
  zoom: number;
  span: [number, number] | null; // of the timeline, in seconds; null: all
  plotted: number | null; // the synchronized node of the chart; null: what was last active
  theme: Theme;
  help: boolean;
  playing: number; // speed; 0: stands
}

export class Store {
  run = new Run();
  looking: Looking = {
    line: null, selected: null, folds: new Map(), onlyActive: false, follow: true,
    arrangement: innerWidth < 720 ? "outline" : "diagram", zoom: 1, span: null, plotted: null,
    theme: "auto", help: false, playing: 0,
  };
  trouble = ""; // that the run cannot be read
  private listeners = new Set<() => void>();
  private frame = 0;
  private known: { version: number; line: number; moment: Moment } | null = null;

  get line(): number {
    return Math.min(this.looking.line ?? this.run.last, this.run.last);
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
    try {
      this.run.feed(text);
    } catch (error) {
      this.trouble = `the recording cannot be read further: ${(error as Error).message}`;
    }
    if (begins && this.run.shape.nodes.length > LARGE) this.looking = { ...this.looking, onlyActive: true };
    this.changed();
  }

  // Nothing more comes.
  complete() {
    if (!this.run.end && !this.trouble) this.trouble = "the recording is cut: it has no closing line";
    this.changed();
  }

  goTo(line: number) {
    const { last } = this.run;
    this.set({ line: Math.max(0, Math.min(line, last)), playing: 0 });
  }
  step(by: number) {
    this.goTo(this.line + by);
  }
  goToEvent(direction: 1 | -1) {
    const { events } = this.run;
    const line = direction > 0 ? events.nextLine(this.line) : events.previousLine(this.line);
    if (line !== null) this.goTo(line);
  }
  select(node: number, reveal = false) {
    const { folds, onlyActive } = this.looking;
    const open = reveal ? opened(this.moment, folds, onlyActive, node) : folds;
    this.set({ selected: node, folds: open });
  }
  fold(node: number, open: boolean) {
    const folds = new Map(this.looking.folds);
    folds.set(node, open);
    this.set({ folds });
  }
}

export function useStore(store: Store): Looking {
  const [, redraw] = useState(0);
  useEffect(() => store.subscribe(() => redraw((count) => count + 1)), [store]);
  return store.looking;
}
