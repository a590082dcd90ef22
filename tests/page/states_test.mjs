// The page shows what `lockstep replay --print` prints, at any tick.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { SOURCE, close, eventually, goToTick, lockstep, openRun, record } from "./support.mjs";

after(() => close());

const STATES = { "·": "idle", "▶": "running", "✓": "success", "✗": "failure", "»": "skipped", "‖": "held" };

// "  ▶ arm  [████░░] 0.45  waits for base" as the page says it; a node that is kept has a bar.
function printed(recording, tick) {
  return lockstep("replay", recording, "--at", String(tick), "--print").split("\n").flatMap((line) => {
    const match = line.match(/^( *)([·▶✓✗»‖]) (.*)$/);
    if (!match) return [];
    const bar = match[3].match(/^(.*?) +\[[^\]]*\] ([0-9.]+)(?: {2}(.*))?$/);
    const name = bar ? bar[1] : match[3].replace(/ {2}\d+(\/\d+)?$/, "").replace(/ \([^)]*\)$/, "");
    const text = bar ? (bar[3] ?? "").replace(/^\d+(\/\d+)?( {2}|$)/, "") : "";
    return [{ level: match[1].length / 2 + 1, name, state: STATES[match[2]], progress: bar?.[2], text }];
  });
}

async function shown(page) {
  return page.getByRole("treeitem").evaluateAll((items) => items.map((item) => ({
    label: item.getAttribute("aria-label"), level: Number(item.getAttribute("aria-level")),
  })));
}

function agrees({ label, level }, wanted) {
  const parts = label.split(", ");
  const sentence = wanted.text ? `, ${wanted.text}` : "";
  return level === wanted.level && parts[0] === wanted.name && parts.includes(wanted.state) &&
    (!wanted.progress || label.includes(`, progress ${wanted.progress}`)) && label.endsWith(sentence);
}

// As many as asked for, spread by a generator that gives the same ones each time.
function someTicks(count, most) {
  let state = 12345;
  return Array.from({ length: count }, () => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return Math.floor((state / 2147483648) * most);
  });
}

for (const name of ["fetch_and_carry", "door_pulling", "cart", "nested", "two_robots", "philosophers", "btcpp"]) {
  test(`the states of ${name} at 20 ticks are those of replay`, async () => {
    const recording = record(join(SOURCE, `trees/${name}.xml`));
    // So large that all cards are drawn; with a sixteenth of the pixels, since a processor paints them.
    const page = await openRun(recording, { viewport: { width: 4200, height: 3600 }, deviceScaleFactor: 0.25 });
    const last = Number(await page.getByRole("slider", { name: "Moment" }).getAttribute("aria-valuemax"));
    for (const tick of [0, last, ...someTicks(18, last)]) {
      await goToTick(page, tick);
      const wanted = printed(recording, tick);
      assert.ok(wanted.length > 2);
      await eventually(page, async () => {
        const found = await shown(page);
        assert.equal(found.length, wanted.length);
        wanted.forEach((row, place) => assert.ok(agrees(found[place], row),
          `tick ${tick}: ${JSON.stringify(found[place])} is not ${JSON.stringify(row)}`));
      });
    }
    await page.context().close();
  });
}
