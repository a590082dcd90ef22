// In words: what runs, who waits for whom, what happened last.
import type { Moment } from "../../model/moment";
import { RUNNING } from "../../model/recording";
import { waitsOf, type Wait } from "../../model/waiting";
import { seconds } from "../../model/words";
import { LANDMARKS, type RunEvent } from "../../model/events";
import type { Store } from "../store";

const MOST = 8;

// Leaves, since the nodes above them only pass their ticks on.
export function runningLeaves(moment: Moment): number[] {
  return moment.run.shape.nodes
    .filter((node) => node.children.length === 0 && !node.isGroup && moment.status[node.index] === RUNNING &&
      !moment.held[node.index])
    .map((node) => node.index);
}

// How long a node has been as it is.
function heldSince(moment: Moment, node: number): number {
  const { states } = moment.run.nodes[node];
  return moment.time - moment.run.times[states.lines[states.placeAt(moment.line)]];
}

export function lastEvent(moment: Moment): RunEvent | null {
  const { all } = moment.run.events;
  for (let place = moment.run.events.placeAfter(moment.line); place-- > 0; ) {
    if (LANDMARKS.has(all[place].kind) || all[place].kind === "start") return all[place];
  }
  return null;
}

export function eventText(moment: Moment, event: RunEvent): string {
  return event.node === null ? event.text : `${moment.run.shape.nodes[event.node].apart} ${event.text}`;
}

function Name({ store, node }: { store: Store; node: number }) {
  const { apart, path } = store.run.shape.nodes[node];
  return <button type="button" class="node" title={path} onClick={() => store.select(node, true)}>{apart}</button>;
}

function Waiting({ store, moment, wait }: { store: Store; moment: Moment; wait: Wait }) {
  return (
    <li class="held">
      <span aria-hidden="true" class="symbol">‖</span> <Name store={store} node={wait.node} /> {wait.text}
      <span class="number">{moment.progress[wait.node].toFixed(2)}</span>
      <span class="dim">for {heldSince(moment, wait.node).toFixed(2)} s</span>
    </li>
  );
}

export function Now({ store }: { store: Store }) {
  const { moment } = store;
  const running = runningLeaves(moment);
  const waits = waitsOf(moment);
  const last = lastEvent(moment);
  return (
    <section class="now" aria-labelledby="now-title">
      <h2 id="now-title">{moment.isLastOfEnded() ? "At the end" : "Now"}</h2>
      <ul>
        {running.slice(0, MOST).map((node) => (
          <li key={node} class="running">
            <span aria-hidden="true" class="symbol">▶</span> <Name store={store} node={node} /> runs
            <span class="number">{moment.progress[node].toFixed(2)}</span>
          </li>
        ))}
        {running.length > MOST && <li class="dim">and {running.length - MOST} more run</li>}
        {waits.slice(0, MOST).map((wait) => <Waiting key={wait.node} store={store} moment={moment} wait={wait} />)}
        {waits.length > MOST && <li class="dim">and {waits.length - MOST} more wait</li>}
        {running.length + waits.length === 0 && <li class="dim">no leaf runs</li>}
      </ul>
      {last && (
        <p class="last">
          <span class="dim">last, at {seconds(moment.run.times[last.line])}:</span> {eventText(moment, last)}
        </p>
      )}
    </section>
  );
}
