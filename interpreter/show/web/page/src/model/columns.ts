// Changes, and the lines of the recording that have them: a value holds until the next change. They are columns of numbers,
// since a long run has millions of changes.
import { RUNNING } from "./recording";

function grown<T extends Uint32Array | Float64Array | Uint8Array>(old: T, Type: new (n: number) => T): T {
  const more = new Type(Math.max(4, old.length * 2));
  more.set(old as never);
  return more;
}

const NO_LINES = new Uint32Array(0), NO_NUMBERS = new Float64Array(0), NO_BYTES = new Uint8Array(0);

// The place of the last change at or before `line`, or -1.
function placeOf(lines: Uint32Array, length: number, line: number): number {
  if (length === 0 || lines[0] > line) return -1;
  if (lines[length - 1] <= line) return length - 1;
  let low = 0, high = length - 1; // lines[low] <= line < lines[high]
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (lines[middle] <= line) low = middle;
    else high = middle;
  }
  return low;
}

// Flags of two ticks, or two moments of one, in a row: the node has completed in the second, also with the result that it had.
export function completesNewly(before: number, after: number): boolean {
  const status = after & STATUS;
  return (after & TICKED) !== 0 && status > RUNNING && (status !== (before & STATUS) || (before & TICKED) === 0);
}

export class NodeColumn {
  states = new NumberColumn(); // the flags without TICKED, where they change, and where the node completes again
  lines = NO_LINES;
  progress = NO_NUMBERS;
  flags = NO_BYTES; // status, 8: ticked, 16: held
  length = 0;
  isThin = false; // some progress of long ago is forgotten

  // `before`: the flags of the tick before.
  push(line: number, progress: number, flags: number, before = this.length === 0 ? 0 : this.flags[this.length - 1]) {
    const { states } = this, state = flags & ~TICKED;
    if (state !== (before & ~TICKED) || completesNewly(before, flags)) states.push(line, state);
    if (this.length === this.lines.length) {
      this.lines = grown(this.lines, Uint32Array);
      this.progress = grown(this.progress, Float64Array);
      this.flags = grown(this.flags, Uint8Array);
    }
    this.lines[this.length] = line;
    this.progress[this.length] = progress;
    this.flags[this.length++] = flags;
  }
  at(line: number): number {
    return placeOf(this.lines, this.length, line);
  }
  // Forgets every second of the older changes that have only another progress.
  thin() {
    this.isThin = true;
    const old = this.length >> 1;
    let kept = 0;
    for (let place = 0; place < this.length; ++place) {
      const changes = place === 0 || this.flags[place] !== this.flags[place - 1] || this.flags[place] !== this.flags[place + 1];
      if (place < old && !changes && place % 2 === 1) continue;
      this.lines[kept] = this.lines[place];
      this.progress[kept] = this.progress[place];
      this.flags[kept++] = this.flags[place];
    }
    this.length = kept;
  }
}

export class NumberColumn {
  lines = NO_LINES;
  values = NO_NUMBERS;
  length = 0;

  push(line: number, value: number) {
    if (this.length === this.lines.length) {
      this.lines = grown(this.lines, Uint32Array);
      this.values = grown(this.values, Float64Array);
    }
    this.lines[this.length] = line;
    this.values[this.length++] = value;
  }
  // A line with the whole state may have the same value again.
  change(line: number, value: number) {
    if (this.length === 0 || this.values[this.length - 1] !== value) this.push(line, value);
  }
  placeAt(line: number): number {
    return placeOf(this.lines, this.length, line);
  }
  at(line: number): number | undefined {
    const place = this.placeAt(line);
    return place < 0 ? undefined : this.values[place];
  }
}

const NOT_HEARD = -1;

// The words that another robot was heard to say: the lines from which on it was heard in nearly every tick, and the last of each.
export class HeardColumn {
  private readonly spans = new NumberColumn(); // the first line of each, and the last one
  private time = -Infinity;
  private run = 0;
  private word = 0;

  // `pause`: in seconds, after which another span begins. Word 0: the process is new, and has heard none yet.
  push(line: number, time: number, run: number, word: number, pause: number) {
    if (run === this.run && word === this.word) return; // a line with the whole state
    const { spans } = this;
    if (word === 0) spans.push(line, NOT_HEARD);
    else if (time - this.time <= pause) spans.values[spans.length - 1] = line;
    else spans.push(line, line);
    Object.assign(this, { time: word === 0 ? -Infinity : time, run, word });
  }
  // The last line, not after this one, that had a new word; undefined: none had.
  at(line: number): number | undefined {
    const last = this.spans.at(line);
    return last === undefined || last === NOT_HEARD ? undefined : Math.min(last, line);
  }
}

export const TICKED = 8, HELD = 16, STATUS = 7;
