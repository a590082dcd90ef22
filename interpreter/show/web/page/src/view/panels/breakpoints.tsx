// The breakpoints of a node: a click sets or removes one.
import type { Live, When } from "../../store/live";
import type { Store } from "../../store/store";

export const WHEN: Record<When, string> = {
  begins: "begins", completes: "completes", succeeds: "succeeds", fails: "fails", barrier: "comes to a barrier",
};

// Null: this page has no control, or none any more.
export function controls({ live, run }: Store): Live | null {
  return live?.control && !run.end && live.connection !== "ended" ? live : null;
}

// It is the synchronized node that has the barriers. Null: there is none.
function watched(store: Store, selected: number, when: When): number | null {
  const { nodes } = store.run.shape;
  const compares = (node: number | null) =>
    node !== null && (nodes[node].synchronization === "absolute" || nodes[node].synchronization === "relative");
  if (when !== "barrier" || compares(selected)) return selected;
  return compares(nodes[selected].keeper) ? nodes[selected].keeper : null;
}

export function Breakpoints({ store, node }: { store: Store; node: number }) {
  const live = controls(store);
  if (!live) return null;
  return (
    <p class="buttons filters" role="group" aria-label="Pause the run when this node">
      <span class="dim">pause when it</span>
      {(Object.keys(WHEN) as When[]).map((when) => {
        const at = watched(store, node, when);
        if (at === null) return null;
        const on = live.state.breakpoints?.some((one) => one.node === at && one.when === when) ?? false;
        return (
          <button type="button" key={when} aria-pressed={on} onClick={() => live.order({ do: "break", node: at, when, on: !on })}>
            {WHEN[when]}</button>
        );
      })}
    </p>
  );
}
