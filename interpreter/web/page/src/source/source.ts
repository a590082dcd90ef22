// Where the page finds the run: in itself, or at the server that it came from.
import type { Store } from "../view/store";
import { playEmbedded } from "./embedded";

interface Source {
  recording?: string;
  live?: boolean;
  control?: boolean;
}

export async function begin(store: Store) {
  const source = JSON.parse(document.getElementById("source")?.textContent || "null") as Source | null;
  if (source?.recording) return playEmbedded(store, source.recording);
  store.trouble = "this page has no recording: make one with `lockstep log page run.jsonl --out run.html`";
  store.changed();
}
