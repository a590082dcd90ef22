// The head of the page: which run it is, where it stands, and how the page looks.
import { seconds } from "../model/words";
import type { Connection } from "../store/live";
import type { Store, Theme, TickRange } from "../store/store";
import { Search } from "./panels/search";

const NEXT: Record<Theme, Theme> = { auto: "dark", dark: "light", light: "auto" };

const CONNECTIONS: Record<Connection, string> = {
  connecting: "connecting …", open: "live", lost: "connection lost: trying again", ended: "no more comes",
  asleep: "asleep",
};

// What was asked for is not cut.
function recorded({ from, to }: TickRange): string {
  if (from === undefined && to === undefined) return "recording";
  return `asked for: ${to === undefined ? `tick ${from} and later` : `ticks ${from ?? 0} to ${to}`}`;
}

function State({ store }: { store: Store }) {
  const { live, run } = store;
  const { end } = run;
  const paused = live?.state.state === "paused";
  return (
    <span role="status" class="states">
      {live && !end && <span class={`connection ${live.connection}`}>{CONNECTIONS[live.connection]}</span>}
      {live && !end && paused && <span class="warning">{live.state.attended === false ? "‖ paused: unattended" : "‖ paused"}</span>}
      {!live && <span class="dim">{recorded(store.range)}</span>}
      {end && !store.moment.isLastOfEnded() && <span class="dim">{`ended later: ${end.result}`}</span>}
      {store.moment.isLastOfEnded() && <span class={`result ${end?.result}`}>{`ended: ${end?.result} (${end?.reason})`}</span>}
    </span>
  );
}

// Only a run that goes on reports how long its ticks take.
function Timing({ store }: { store: Store }) {
  const { live, run } = store;
  const overruns = run.end?.overruns ?? live?.state.overruns;
  const { tick_us, late_ms, speed } = live?.state ?? {};
  return (
    <>
      {tick_us !== undefined && <span title="how long the last ticks took">tick takes <b>{tick_us.toFixed(0)} µs</b></span>}
      {late_ms !== undefined && <span class={late_ms > 1000 * run.period ? "warning" : ""}
        title="how long after its time the last tick began">late <b>{late_ms.toFixed(2)} ms</b></span>}
      {run.header?.clock === "virtual" && speed !== undefined && speed !== 1 && !live?.control && <span>speed <b>{speed === 0 ? "as fast as possible" : `${speed}×`}</b></span>}
      {overruns !== undefined && overruns > 0 && <span class="warning">{overruns} overruns</span>}
    </>
  );
}

export function Header({ store }: { store: Store }) {
  const { run } = store, { header, end } = run;
  const { theme, line } = store.looking;
  const { moment } = store;
  return (
    <header>
      <h1 title={header?.file}>{header?.tree ?? "lockstep"}</h1>
      <p class="facts">
        <State store={store} />
        <span>tick <b>{moment.tick}</b>{end && ` of ${run.ticks[run.last] ?? 0}`}</span>
        <span><b>{seconds(moment.time)}</b>{end && ` of ${seconds(run.times[run.last])}`}</span>
        <span class="rate">{header?.rate_hz} Hz, {header?.clock} clock</span>
        <Timing store={store} />
        {store.live && !store.run.end && line !== null && <span class="warning">looking back</span>}
      </p>
      <Search store={store} />
      {store.live && <button type="button" onClick={() => void store.live?.save()} aria-label="save this run"
        title="a page with the whole run in it, as a file">save<span class="wide"> this run</span></button>}
      <button type="button" onClick={() => store.set({ theme: NEXT[theme] })} aria-label={`Theme: ${theme}`}
        title="Dark, light, or as the system has it"><span class="wide">Theme: </span>{theme}</button>
      <button type="button" aria-keyshortcuts="?" onClick={() => store.set({ help: true })}>Help</button>
    </header>
  );
}
