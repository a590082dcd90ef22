// Where the page finds the run: in itself, or at the program that it came from.
import type { Store, TickRange } from "../store/store";
import { playEmbedded } from "./embedded";
import { Kept } from "./keep";
import { LiveSource } from "./live";

interface Source extends TickRange {
  recording?: string; // base64 of gzip
  live?: boolean;
  control?: boolean;
}

export async function begin(store: Store, page: string) {
  const source = JSON.parse(document.getElementById("source")?.textContent || "null") as Source | null;
  if (source?.recording) return playEmbedded(store, source.recording, source);
  if (source?.live) {
    const live = (store.live = new LiveSource(store, source.control === true, new Kept(page)));
    return live.begin();
  }
  store.trouble = "This page has no run. `lockstep log page run.jsonl --out run.html` writes one that has.";
  store.changed();
}
