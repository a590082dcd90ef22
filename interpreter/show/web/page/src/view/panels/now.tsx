// In words: what runs, who waits for whom, what happened last.
import { decidingPath } from "../../model/decision";
import type { EventKind, RunEvent } from "../../model/events";
import type { Moment } from "../../model/moment";
import { reasonOf } from "../../model/reasons";
import { RUNNING, STATUSES, SUCCESS } from "../../model/recording";
import { paceText, waiting, waitOf } from "../../model/waiting";
import { seconds, symbolOf } from "../../model/words";
import type { Store } from "../../store/store";
import { Bar } from "../parts/bar";
import { eventText } from "./event_text";

const MOST = 8;
// The events of the tree; how punctual it was is told elsewhere.
const TOLD: ReadonlySet<EventKind> = new Set<EventKind>([
  "start", "success", "failure", "halt", "hold", "release", "fault", "lost", "end",
]);

// Leaves, since the nodes above them only pass their ticks on.
function runningLeaves(moment: Moment): number[] {
  return moment.run.shape.nodes
    .filter((node) => node.children.length === 0 && !node.isGroup && moment.status[node.index] === RUNNING &&
      !moment.held[node.index])
    .map((node) => node.index);
}

// For how long a node has waited: it is as it is, or, in a pool, needs what it needs.
function waitedFor(moment: Moment, node: number): number {
  const { run, line, time } = moment;
  const { nodes } = run.shape, { keeper } = nodes[node];
  const isInPool = keeper !== null && nodes[keeper].synchronization === "resources";
  const changes = (isInPool && run.limits.get(node - 1)) || run.nodes[node].states;
  const place = changes.placeAt(line);
  return place < 0 ? 0 : time - run.times[changes.lines[place]];
}

function lastEvent(moment: Moment): RunEvent | null {
  const { all } = moment.run.events;
  for (let place = moment.run.events.placeAfter(moment.line); place-- > 0; ) {
    if (TOLD.has(all[place].kind)) return all[place];
  }
  return null;
}

// The part of the tree in which all of them are, from the root down, by the names that someone has given.
function task(moment: Moment, leaves: number[]): string {
  const { nodes } = moment.run.shape;
  const above = (node: number) => {
    const path: number[] = [];
    for (let up = nodes[node].parent; up !== null; up = nodes[up].parent) path.unshift(up);
    return path;
  };
  const paths = leaves.map(above);
  const common = (paths[0] ?? []).filter((node, place) => paths.every((path) => path[place] === node));
  const names = common.filter((node) => nodes[node].segment !== nodes[node].kind).map((node) => nodes[node].segment);
  return names.join(" › ");
}

function Progress({ moment, node }: { moment: Moment; node: number }) {
  const value = moment.progress[node];
  return (
    <span class="progress">
      <svg class="meter" width={64} height={14} aria-hidden="true">
        <Bar moment={moment} node={node} place={{ x: 0, y: 3, width: 64, height: 8 }} />
      </svg>
      <span class="number">{value.toFixed(2)}</span>
    </span>
  );
}

function Name({ store, node }: { store: Store; node: number }) {
  const { apart, path } = store.run.shape.nodes[node];
  return <button type="button" class="node" title={path} onClick={() => store.select(node, true)}>{apart}</button>;
}

function Reason({ moment, node }: { moment: Moment; node: number }) {
  const reason = reasonOf(moment, node);
  return reason ? <span class="reason">{`: ${reason}`}</span> : null;
}

function Waiting({ store, moment, node }: { store: Store; moment: Moment; node: number }) {
  const wait = waitOf(moment, node);
  return (
    <li class="held">
      <span aria-hidden="true" class="symbol">‖</span>
      <span>
        <Name store={store} node={node} /> {wait?.text || "waits"}{" "}
        <span class="dim">for {waitedFor(moment, node).toFixed(2)} s</span>
      </span>
      <Progress moment={moment} node={node} />
    </li>
  );
}

// Why it was no success. Of a deep tree the last nodes: above them a result is mostly passed on.
function Decision({ store, moment }: { store: Store; moment: Moment }) {
  const decision = decidingPath(moment);
  if (decision.length === 0 || moment.status[0] === SUCCESS) return null;
  const { nodes } = moment.run.shape;
  const shown = decision.slice(-MOST);
  return (
    <div class="decision">
      <p><span class="dim">{STATUSES[moment.status[0]]}, decided by</span>{" "}
        <Name store={store} node={decision[decision.length - 1].node} /></p>
      <ol aria-label="What decided, from the root down">
        {decision.length > shown.length && <li class="dim">{`… ${decision.length - shown.length} more above`}</li>}
        {shown.map(({ node, children, agreeing }) => (
          <li key={node} class={STATUSES[moment.status[node]]}>
            <span aria-hidden="true" class="symbol">{symbolOf(moment, node)}</span>
            <span>
              <button type="button" class="node" title={nodes[node].path} onClick={() => store.select(node, true)}>{nodes[node].segment}</button>
              {`${nodes[node].kind === nodes[node].segment ? "" : ` (${nodes[node].kind})`}: ${STATUSES[moment.status[node]]}`}
              {agreeing > 1 && <span class="dim">{` (${agreeing} of ${children} children)`}</span>}
              <Reason moment={moment} node={node} />
            </span>
          </li>
        ))}
      </ol>
    </div>
  );
}

export function Now({ store }: { store: Store }) {
  const { moment } = store;
  const running = runningLeaves(moment);
  const waits = waiting(moment);
  const last = lastEvent(moment);
  const where = task(moment, [...running, ...waits].slice(0, 200));
  return (
    <section class="now" aria-labelledby="now-title">
      <h2 id="now-title">{moment.isLastOfEnded() ? "At the end" : "Now"}</h2>
      {where && <p class="where"><span class="dim">in</span> {where}</p>}
      <ul>
        {running.slice(0, MOST).map((node) => (
          <li key={node} class="running">
            <span aria-hidden="true" class="symbol">▶</span>
            <span><Name store={store} node={node} /> runs{paceText(moment, node) && ` ${paceText(moment, node)}`}<Reason moment={moment} node={node} /></span>
            <Progress moment={moment} node={node} />
          </li>
        ))}
        {running.length > MOST && <li class="dim">and {running.length - MOST} more run</li>}
        {waits.slice(0, MOST).map((node) => <Waiting key={node} store={store} moment={moment} node={node} />)}
        {waits.length > MOST && <li class="dim">and {waits.length - MOST} more wait</li>}
        {running.length + waits.length === 0 && <li class="dim">no leaf runs</li>}
      </ul>
      <Decision store={store} moment={moment} />
      {last && (
        <p class="last">
          <span class="dim">last, at {seconds(moment.run.times[last.line])}:</span> {eventText(store, last)}
        </p>
      )}
    </section>
  );
}
