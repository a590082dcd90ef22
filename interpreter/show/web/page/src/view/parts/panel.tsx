// A part of the side: a heading that opens and closes it.
import type { ComponentChildren } from "preact";

interface Props {
  title: string;
  note?: string;
  closed?: boolean;
  children: ComponentChildren;
}

export function Panel({ title, note, closed, children }: Props) {
  return (
    <details class="panel" open={!closed}>
      <summary><h2>{title}</h2>{note && <span class="dim">{note}</span>}</summary>
      {children}
    </details>
  );
}
