// The lines of a recording, as docs/recording.md describes them. Made by `./dev generate` from
// interpreter/record/lines.h, base/core/status.h and base/core/progress.h.

export const STATUSES = ["idle", "running", "success", "failure", "skipped"] as const;
export type StatusName = (typeof STATUSES)[number];
export const IDLE = 0, RUNNING = 1, SUCCESS = 2, FAILURE = 3, SKIPPED = 4;

// Progress that differs by no more is the same.
export const PROGRESS_EPSILON = 1e-09;

export type NodeChange = [index: number, status: StatusName, progress: number, ticked: number, held: number];
export type MomentNode = [index: number, status: StatusName, ticked: number, held: number];
export type Moment = [times: number, nodes: MomentNode[]];
export type LimitChange = [index: number, limit: number | null];
export type RoundChange = [index: number, number: number, of: number];
export type FactorChange = [index: number, factor: number];
export type ReasonChange = [index: number, reason: string];
export type GivenAnswer = [index: number, answer: string, who: string];
export type Fault = [index: number, message: string];
export type EntryValue = [index: number, value: string | null];
export type LogLine = [who: string, level: string, text: string];
export type NodeCounts = [index: number, succeeded: number, failed: number, skipped: number, halted: number, held: number, faults: number];
export type EntryCount = [index: number, values: number];
export type HeardWord = [index: number, run: number, word: number];
export type LeafProgress = [moment: number, index: number, progress: number];

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
  values?: Record<string, string>;
  nodes: HeaderNode[];
  entries?: HeaderEntry[];
  first_tick?: number;
  resumed_after_s?: number;
  verify?: string;
  tick?: "exactly-once";
  run?: number;
}

export interface TickLine {
  tick: number;
  time_s: number;
  nodes: NodeChange[];
  limits?: LimitChange[];
  rounds?: RoundChange[];
  factors?: FactorChange[];
  reasons?: ReasonChange[];
  answers?: GivenAnswer[];
  heard?: HeardWord[];
  succeeded?: number[];
  moments?: Moment[];
  leaf_progress?: LeafProgress[];
  more?: NodeCounts[];
  faults?: Fault[];
  entries?: EntryValue[];
  set?: number[];
  given?: EntryValue[];
  logs?: LogLine[];
  whole?: EntryValue[];
  counts?: NodeCounts[];
  written?: EntryCount[];
  full?: boolean;
}

export interface LostLine {
  lost: Lost;
}

export interface ContinuedLine {
  continued: Continued;
}

export interface EndLine {
  end: End;
}

export interface HeaderNode {
  index: number;
  path: string;
  kind: string;
  name: string;
  parent: number | null;
  barriers?: number[] | null;
  delta?: number | null;
  idle?: "ignore" | "wait";
  resources?: string[];
  members?: number[];
  pace?: boolean;
  condition?: string;
  reads?: string[];
  ports?: Record<string, string>;
  options?: string[];
  default?: string;
  timeout_s?: number;
  severity?: string;
  guard?: boolean;
}

export interface HeaderEntry {
  key: string;
  type: string;
  strict?: boolean;
  writers?: number[];
}

export interface Lost {
  ticks: number;
  from: number;
}

export interface Continued {
  ticks: number;
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

export type Line = Header | TickLine | LostLine | ContinuedLine | EndLine;
