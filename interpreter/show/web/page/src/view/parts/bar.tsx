// The progress of a node, with the barriers or the delta band of the node that holds it.
import type { Moment } from "../../model/moment";
import { FAILURE } from "../../model/recording";
import { isLimit, marksOf, short, spanOf } from "../../model/waiting";
import { stateOf } from "../../model/words";

interface Place {
  x: number;
  y: number;
  width: number;
  height: number;
}

export function Bar({ moment, node, place }: { moment: Moment; node: number; place: Place }) {
  const { keeper } = moment.run.shape.nodes[node];
  const inStep = keeper !== null && moment.run.shape.nodes[keeper].synchronization !== "resources";
  const { x, y, width, height } = place;
  const done = Math.max(0, Math.min(1, moment.progress[node])) * width;
  return (
    <g class={`bar ${stateOf(moment, node)}`}>
      <rect class="rest" x={x} y={y} width={width} height={height} rx={2} />
      {inStep && <Band moment={moment} keeper={keeper} place={place} />}
      {done > 0 && <rect class="done" x={x} y={y} width={done} height={height} rx={2} />}
      {moment.status[node] === FAILURE && <Broken x={x + done} place={place} />}
      {inStep && <Marks moment={moment} keeper={keeper} place={place} />}
    </g>
  );
}

// Where a node failed, its bar ends in a cross; the rest of it is struck out.
function Broken({ x, place: { x: left, y, width, height } }: { x: number; place: Place }) {
  const arm = 4, middle = y + height / 2, at = Math.max(left + arm, Math.min(left + width - arm, x));
  return (
    <g class="broken">
      <line x1={at} x2={left + width} y1={middle} y2={middle} />
      <path class="around" d={cross(at, middle, arm)} />
      <path d={cross(at, middle, arm)}><title>failed</title></path>
    </g>
  );
}

function cross(x: number, y: number, arm: number): string {
  return `M${x - arm} ${y - arm}L${x + arm} ${y + arm}M${x - arm} ${y + arm}L${x + arm} ${y - arm}`;
}

function Band({ moment, keeper, place }: { moment: Moment; keeper: number; place: Place }) {
  const it = moment.run.shape.nodes[keeper];
  if (it.synchronization !== "relative") return null;
  const { least, most } = spanOf(moment, it);
  const width = Math.max(0, most - least) * place.width;
  return <rect class="band" x={place.x + least * place.width} y={place.y} width={width} height={place.height} />;
}

// The current barrier, or the end of the band, stands out.
function Marks({ moment, keeper, place }: { moment: Moment; keeper: number; place: Place }) {
  const it = moment.run.shape.nodes[keeper];
  const { most } = spanOf(moment, it);
  return (
    <>
      {marksOf(moment, it).map((mark) => {
        const current = isLimit(mark, most);
        const beyond = current ? 3 : 1;
        const x = place.x + mark * place.width;
        return (
          <line key={mark} class={current ? "mark current" : "mark"} x1={x} x2={x}
            y1={place.y - beyond} y2={place.y + place.height + beyond}>
            <title>{`${current ? "the current limit" : "barrier"} ${short(mark)}`}</title>
          </line>
        );
      })}
    </>
  );
}

// The race of a synchronized node: where each child is that it holds.
export function Race({ moment, node, place }: { moment: Moment; node: number; place: Place }) {
  const { x, y, width, height } = place;
  return (
    <g class="race">
      <rect class="rest" x={x} y={y} width={width} height={height} rx={2} />
      <Band moment={moment} keeper={node} place={place} />
      <Marks moment={moment} keeper={node} place={place} />
      {moment.run.shape.nodes[node].inStep.slice(0, 64).map((child) => (
        <circle key={child} class={`runner ${stateOf(moment, child)}`} r={height / 2}
          cx={x + moment.progress[child] * width} cy={y + height / 2} />
      ))}
    </g>
  );
}
