// Acts on a run that is active; only there if the program was started with --monitor-control.
import { useState } from "preact/hooks";
import type { Live } from "../store/live";
import type { Store } from "../store/store";
import { WHEN, controls } from "./panels/breakpoints";
import { Attend } from "./panels/questions";

const SPEEDS: [string, number][] = [
  ["0.1×", 0.1], ["0.5×", 0.5], ["1×", 1], ["2×", 2], ["10×", 10], ["100×", 100], ["as fast as possible", 0],
];
export function pauseOrResume(live: Live) {
  void live.order({ do: live.state.state === "paused" ? "resume" : "pause" });
}

function Speed({ store, live }: { store: Store; live: Live }) {
  if (store.run.header?.clock !== "virtual") return null;
  return (
    <label>speed <select aria-label="Speed of the run" value={live.state.speed ?? 1}
      onChange={(event) => live.order({ do: "speed", factor: Number((event.target as HTMLSelectElement).value) })}>
      {SPEEDS.map(([text, factor]) => <option key={factor} value={factor}>{text}</option>)}
    </select></label>
  );
}

function SetEntry({ store, live }: { store: Store; live: Live }) {
  const entries = store.run.header?.entries ?? [];
  const [entry, setEntry] = useState(entries[0]?.key ?? "");
  const [value, setValue] = useState("");
  if (entries.length === 0) return null;
  const send = (event: Event) => {
    event.preventDefault();
    void live.order({ do: "set", entry, value }, `${entry} = ${value} from the next tick on`);
  };
  return (
    <form class="buttons" aria-label="Set an entry" onSubmit={send}>
      <select aria-label="Entry" value={entry} onChange={(event) => setEntry((event.target as HTMLSelectElement).value)}>
        {entries.map(({ key }) => <option key={key}>{key}</option>)}
      </select>
      <input aria-label="Value" value={value} size={10} onInput={(event) => setValue((event.target as HTMLInputElement).value)} />
      <button type="submit">set</button>
    </form>
  );
}

function BreakpointsSet({ store, live }: { store: Store; live: Live }) {
  const name = (node: number) => store.run.shape.nodes[node]?.apart ?? "?";
  return (
    <div class="buttons" role="group" aria-label="Breakpoints">
      {(live.state.breakpoints ?? []).map(({ node, when }) => (
        <button type="button" key={`${node} ${when}`} class="breakpoint" title="remove this breakpoint"
          aria-label={`remove the breakpoint: ${name(node)} ${WHEN[when]}`}
          onClick={() => live.order({ do: "break", node, when, on: false })}>
          {`● ${name(node)} ${WHEN[when]} ×`}</button>
      ))}
    </div>
  );
}

function reachedText(store: Store, live: Live): string {
  const { reached, state } = live.state;
  if (!reached || state !== "paused") return "";
  return `paused, since ${store.run.shape.nodes[reached.node]?.apart ?? "?"} ${WHEN[reached.when]}`;
}

// A robot that stands is a fact to know before the button is pressed.
function pauseTitle(store: Store, paused: boolean): string {
  if (paused) return "resume (p)";
  return store.run.header?.clock === "wall"
    ? "no more ticks, and the running leaves are paused as by a barrier: the robot stands (p)"
    : "no more ticks until resumed (p)";
}

export function Control({ store }: { store: Store }) {
  const { run } = store, live = controls(store);
  const [sure, setSure] = useState(false);
  const [more, setMore] = useState(false); // on a phone
  if (!live) return null;
  const paused = live.state.state === "paused";
  const halt = () => {
    if (sure) void live.order({ do: "halt" });
    setSure(!sure);
  };
  return (
    <section class="control" aria-label="Control of the run">
      <div class="bar-of-buttons">
        <button type="button" class="pause" aria-keyshortcuts="p" title={pauseTitle(store, paused)}
          onClick={() => pauseOrResume(live)}>{paused ? "▶ resume" : "‖ pause"}</button>
        <button type="button" aria-keyshortcuts="s" disabled={!paused} title="one tick (s)"
          onClick={() => live.order({ do: "step", ticks: 1 })}>one tick</button>
        <Attend live={live} />
        <button type="button" class="on-phone" aria-expanded={more} onClick={() => setMore(!more)}>more</button>
        <div class={more ? "extras open" : "extras"}>
          <Speed store={store} live={live} />
          <SetEntry store={store} live={live} />
          <BreakpointsSet store={store} live={live} />
        </div>
        <span class="grow" />
        <button type="button" class="halt" onClick={halt} onBlur={() => setSure(false)}
          title="halts all leaves and ends the run">{sure ? <>really halt<span class="wide"> the run</span>?</> : "■ halt"}</button>
      </div>
      {run.header?.clock === "wall" && !paused &&
        <p class="dim">Pausing pauses the running leaves as a barrier does: the robot stands still until it is resumed.</p>}
      <p role="status" class="notice">{reachedText(store, live) || live.notice}</p>
    </section>
  );
}
