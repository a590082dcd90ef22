// What the run asks, with a button for each answer; and the switch of who attends it.
import { useEffect, useState } from "preact/hooks";
import { type Question, questionsOf } from "../../model/questions";
import type { Live } from "../../store/live";
import type { Store } from "../../store/store";
import { controls } from "./breakpoints";

const RENEWAL = 500; // milliseconds

function Asked({ store, question, live }: { store: Store; question: Question; live: Live | null }) {
  const { node, text, options, severity, left, fallback } = question;
  const isNow = store.looking.line === null;
  const answer = (option: string) =>
    live?.order({ do: "answer", node, answer: option, seen: store.moment.tick }, `${option} from the next tick on`);
  return (
    <div class={`question ${severity}`} role="group" aria-label={`Question of ${store.run.shape.nodes[node].apart}`}>
      <p><button type="button" class="node" onClick={() => store.select(node, true)}>{store.run.shape.nodes[node].apart}</button>
        {" asks: "}<b>{text}</b></p>
      <p class="buttons">
        {options.map((option) => (
          <button type="button" key={option} disabled={!live || !isNow} onClick={() => void answer(option)}>{option}</button>
        ))}
        {left !== null && <span class="dim">{`in ${Math.ceil(left)} s: ${fallback || "it fails"}`}</span>}
        {store.live && !store.live.control && <span class="dim">to answer here, start the run with --monitor-control</span>}
      </p>
    </div>
  );
}

export function Questions({ store }: { store: Store }) {
  const questions = questionsOf(store.moment);
  if (questions.length === 0 || store.run.end) return null;
  const live = controls(store);
  return (
    <section class="questions" aria-label="Questions" role="alert">
      {questions.map((it) => <Asked key={it.node} store={store} question={it} live={live} />)}
    </section>
  );
}

// Renews while the page is in front.
export function Attend({ live }: { live: Live }) {
  const [on, setOn] = useState(false);
  useEffect(() => {
    if (!on) return;
    const renew = () => {
      if (document.visibilityState === "visible" && document.hasFocus()) void live.order({ do: "attend" }, live.notice);
    };
    renew();
    const timer = setInterval(renew, RENEWAL);
    return () => clearInterval(timer);
  }, [on, live]);
  if (live.state.attended === undefined) return null;
  return (
    <label class={live.state.attended ? "" : "warning"} title="the run pauses while it is unattended; this page attends while it is in front">
      <input type="checkbox" checked={on} onChange={() => setOn(!on)} /> attend</label>
  );
}
