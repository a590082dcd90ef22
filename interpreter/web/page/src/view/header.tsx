// What runs, and where it stands.
import type { Store } from "./store";
import { seconds } from "../model/words";
import type { Theme } from "./store";

const NEXT: Record<Theme, Theme> = { auto: "dark", dark: "light", light: "auto" };

export function Header({ store }: { store: Store }) {
  const { header, end } = store.run;
  const { theme } = store.looking;
  const { moment } = store;
  return (
    <header>
      <h1>{header?.tree ?? "lockstep"}</h1>
      <p class="facts">
        <span>tick <b>{moment.tick}</b></span>
        <span><b>{seconds(moment.time)}</b></span>
        <span>{header?.rate_hz} Hz, {header?.clock} clock</span>
        {end && <span class={`result ${end.result}`}>{end.result} ({end.reason})</span>}
        {end && end.overruns > 0 && <span class="warning">{end.overruns} overruns</span>}
      </p>
      <span class="grow" />
      <button type="button" onClick={() => store.set({ theme: NEXT[theme] })}
        title="Light, dark, or as the system has it">Theme: {theme}</button>
      <button type="button" aria-keyshortcuts="?" onClick={() => store.set({ help: true })}>Help</button>
    </header>
  );
}
