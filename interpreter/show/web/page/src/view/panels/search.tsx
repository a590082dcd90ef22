// Finds nodes by a part of their path.
import { useRef, useState } from "preact/hooks";
import type { Store } from "../../store/store";

const MOST = 12;

function found(store: Store, text: string): number[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0) return [];
  const matches: number[] = [];
  for (const { path, kind, index } of store.run.shape.nodes) {
    const all = `${path} ${kind}`.toLowerCase();
    if (words.every((word) => all.includes(word))) matches.push(index);
    if (matches.length === MOST) break;
  }
  return matches;
}

export function Search({ store }: { store: Store }) {
  const [text, setText] = useState("");
  const [at, setAt] = useState(0);
  const field = useRef<HTMLInputElement>(null);
  const matches = found(store, text);
  const choose = (node: number) => {
    store.set({ follow: false });
    store.select(node, true);
    setText("");
    field.current?.blur();
  };
  const key = (event: KeyboardEvent) => {
    if (event.key === "ArrowDown") setAt(Math.min(at + 1, matches.length - 1));
    else if (event.key === "ArrowUp") setAt(Math.max(at - 1, 0));
    else if (event.key === "Enter" && matches[at] !== undefined) choose(matches[at]);
    else if (event.key === "Escape") {
      if (text === "") (event.target as HTMLElement).blur();
      setText("");
    }
    else return;
    event.preventDefault();
  };
  const open = text.trim() !== "";
  return (
    <div class="search">
      <input id="search" ref={field} role="combobox" aria-label="Find a node" aria-expanded={open}
        aria-controls="found" aria-autocomplete="list" placeholder="find a node (/)" value={text} autocomplete="off"
        aria-activedescendant={open && matches[at] !== undefined ? `found-${matches[at]}` : undefined}
        onInput={(event) => { setText((event.target as HTMLInputElement).value); setAt(0); }} onKeyDown={key} />
      <ul id="found" role="listbox" aria-label="Nodes found" hidden={!open}>
        {matches.map((node, place) => (
          <li key={node} id={`found-${node}`} role="option" aria-selected={place === at}
            onMouseDown={(event) => { event.preventDefault(); choose(node); }}>
            {store.run.shape.nodes[node].path}
          </li>
        ))}
        {open && matches.length === 0 && <li role="option" aria-selected="false" aria-disabled="true">no such node</li>}
      </ul>
    </div>
  );
}
