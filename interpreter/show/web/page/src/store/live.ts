// The page's view of a program that runs, and the orders that it can give, whoever brings them.

export type Connection = "connecting" | "open" | "lost" | "ended" | "asleep";
export type When = "begins" | "completes" | "succeeds" | "fails" | "barrier";

interface Breakpoint {
  node: number;
  when: When;
}

export interface ServerState {
  state?: "running" | "paused" | "ended";
  attended?: boolean; // only of a run that somebody must attend
  speed?: number;
  breakpoints?: Breakpoint[];
  reached?: Breakpoint; // that paused the run
  late_ms?: number;
  tick_us?: number;
  overruns?: number;
}

export interface Live {
  readonly connection: Connection;
  readonly state: ServerState;
  readonly control: boolean; // it takes orders
  readonly notice: string; // what became of the last order
  readonly kept: { add(line: string): void };
  // `done` is what to say when it was taken.
  order(what: object, done?: string): Promise<void>;
  // As a file.
  save(): Promise<void>;
}
