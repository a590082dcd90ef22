// The colors of the style sheet, for what is drawn on a canvas.
const NAMES = ["text", "dim", "faint", "line", "panel", "page", "running", "held", "success", "failure", "mark"] as const;
export type Colors = Record<(typeof NAMES)[number] | `series${number}`, string>;

export const SERIES = 6;

let known: { key: string; colors: Colors } | null = null;
const dark = matchMedia("(prefers-color-scheme: dark)");

export function colors(): Colors {
  const key = `${document.documentElement.dataset.theme} ${dark.matches}`;
  if (known?.key === key) return known.colors;
  const probe = document.body.appendChild(document.createElement("i"));
  const resolve = (name: string) => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const found: Record<string, string> = {};
  for (const name of NAMES) found[name] = resolve(name);
  for (let series = 0; series < SERIES; ++series) found[`series${series}`] = resolve(`series${series}`);
  probe.remove();
  known = { key, colors: found as Colors };
  return known.colors;
}

export function onColorChange(act: () => void): () => void {
  dark.addEventListener("change", act);
  return () => dark.removeEventListener("change", act);
}
