// Feeds the lines of a stream to the run, and lets the page draw meanwhile.
import type { Store } from "../store/store";

const SLICE = 40; // milliseconds of work before the page may draw

// A last line without its end was cut, and is left out.
export async function feedLines(bytes: ReadableStream<Uint8Array>, store: Store) {
  const reader = bytes.getReader(), decoder = new TextDecoder();
  let rest = "", began = performance.now();
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    const lines = (rest + decoder.decode(value, { stream: true })).split("\n");
    rest = lines.pop()!;
    for (const line of lines) {
      if (line) store.feed(line);
    }
    if (performance.now() - began < SLICE) continue;
    await new Promise((go) => setTimeout(go));
    began = performance.now();
  }
}
