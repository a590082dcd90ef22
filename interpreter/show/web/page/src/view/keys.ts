// Keys that work everywhere on the page.
import { zoomed } from "../store/span";
import type { Store } from "../store/store";
import { pauseOrResume } from "./control";

function acts(store: Store): Record<string, () => void> {
  const { looking, live, moment } = store;
  const zoom = (factor: number) => store.set({ span: zoomed(store, factor, moment.time) });
  const always = {
    ",": () => store.step(-1),
    ".": () => store.step(1),
    "<": () => store.step(-10),
    ">": () => store.step(10),
    "[": () => store.goToEvent(-1),
    "]": () => store.goToEvent(1),
    " ": () => store.play(),
    n: () => store.set({ line: null, playing: false }),
    "+": () => zoom(0.5),
    "-": () => zoom(2),
    "0": () => store.set({ span: null }),
    "/": () => document.getElementById("search")?.focus(),
    f: () => store.set({ follow: !looking.follow }),
    a: () => store.set({ onlyActive: !looking.onlyActive, folds: new Map() }),
    t: () => store.set({ arrangement: looking.arrangement === "outline" ? "diagram" : "outline" }),
    F: () => store.fit(),
    z: () => store.magnify(1.2),
    Z: () => store.magnify(1 / 1.2),
    "?": () => store.set({ help: !looking.help }),
  };
  if (!live?.control) return always;
  return { ...always, p: () => pauseOrResume(live), s: () => void live.order({ do: "step", ticks: 1 }) };
}

export function globalKey(store: Store, event: KeyboardEvent) {
  const at = event.target as HTMLElement;
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  if (at.matches?.("input:not([type=range]), select, textarea")) return;
  if (event.key === " " && at.matches?.("button, summary")) return; // it presses them
  const act = acts(store)[event.key];
  if (!act) return;
  act();
  event.preventDefault();
}
