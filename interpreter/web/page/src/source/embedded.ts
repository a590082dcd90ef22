// The recording that is in the page's file: base64 of gzip.
import type { Store } from "../view/store";

const SLICE = 40; // milliseconds of work before the page may draw

async function unpacked(text: string): Promise<ReadableStreamDefaultReader<string>> {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return stream.pipeThrough(new TextDecoderStream() as never).getReader() as never;
}

export async function playEmbedded(store: Store, recording: string) {
  const reader = await unpacked(recording);
  let rest = "", began = performance.now();
  for (;;) {
    const { value, done } = await reader.read();
    const lines = (rest + (value ?? "")).split("\n");
    rest = lines.pop()!; // at the end it is a line that was cut
    for (const line of lines) {
      if (line) store.feed(line);
    }
    if (done) break;
    if (performance.now() - began < SLICE) continue;
    await new Promise((go) => setTimeout(go));
    began = performance.now();
  }
  store.complete();
}
