// The keys and the signs.
import { useEffect, useRef } from "preact/hooks";
import type { Store } from "../../store/store";

const KEYS = [
  [", .", "a tick back, forward"],
  ["< >", "ten ticks back, forward"],
  ["[ ]", "to the previous, the next of the events that are chosen"],
  ["space", "play the recorded run, stop"],
  ["n", "the newest tick; of a live run: stay there"],
  ["+ - 0", "zoom the timeline; the whole run"],
  ["↑ ↓ ← →", "in the tree: another node; fold, unfold"],
  ["/", "find a node"],
  ["f", "keep what runs in sight, or not"],
  ["a", "fold what does not run, or nothing"],
  ["t", "the tree as a diagram or as an outline"],
  ["F", "all of the tree in sight"],
  ["z Z", "the tree larger, smaller: also the wheel"],
  ["shift ↑", "with any arrow: pan the tree; also a drag"],
  ["p", "with control: pause and resume the run"],
  ["s", "with control: one tick, while paused"],
  ["?", "this help"],
];
const SIGNS = [
  ["▶", "runs"], ["‖", "is held: waits at a barrier, in a delta band, or for resources"], ["✓", "succeeded"],
  ["✗", "failed"], ["»", "was skipped"], ["·", "is idle"],
  ["┃", "in a bar: a barrier; the thick one is the limit now"],
  ["➜", "from a node that waits to the one that it waits for"],
];

function Rows({ rows }: { rows: string[][] }) {
  return <dl>{rows.map(([key, text]) => <div key={key}><dt>{key}</dt><dd>{text}</dd></div>)}</dl>;
}

export function Help({ store }: { store: Store }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const { help } = store.looking;
  useEffect(() => {
    if (help && !dialog.current?.open) dialog.current?.showModal();
    if (!help) dialog.current?.close();
  }, [help]);
  const licenses = document.querySelector<HTMLTemplateElement>("#licenses")?.content.textContent ?? "";
  return (
    <dialog ref={dialog} aria-labelledby="help-title" onClose={() => help && store.set({ help: false })}>
      <h2 id="help-title">Help</h2>
      <div class="columns">
        <section aria-label="Keys"><Rows rows={KEYS} /></section>
        <section aria-label="Signs"><Rows rows={SIGNS} /></section>
      </div>
      <form method="dialog"><button type="submit" autofocus onClick={() => store.set({ help: false })}>Close</button></form>
      <details><summary>Licenses of what is in this page</summary><pre tabIndex={0}>{help ? licenses : ""}</pre></details>
    </dialog>
  );
}
