// How wide texts are, without asking the document for a layout.
const FONT = "system-ui, sans-serif";
const context = document.createElement("canvas").getContext("2d");
const known = new Map<string, number>();

export function textWidth(text: string, size: number, weight = 400): number {
  const key = `${weight} ${size} ${text}`;
  let width = known.get(key);
  if (width === undefined) {
    if (known.size > 20000) known.clear();
    if (context) context.font = `${weight} ${size}px ${FONT}`;
    width = context ? context.measureText(text).width : text.length * size * 0.6;
    known.set(key, width);
  }
  return width;
}

// Cut at its end, with "…", so that it fits.
export function fitted(text: string, size: number, room: number, weight = 400): string {
  if (textWidth(text, size, weight) <= room) return text;
  let low = 0, high = text.length;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (textWidth(`${text.slice(0, middle)}…`, size, weight) <= room) low = middle;
    else high = middle - 1;
  }
  return `${text.slice(0, low)}…`;
}
