// A running program: first what there was, then what happens. Comes back after the connection was lost, and asks for
// nothing while the page is out of sight.
import type { Store } from "../view/store";
import { readEvents } from "./event_stream";

export type Connection = "connecting" | "open" | "lost" | "ended" | "asleep";
export type When = "begins" | "completes" | "barrier";

export interface Breakpoint {
  node: number;
  when: When;
}

export interface ServerState {
  state?: "running" | "paused" | "ended";
  speed?: number;
  breakpoints?: Breakpoint[];
  hit?: Breakpoint | null;
  late_ms?: number;
  tick_us?: number;
  overruns?: number;
}

const SHORTEST = 250, LONGEST = 5000; // milliseconds until the next attempt

export class LiveSource {
  connection: Connection = "connecting";
  state: ServerState = {};
  refusal = ""; // of the last command
  private abort: AbortController | null = null;
  private attempts = 0;
  private hasHistory = false;
  private readonly base = new URL(".", location.href);
  private readonly token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";

  constructor(private readonly store: Store, readonly control: boolean) {
    document.addEventListener("visibilitychange", () => this.visible());
  }

  begin() {
    void this.connect();
  }

  private headers(): Record<string, string> {
    return this.token ? { "X-Lockstep-Token": this.token } : {};
  }
  private url(path: string): URL {
    const url = new URL(path, this.base);
    return url;
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
      if (!abort.signal.aborted && error instanceof Refused) return this.refuse(error);
    }
    if (abort.signal.aborted || this.connection === "ended") return;
    if (this.store.run.end) return this.become("ended");
    this.become("lost");
    const wait = Math.min(LONGEST, SHORTEST * 2 ** this.attempts++);
    setTimeout(() => !document.hidden && this.connection === "lost" && this.connect(), wait);
  }

  private refuse(error: Refused) {
    this.store.trouble = error.message;
    this.become("ended");
  }

  private async get(path: string, signal: AbortSignal): Promise<Response> {
    const answer = await fetch(this.url(path), { headers: this.headers(), signal, cache: "no-store" });
    if (answer.status === 401 || answer.status === 403) {
      throw new Refused("The program does not let this page in: open the link that it has printed, with its token.");
    }
    return answer;
  }

  private async readHistory(signal: AbortSignal) {
    const answer = await this.get("history", signal);
    if (answer.ok) {
      for (const line of (await answer.text()).split("\n")) {
        if (line.endsWith("}")) this.store.feed(line);
      }
    }
    this.hasHistory = true;
  }

  private async readEvents(signal: AbortSignal) {
    const { run } = this.store;
    const seen = run.lines > 0 ? `?after=${run.ticks[run.last]}` : "";
    const answer = await this.get(`events${seen}`, signal);
    if (!answer.ok || !answer.body) throw new Error(`the program answers ${answer.status}`);
    this.become("open");
    this.attempts = 0;
    await readEvents(answer.body, (name, data) => this.take(name, data));
  }

  private take(name: string, data: string) {
    if (name === "message") return this.takeLine(data);
    if (name === "state") this.state = JSON.parse(data) as ServerState;
    if (name === "end") this.connection = "ended";
    this.store.changed();
  }

  // A program that was started again at the same address has another run.
  private takeLine(data: string) {
    if (data.startsWith('{"lockstep_recording"') && this.store.isAnotherRun(data)) this.store.beginAgain();
    this.store.feed(data);
  }

  async command(what: object) {
    this.refusal = "";
    try {
      const answer = await fetch(this.url("control"), {
        method: "POST", body: JSON.stringify(what),
        headers: { ...this.headers(), "Content-Type": "application/json" },
      });
      if (!answer.ok) this.refusal = await reasonOf(answer);
    } catch {
      this.refusal = "the program does not answer";
    }
    this.store.changed();
  }
}

class Refused extends Error {}

async function reasonOf(answer: Response): Promise<string> {
  const text = await answer.text();
  try {
    return (JSON.parse(text) as { error: string }).error;
  } catch {
    return text.trim() || `the program answers ${answer.status}`;
  }
}
