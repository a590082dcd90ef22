// The whole run, to go to any moment of it.
import { useState } from "preact/hooks";
import { seconds } from "../../model/words";
import { zoomed } from "../../store/span";
import type { Store } from "../../store/store";
import { Grip } from "./grip";
import { Lanes } from "./lanes";
import { Transport } from "./transport";

export function Timeline({ store }: { store: Store }) {
  const { run, line, moment } = store;
  const [all, setAll] = useState(false);
  const [lanes, setLanes] = useState(false); // on a phone
  const go = (event: Event) => store.goTo(Number((event.target as HTMLInputElement).value));
  const zoom = (factor: number) => store.set({ span: zoomed(store, factor, moment.time) });
  return (
    <section class={lanes ? "timeline open" : "timeline"} aria-labelledby="timeline-title">
      <Grip store={store} />
      <h2 id="timeline-title" class="hidden">Timeline</h2>
      <div class="bar-of-buttons">
        <Transport store={store} />
        <p class="key dim" aria-hidden="true">
          <i class="runs" /> runs <i class="is-held" /> held <i class="over success" />✓ succeeded <i class="over failure" />✗ failed
          {run.cuts.length > 0 && <><i class="is-cut" /> cut</>}
        </p>
        <button type="button" class="on-phone" aria-expanded={lanes} onClick={() => setLanes(!lanes)}>lanes</button>
        <span class="grow" />
        <div role="group" aria-label="What the timeline shows" class="zoom buttons">
          <button type="button" aria-pressed={all} onClick={() => setAll(!all)}
            title="A lane for each node, not only for leaves and those that wait for each other">all nodes</button>
          <button type="button" aria-label="zoom in" title="zoom in (+)" onClick={() => zoom(0.5)}>+</button>
          <button type="button" aria-label="zoom out" title="zoom out (-)" onClick={() => zoom(2)}>−</button>
          <button type="button" aria-pressed={store.looking.span === null} title="the whole run (0)" onClick={() => store.set({ span: null })}>whole run</button>
        </div>
      </div>
      <Lanes store={store} all={all} />
      <input type="range" aria-label="Moment" min={0} max={Math.max(0, run.last)} value={line} onInput={go}
        aria-valuetext={`tick ${moment.tick}, ${seconds(moment.time)}`} />
    </section>
  );
}
