// The lines of a recording, as docs/recording.md describes them.

export const STATUSES = ["idle", "running", "success", "failure", "skipped"] as const;
export type StatusName = (typeof STATUSES)[number];
export const IDLE = 0, RUNNING = 1, SUCCESS = 2, FAILURE = 3, SKIPPED = 4;

export interface HeaderNode {
  index: number;
  path: string;
  kind: string;
  name: string;
  parent: number | null;
  barriers?: number[] | null;
  delta?: number | null;
  members?: number[];
  resources?: string[];
  idle?: "ignore";
}

export interface Header {
  lockstep_recording: number;
  tree: string;
  file: string;
  version: string;
  law?: number;
  rate_hz: number;
  clock: "wall" | "virtual";
  seed: number;
  arguments: Record<string, string>;
  nodes: HeaderNode[];
  entries?: { key: string; type: string; writers?: number[] }[];
}

export type LogLine = [who: string, level: string, text: string];

export interface TickLine {
  tick: number;
  time_s: number;
  full?: boolean; // live only: nodes that are not named are idle
  nodes?: [index: number, status: StatusName, progress: number, ticked: number, held: number][];
  limits?: [index: number, limit: number | null][];
  rounds?: [index: number, number: number, of: number][];
  succeeded?: number[];
  faults?: [index: number, message: string][];
  entries?: [index: number, value: string | null][];
  logs?: LogLine[];
  // Live only, of a line with the whole state: what there was in the run until then.
  counts?: [index: number, succeeded: number, failed: number, skipped: number, halted: number, held: number, faults: number][];
  written?: [index: number, values: number][];
}

export interface End {
  result: string;
  reason: string;
  fault?: string;
  signal?: number;
  ticks: number;
  time_s: number;
  overruns: number;
  skipped: number;
  lost?: number;
  notes?: string[];
  logs?: LogLine[];
}

export type Line = Header | TickLine | { lost: { ticks: number; from: number } } | { end: End };
