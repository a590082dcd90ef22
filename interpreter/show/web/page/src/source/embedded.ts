// The recording that is in the page's file: base64 of gzip.
import type { Store, TickRange } from "../store/store";
import { feedLines } from "./lines";

export async function playEmbedded(store: Store, recording: string, range: TickRange) {
  store.range = range;
  const bytes = Uint8Array.from(atob(recording), (letter) => letter.charCodeAt(0));
  await feedLines(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")), store);
  store.complete();
}
