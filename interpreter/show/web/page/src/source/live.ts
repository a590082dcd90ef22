// A running program: first what there was, then what happens. Comes back after the connection was lost, and asks for
// nothing while the page is out of sight.
import type { Connection, Live, ServerState } from "../store/live";
import type { Store } from "../store/store";
import { readEvents } from "./event_stream";
import { Kept, download } from "./keep";
import { feedLines } from "./lines";

// Milliseconds.
const SHORTEST = 250, LONGEST = 5000; // until the next attempt
const SILENCE = 3000; // after which a connection may be dead: a cable that was pulled closes nothing
const PATIENCE = 3000; // for an answer

export class LiveSource implements Live {
  connection: Connection = "connecting";
  state: ServerState = {};
  notice = "";
  private isSaved = false;
  private isServed = false; // also after the end: --monitor-linger
  private abort: AbortController | null = null;
  private attempts = 0;
  private hasHistory = false;
  private readonly base = new URL(".", location.href);
  private readonly token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";

  constructor(private readonly store: Store, readonly control: boolean, readonly kept: Kept) {
    document.addEventListener("visibilitychange", () => this.visible());
    // Once the program is gone, nobody has the run but this page.
    addEventListener("beforeunload", (event) => this.isOver() && !this.isSaved && !this.isServed && event.preventDefault());
  }

  isOver(): boolean {
    return this.store.run.lines > 0 && (this.store.run.end !== null || this.connection === "ended");
  }
  async save() {
    const isOver = this.isOver();
    download(await this.kept.file(), `${this.store.run.header?.tree ?? "run"}.html`);
    this.isSaved = isOver;
    this.notice = this.kept.isWhole ? "" : "the run is too long for a page: its last part is not in the file";
    this.store.changed();
  }

  begin() {
    void this.connect();
  }

  private headers(): Record<string, string> {
    return this.token ? { "X-Lockstep-Token": this.token } : {};
  }
  private url(path: string): URL {
    return new URL(path, this.base);
  }
  private become(connection: Connection) {
    this.connection = connection;
    this.store.changed();
  }

  private visible() {
    if (this.connection === "ended") return;
    if (document.hidden) {
      this.become("asleep");
      this.abort?.abort();
    } else if (this.connection === "asleep") {
      this.attempts = 0;
      void this.connect();
    }
  }

  private async connect() {
    const abort = (this.abort = new AbortController());
    try {
      if (!this.hasHistory) await this.readHistory(abort.signal);
      await this.readEvents(abort.signal);
    } catch (error) {
      if (error instanceof Refused) return this.refuse(error);
    }
    if (abort !== this.abort || this.connection === "ended" || this.connection === "asleep") return;
    if (this.store.run.end) return this.become("ended");
    if (abort.signal.reason === SILENT) return void this.connect();
    this.become("lost");
    const wait = Math.min(LONGEST, SHORTEST * 2 ** this.attempts++);
    setTimeout(() => !document.hidden && this.connection === "lost" && this.connect(), wait);
  }

  private refuse(error: Refused) {
    this.store.trouble = error.message;
    this.become("ended");
  }

  private async get(path: string, signal: AbortSignal): Promise<Response> {
    const answer = await inTime(fetch(this.url(path), { headers: this.headers(), signal, cache: "no-store" }));
    if (answer.status === 401 || answer.status === 403) {
      throw new Refused("The program does not let this page in: open the link that it has printed, with its token.");
    }
    return answer;
  }

  private async readHistory(signal: AbortSignal) {
    const answer = await this.get("history", signal);
    if (answer.ok && answer.body) await feedLines(answer.body, this.store);
    this.hasHistory = true;
  }

  private async readEvents(signal: AbortSignal) {
    const { run } = this.store;
    const seen = run.lines > 0 ? `?after=${run.ticks[run.last]}` : "";
    const answer = await this.get(`events${seen}`, signal);
    if (!answer.ok || !answer.body) throw new Error(`the program answers ${answer.status}`);
    this.become("open");
    this.attempts = 0;
    this.isServed = true;
    try {
      await readEvents(watched(answer.body, this.abort!), (name, data) => this.take(name, data));
    } finally {
      this.isServed = false;
    }
  }

  private take(name: string, data: string) {
    if (name === "message") return this.takeLine(data);
    if (name === "state") this.state = { ...this.state, reached: undefined, ...(JSON.parse(data) as ServerState) };
    if (name === "end") this.connection = "ended";
    this.store.changed();
  }

  // A program that was started again at the same address has another run.
  private takeLine(data: string) {
    if (data.startsWith('{"lockstep_recording"') && this.store.isAnotherRun(data)) {
      this.kept.clear();
      this.store.beginAgain();
    }
    this.store.feed(data);
  }

  async order(what: object, done = "") {
    this.notice = "";
    try {
      const answer = await fetch(this.url("control"), {
        method: "POST", body: JSON.stringify(what),
        headers: { ...this.headers(), "Content-Type": "application/json" },
      });
      this.notice = answer.ok ? done : `not done: ${await reasonOf(answer)}`;
    } catch {
      this.notice = "not done: the program does not answer";
    }
    this.store.changed();
  }
}

class Refused extends Error {}

function inTime(answer: Promise<Response>): Promise<Response> {
  let timer: ReturnType<typeof setTimeout>;
  const late = new Promise<never>((_, fail) => {
    timer = setTimeout(() => fail(new Error("no answer")), PATIENCE);
  });
  return Promise.race([answer, late]).finally(() => clearTimeout(timer));
}

const SILENT = "silent";

// The same bytes; `abort` is called when they stop.
function watched(body: ReadableStream<Uint8Array>, abort: AbortController): ReadableStream<Uint8Array> {
  const give = () => setTimeout(() => abort.abort(SILENT), SILENCE);
  let timer = give();
  return body.pipeThrough(new TransformStream({
    transform(bytes, controller) {
      clearTimeout(timer);
      timer = give();
      controller.enqueue(bytes);
    },
    flush: () => clearTimeout(timer),
  }));
}

async function reasonOf(answer: Response): Promise<string> {
  const text = await answer.text();
  try {
    const { error, hint } = JSON.parse(text) as { error: string; hint?: string };
    return hint ? `${error} (${hint})` : error;
  } catch {
    return text.trim() || `the program answers ${answer.status}`;
  }
}
