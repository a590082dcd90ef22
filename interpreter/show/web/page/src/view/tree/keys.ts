// The keys of a tree, as in any other: up and down through what is shown, right and left through its depth.
import { isOpen } from "../../model/folds";
import type { Store } from "../../store/store";

export function treeKey(store: Store, shown: number[], event: KeyboardEvent) {
  if (event.altKey || event.ctrlKey || event.metaKey || shown.length === 0) return;
  const { looking, moment } = store;
  const { nodes } = moment.run.shape;
  const at = Math.max(0, shown.indexOf(looking.selected ?? -1));
  const node = nodes[shown[at]];
  const open = isOpen(moment, looking.folds, looking.onlyActive, node.index);
  const isInner = node.children.length > 0;
  const select = (index: number) => store.select(index);
  const nothing = looking.selected === null;
  const moves: Record<string, () => void> = {
    ArrowDown: () => select(nothing ? shown[0] : shown[Math.min(at + 1, shown.length - 1)]),
    ArrowUp: () => select(shown[Math.max(at - 1, 0)]),
    Home: () => select(shown[0]),
    End: () => select(shown[shown.length - 1]),
    ArrowRight: () => isInner && (open ? select(node.children[0]) : store.fold(node.index, true)),
    ArrowLeft: () => {
      if (isInner && open) store.fold(node.index, false);
      else if (node.parent !== null) select(node.parent);
    },
    Enter: () => isInner && store.fold(node.index, !open),
  };
  const move = event.shiftKey ? undefined : moves[event.key];
  if (!move) return;
  move();
  event.preventDefault();
  event.stopPropagation();
}
