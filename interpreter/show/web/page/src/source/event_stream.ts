// Server-sent events, from a stream: EventSource cannot send the header with the token.

// Calls `take` for each event until the stream ends.
export async function readEvents(body: ReadableStream<Uint8Array>, take: (name: string, data: string) => void) {
  const reader = body.getReader(), decoder = new TextDecoder();
  let rest = "", name = "message", data: string[] = [];
  const field = (line: string) => {
    if (line === "") {
      if (data.length > 0) take(name, data.join("\n"));
      name = "message";
      data = [];
    } else if (line.startsWith("data:")) {
      data.push(line.slice(line[5] === " " ? 6 : 5));
    } else if (line.startsWith("event:")) {
      name = line.slice(6).trim();
    }
  };
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    const lines = (rest + decoder.decode(value, { stream: true })).split("\n");
    rest = lines.pop()!;
    for (const line of lines) field(line.endsWith("\r") ? line.slice(0, -1) : line);
  }
}
