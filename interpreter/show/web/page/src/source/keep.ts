// Keeps the lines of a run that goes on, to save it as a file: this page, with the run in it.

const PIECE = 1 << 20; // letters that are put away at once; the browser may move them to a disk
const MOST = 1 << 30; // letters

// The page as it came, before anything is drawn. Its script is a part of it.
export function pageAsItCame(): string {
  return `<!doctype html>\n${document.documentElement.outerHTML}\n`;
}

export class Kept {
  private readonly pieces: Blob[] = [];
  private lines: string[] = [];
  private length = 0; // letters of these
  private total = 0;

  constructor(private readonly page: string) {}

  add(line: string) {
    if ((this.total += line.length + 1) > MOST) return;
    this.lines.push(line, "\n");
    this.length += line.length + 1;
    if (this.length > PIECE) this.putAway();
  }
  // Another run.
  clear() {
    this.pieces.length = this.lines.length = this.length = this.total = 0;
  }
  get isWhole(): boolean {
    return this.total <= MOST;
  }

  async file(): Promise<Blob> {
    this.putAway();
    const packed = await new Response(new Blob(this.pieces).stream().pipeThrough(new CompressionStream("gzip"))).blob();
    const begin = this.page.indexOf(">", this.page.indexOf('id="source"')) + 1;
    const end = this.page.indexOf("</script>", begin);
    return new Blob([this.page.slice(0, begin), '{"recording":"', await base64(packed), '"}', this.page.slice(end)],
      { type: "text/html" });
  }

  private putAway() {
    this.pieces.push(new Blob([this.lines.join("")]));
    this.lines = [];
    this.length = 0;
  }
}

function base64(bytes: Blob): Promise<string> {
  return new Promise((done, fail) => {
    const reader = new FileReader();
    reader.onload = () => done((reader.result as string).split(",")[1]);
    reader.onerror = () => fail(reader.error);
    reader.readAsDataURL(bytes);
  });
}

export function download(file: Blob, name: string) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
