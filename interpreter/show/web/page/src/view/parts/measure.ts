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

// The longest of the texts that fits, of which `cut` gives one for each number of letters that stay.
function longest(length: number, size: number, room: number, weight: number, cut: (letters: number) => string): string {
  let low = 0, high = length;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (textWidth(cut(middle), size, weight) <= room) low = middle;
    else high = middle - 1;
  }
  return cut(low);
}

// Cut at its end, with "…", so that it fits.
export function fitted(text: string, size: number, room: number, weight = 400): string {
  if (textWidth(text, size, weight) <= room) return text;
  return longest(text.length, size, room, weight, (letters) => `${text.slice(0, letters)}…`);
}

// A name, cut in its middle: many differ only at their ends.
export function fittedName(text: string, size: number, room: number, weight = 400): string {
  if (textWidth(text, size, weight) <= room) return text;
  const all = [...text];
  return longest(all.length - 1, size, room, weight, (letters) => {
    const begin = Math.ceil(letters / 2);
    return `${all.slice(0, begin).join("")}…${all.slice(all.length - (letters - begin)).join("")}`;
  });
}
