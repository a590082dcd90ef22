// Goes through the run: ticks, events, play, a number.
import { useEffect, useState } from "preact/hooks";
import type { Store } from "../../store/store";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 100];

// Advances with the time of the run.
function usePlaying(store: Store) {
  const { playing } = store.looking;
  useEffect(() => {
    if (!playing) return;
    let frame = 0, before = performance.now(), time = store.moment.time;
    const advance = (now: number) => {
      time += ((now - before) / 1000) * store.looking.speed;
      before = now;
      store.show(store.run.lineAtTime(time));
      if (store.line >= store.run.last) store.set({ playing: false });
      else frame = requestAnimationFrame(advance);
    };
    frame = requestAnimationFrame(advance);
    return () => cancelAnimationFrame(frame);
  }, [playing, store]);
}

// From the moment in which someone begins to type, it stays as it is, however the run goes on.
function TickField({ store }: { store: Store }) {
  const [typed, setTyped] = useState<string | null>(null);
  const key = (event: KeyboardEvent) => {
    if (event.key !== "Enter") return;
    const text = (event.target as HTMLInputElement).value.trim();
    if (/^\d+$/.test(text)) store.goTo(store.run.lineAtTick(Number(text)));
    setTyped(null);
  };
  return (
    <input class="tick" aria-label="Tick" inputMode="numeric" value={typed ?? store.moment.tick} size={7} onKeyDown={key}
      onInput={(event) => setTyped((event.target as HTMLInputElement).value)} onBlur={() => setTyped(null)}
      onFocus={(event) => {
        const field = event.target as HTMLInputElement;
        setTyped(field.value);
        field.select();
      }} />
  );
}

export function Transport({ store }: { store: Store }) {
  const { looking } = store;
  usePlaying(store);
  return (
    <div class="buttons" role="group" aria-label="Go to a moment">
      <button type="button" aria-keyshortcuts="[" aria-label="previous event" title="previous event ([)"
        onClick={() => store.goToEvent(-1)}>⇤</button>
      <button type="button" aria-keyshortcuts="," aria-label="one tick back" title="one tick back (,)"
        onClick={() => store.step(-1)}>‹</button>
      <button type="button" class="play" aria-keyshortcuts="Space" aria-pressed={looking.playing}
        title="play the recorded run (space)" onClick={() => store.play()}>
        {looking.playing ? "‖ stop" : "▶ play"}</button>
      <button type="button" aria-keyshortcuts="." aria-label="one tick forward" title="one tick forward (.)"
        onClick={() => store.step(1)}>›</button>
      <button type="button" aria-keyshortcuts="]" aria-label="next event" title="next event (])"
        onClick={() => store.goToEvent(1)}>⇥</button>
      <button type="button" aria-keyshortcuts="End" aria-pressed={looking.line === null} title="the newest tick (n)"
        onClick={() => store.set({ line: null, playing: false })}>newest</button>
      <label>tick <TickField store={store} /></label>
      <select class="speed" aria-label="Speed of playing" value={looking.speed}
        onChange={(event) => store.set({ speed: Number((event.target as HTMLSelectElement).value) })}>
        {SPEEDS.map((speed) => <option key={speed} value={speed}>{`${speed}×`}</option>)}
      </select>
    </div>
  );
}
