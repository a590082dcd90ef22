// Keys that work everywhere on the page.
import type { Store } from "./store";

export function globalKey(store: Store, event: KeyboardEvent) {
  const at = event.target as HTMLElement;
  if (event.altKey || event.ctrlKey || event.metaKey || at.matches("input:not([type=range]), select, textarea")) return;
  const keys: Record<string, () => void> = {
    ",": () => store.step(-1),
    ".": () => store.step(1),
    "<": () => store.step(-10),
    ">": () => store.step(10),
    "[": () => store.goToEvent(-1),
    "]": () => store.goToEvent(1),
    f: () => store.set({ follow: !store.looking.follow }),
    t: () => store.set({ arrangement: store.looking.arrangement === "outline" ? "diagram" : "outline" }),
    "?": () => store.set({ help: !store.looking.help }),
  };
  const act = keys[event.key];
  if (!act) return;
  act();
  event.preventDefault();
}
