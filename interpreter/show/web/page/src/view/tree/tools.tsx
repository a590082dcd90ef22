// How the tree is drawn.
import type { Looking, Store } from "../../store/store";

export function Tools({ store, looking }: { store: Store; looking: Looking }) {
  const { arrangement, follow, onlyActive, zoom } = looking;
  const other = arrangement === "outline" ? "diagram" : "outline";
  return (
    <div class="tools buttons" role="group" aria-label="How the tree is drawn">
      <button type="button" aria-keyshortcuts="f" aria-pressed={follow} title="keep what runs in sight (f)"
        onClick={() => store.set({ follow: !follow })}>follow</button>
      <button type="button" aria-keyshortcuts="a" aria-pressed={onlyActive} title="fold what does not run (a)"
        onClick={() => store.set({ onlyActive: !onlyActive, folds: new Map() })}>only what runs</button>
      <button type="button" aria-keyshortcuts="t" title={`draw it as ${other === "outline" ? "an outline" : "a diagram"} (t)`}
        onClick={() => store.set({ arrangement: other })}>{other}</button>
      <button type="button" aria-keyshortcuts="Shift+F" aria-pressed={zoom === null} title="all of the tree in sight (F)"
        onClick={() => store.fit()}>fit</button>
      <button type="button" aria-label="tree larger" title="larger (z)" onClick={() => store.magnify(1.2)}>+</button>
      <button type="button" aria-label="tree smaller" title="smaller (Z)" onClick={() => store.magnify(1 / 1.2)}>−</button>
    </div>
  );
}
