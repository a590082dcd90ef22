// The whole run, to go to any moment of it.
import { seconds } from "../../model/words";
import type { Store } from "../store";

export function Timeline({ store }: { store: Store }) {
  const { run, line, moment } = store;
  const go = (event: Event) => store.goTo(Number((event.target as HTMLInputElement).value));
  return (
    <section class="timeline" aria-labelledby="timeline-title">
      <h2 id="timeline-title">Timeline</h2>
      <div class="transport" role="group" aria-label="Go to a moment">
        <button type="button" aria-keyshortcuts="[" title="previous event ([)" onClick={() => store.goToEvent(-1)}>⇤ event</button>
        <button type="button" aria-keyshortcuts="," title="one tick back (,)" onClick={() => store.step(-1)}>‹ tick</button>
        <button type="button" aria-keyshortcuts="." title="one tick forward (.)" onClick={() => store.step(1)}>tick ›</button>
        <button type="button" aria-keyshortcuts="]" title="next event (])" onClick={() => store.goToEvent(1)}>event ⇥</button>
        <button type="button" onClick={() => store.set({ line: null })} aria-pressed={store.looking.line === null}>newest</button>
      </div>
      <input type="range" aria-label="Moment" min={0} max={Math.max(0, run.last)} value={line} onInput={go}
        aria-valuetext={`tick ${moment.tick}, ${seconds(moment.time)}`} />
    </section>
  );
}
