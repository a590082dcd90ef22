// What a person finds on the page of a recording, by role and name.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { SOURCE, close, goToTick, lockstep, openRun, record, recordOverCut, soon, tree, violations } from "./support.mjs";

after(() => close());

let door;
before(() => {
  door = record(join(SOURCE, "trees/door_pulling.xml"));
});

const node = (page, name) => page.getByRole("treeitem", { name: new RegExp(`^${name}[,:]`) });
const words = async (locator) => (await locator.innerText()).replace(/\s+/g, " ");
const label = (page, name) => node(page, name).getAttribute("aria-label");
async function atTick(page, tick) {
  await goToTick(page, tick);
  await page.getByRole("slider", { name: "Moment" }).and(page.locator(`[aria-valuetext^="tick ${tick},"]`)).waitFor();
}

test("a person sees who waits for whom at which barrier, how far each is, and what happened last", async () => {
  const page = await openRun(door);
  await atTick(page, 400);
  await soon.equal(page, () => label(page, "base"), "base, BackAway, held, progress 0.50, waits for arm at barrier 0.5");
  await soon.match(page, () => label(page, "arm"), /^arm, PullDoor, running, progress 0\.4\d$/);
  const now = page.getByRole("region", { name: "Now" });
  await soon.match(page, () => words(now), /arm runs/);
  await soon.match(page, () => words(now), /base waits for arm at barrier 0\.5/);
  await soon.match(page, () => words(now), /last, at 3\.420 s: base waits for arm at barrier 0\.5/);
  const progress = page.getByRole("list", { name: "Progress of pull at this moment" });
  await soon.match(page, () => words(progress), /base 0\.50 waits for arm at barrier 0\.5/);
  await soon.ok(page, () => page.getByRole("img", { name: "Progress over time of arm, base" }).isVisible());
  await page.context().close();
});

test("the timeline marks where the process was cut and the run continued", async () => {
  const recording = await recordOverCut(tree('<Advance step="0.002"/>')); // 500 ticks, as a line each
  // A machine that is busy skips ticks before the cut. The rest is on the virtual clock, at 100 Hz.
  const lines = readFileSync(recording, "utf8").split("\n").filter((line) => line.startsWith('{"tick"'));
  const before = JSON.parse(lines.at(-1)).time_s, share = before / (before + (500 - lines.length) / 100);
  const page = await openRun(recording);
  const mark = page.getByRole("img", { name: /^the process was cut here, and the run continued after \d+(\.\d)? s$/ });
  await soon.equal(page, () => mark.count(), 1);
  const lanes = await page.getByRole("group", { name: "Lanes of the nodes" }).boundingBox(), cut = await mark.boundingBox();
  const first = lanes.x + 170, at = (cut.x - first) / (lanes.x + lanes.width - first);
  assert.ok(Math.abs(at - share) < 0.1, `the cut is at ${at.toFixed(2)} of the run, and ${share.toFixed(2)} was recorded before it`);
  await page.context().close();
});

test("keys go through ticks and events", async () => {
  const page = await openRun(door);
  await atTick(page, 400);
  const moment = () => page.getByRole("slider", { name: "Moment" }).getAttribute("aria-valuetext");
  await page.getByRole("tree").focus();
  const after = async (key, text) => {
    await page.keyboard.press(key);
    await page.locator(`input[aria-valuetext^="${text}"]`).waitFor().catch(async () =>
      assert.fail(`after ${key}: ${await moment()}, not ${text}`));
  };
  await after(".", "tick 401,");
  await after(",", "tick 400,");
  await after(">", "tick 410,");
  await after("<", "tick 400,");
  await after("[", "tick 342,"); // base is held
  await after("]", "tick 412,"); // it goes on
  await after("n", "tick 700,");
  await page.context().close();
});

test("the tree folds, unfolds and is gone through with keys", async () => {
  const page = await openRun(door);
  await atTick(page, 400);
  await page.getByRole("tree").focus();
  await page.keyboard.press("ArrowDown");
  await page.locator('[role="treeitem"][aria-selected="true"][aria-label^="open"]').waitFor();
  for (const key of ["ArrowDown", "ArrowDown", "ArrowDown"]) await page.keyboard.press(key);
  await page.locator('[role="treeitem"][aria-selected="true"][aria-label^="pull"]').waitFor();
  await page.keyboard.press("ArrowLeft");
  await node(page, "base").waitFor({ state: "detached" });
  await soon.equal(page, () => node(page, "pull").getAttribute("aria-expanded"), "false");
  await page.keyboard.press("Enter");
  await node(page, "base").waitFor();
  await page.keyboard.press("t");
  await page.getByRole("button", { name: "diagram" }).waitFor();
  await soon.equal(page, () => page.getByRole("treeitem").count(), 7);
  await page.context().close();
});

test("a node that is found is shown with its history", async () => {
  const page = await openRun(door);
  await page.keyboard.press("/");
  await page.keyboard.type("pull base");
  await page.getByRole("option", { name: "OpenDoor/open/pull/base" }).waitFor();
  await page.keyboard.press("Enter");
  await page.getByText("OpenDoor/open/pull/base", { exact: true }).waitFor();
  const history = page.getByRole("table", { name: "Activations, newest first" });
  await soon.match(page, () => words(history), /1\.730 s\s+4\.\d+ s\s+1\.990 s\s+success|1\.730 s/);
  await history.getByRole("button", { name: "1.730 s" }).click();
  await page.locator('input[aria-valuetext^="tick 173,"]').waitFor();
  await page.context().close();
});

test("a click on the timeline goes there, and what it shows can be enlarged", async () => {
  const page = await openRun(door);
  const lanes = page.getByRole("group", { name: "Lanes of the nodes" });
  const labels = () => lanes.getByRole("button").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
  await soon.deepEqual(page, labels, [
    "reach: succeeded once", "grasp: succeeded once", "arm: succeeded once",
    "base: held 3 times for 2.11 s, succeeded once", "release: succeeded once",
  ]);
  const drawing = await page.locator(".drawing").boundingBox();
  const middle = drawing.x + (drawing.width - 18) / 2; // at its end is room for signs
  await page.mouse.click(middle, drawing.y + 10);
  await page.locator('input[aria-valuetext^="tick 350,"]').waitFor();
  await page.getByRole("button", { name: "zoom in" }).click();
  await page.getByRole("button", { name: "whole run", pressed: false }).waitFor();
  await page.mouse.click(middle + 1, drawing.y + 10);
  await page.locator('input[aria-valuetext^="tick 350,"]').waitFor();
  await page.mouse.click(drawing.x + drawing.width - 1, drawing.y + 10);
  await page.locator('input[aria-valuetext^="tick 52"]').waitFor();
  await page.context().close();
});

test("entries, logs and events are those of the moment", async () => {
  const page = await openRun(record(join(SOURCE, "trees/fetch_and_carry.xml")));
  const board = page.getByRole("table", { name: "Blackboard" });
  await atTick(page, 1000);
  const row = board.getByRole("row", { name: /found_at/ });
  await soon.doesNotMatch(page, () => words(row), /counter/);
  await atTick(page, 1300);
  await soon.match(page, () => words(row), /counter\s+11\.970 s/);
  await row.getByRole("button").click();
  await soon.match(page, () => words(board), /by kitchen\/…\/LookFor counter 11\.970 s/);
  const events = page.getByRole("list", { name: "Events" });
  await soon.match(page, () => words(events), /LookFor: sees the mug at the counter/);
  await page.getByRole("button", { name: "logs" }).click();
  await events.getByText("sees the mug").waitFor({ state: "detached" });
  await soon.match(page, () => words(events), /found_at = counter/);
  await page.context().close();
});

test("a page of a part has the values from before it, without a time", async () => {
  const recording = record(tree('<Sequence memory="true"><Script code="goal := 3; count := 0"/><Repeat><Sequence memory="true">' +
    '<Advance step="0.002"/><Script code="count := count + 1"/></Sequence></Repeat></Sequence>'));
  const page = await openRun(recording, undefined, "--from", "4400");
  const board = page.getByRole("table", { name: "Blackboard" });
  await atTick(page, 4200);
  await soon.match(page, () => words(board), /goal 3 earlier count 8 earlier/);
  await atTick(page, 4800);
  await soon.match(page, () => words(board), /goal 3 earlier count 9 44\.990 s/);
  await page.context().close();
});

test("text of a tree is text, never markup", async () => {
  const name = "&lt;img src=x onerror=document.title='broken'&gt;";
  const page = await openRun(record(tree(`<Sequence name="${name}" memory="true"><Advance name="${name}" step="0.1"/></Sequence>`)));
  const text = "<img src=x onerror=document.title='broken'>";
  await soon.equal(page, () => page.getByRole("treeitem", { name: text }).count(), 2);
  await page.getByRole("treeitem", { name: text }).first().click();
  assert.equal(await page.locator("img").count(), 0);
  assert.equal(await page.title(), "Test · lockstep");
  await page.context().close();
});

test("axe finds nothing serious, in light, dark and on a phone", async () => {
  for (const options of [{ colorScheme: "light" }, { colorScheme: "dark" }, { viewport: { width: 390, height: 844 } }]) {
    const page = await openRun(door, options);
    await atTick(page, 400);
    await node(page, "base").click();
    assert.deepEqual(await violations(page), []);
    await page.keyboard.press("?");
    await page.getByRole("dialog").waitFor();
    assert.deepEqual(await violations(page), []);
    await page.context().close();
  }
});

test("the theme is that of the system until another is chosen", async () => {
  const page = await openRun(door, { colorScheme: "dark" });
  const background = () => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  await soon.equal(page, background, "rgb(16, 20, 26)");
  await page.getByRole("button", { name: "Theme: auto" }).click();
  await page.getByRole("button", { name: "Theme: dark" }).click();
  await page.getByRole("button", { name: "Theme: light" }).waitFor();
  await soon.equal(page, background, "rgb(244, 246, 248)");
  await page.context().close();
});

test("playing goes on to the end", async () => {
  const page = await openRun(door);
  await page.getByRole("combobox", { name: "Speed of playing" }).selectOption("100×");
  await page.getByRole("button", { name: "play" }).click();
  await page.locator('input[aria-valuetext^="tick 700,"]').waitFor();
  await page.getByRole("button", { name: "▶ play" }).waitFor();
  await page.context().close();
});

test("a pool that is not needed any more has not been halted", async () => {
  const page = await openRun(record(join(SOURCE, "trees/philosophers.xml")));
  await page.keyboard.press("n");
  const events = page.getByRole("list", { name: "Events" });
  await events.getByText("run ended: success").waitFor();
  await soon.doesNotMatch(page, () => words(events), /forks (halted|started)/);
  await page.context().close();
});

test("a name that is too long is cut in its middle, in the tree and on the timeline", async () => {
  const names = ["the_arm_of_the_robot_that_stands_on_the_left_side_of_the_table_1", "the_arm_of_the_robot_that_stands_on_the_left_side_of_the_table_2"];
  const page = await openRun(record(tree(`<Parallel>${names.map((name) => `<Advance name="${name}" step="0.1"/>`).join("")}</Parallel>`)));
  const shown = page.locator(".card .name, .lane").filter({ hasText: "the_arm" });
  await soon.equal(page, () => shown.count(), 4);
  for (const text of await shown.allInnerTexts().then((all) => (all.every(Boolean) ? all : shown.allTextContents()))) {
    assert.match(text, /^the_arm.*….*[12]$/);
  }
  await page.context().close();
});

// What is drawn in red on a canvas, at its right end.
const redAtEnd = (canvas) => canvas.evaluate((it) => {
  const { data } = it.getContext("2d").getImageData(it.width - 18, 0, 18, it.height);
  let count = 0;
  for (let at = 0; at < data.length; at += 4) if (data[at] > 150 && data[at + 1] < 80 && data[at + 3] > 200) ++count;
  return count;
});

test("the results of the last tick have their signs on the timeline", async () => {
  const page = await openRun(record(tree(`<Sequence><Wait seconds="0.5"/><AlwaysFailure name="no"/></Sequence>`)), { colorScheme: "light" });
  await page.keyboard.press("n");
  await soon.ok(page, () => redAtEnd(page.locator(".drawing canvas")));
  await page.context().close();
});

test("the kind of a card and its note stand apart", async () => {
  const page = await openRun(door);
  await atTick(page, 560); // no barrier is left
  const card = node(page, "pull");
  await card.getByText("no barrier left").waitFor();
  const [kind, note] = await card.locator("text.kind, text.limit").evaluateAll((all) => all.map((one) => {
    const { left, right } = one.getBoundingClientRect();
    return { left, right, text: one.textContent };
  }));
  assert.match(kind.text, /ParallelAbsolute$/);
  assert.ok(kind.right + 4 < note.left, `${kind.right} ${note.left}`);
  await page.context().close();
});

const FAILING = tree(`<Sequence name="mission" memory="true"><Wait seconds="0.1"/><Fallback name="grasp"><AlwaysFailure name="first"/>
  <Inverter><AlwaysSuccess name="second"/></Inverter></Fallback></Sequence>`);

test("a failed run opens at its end, which says what decided, as the summary", async () => {
  const recording = record(FAILING);
  const page = await openRun(recording);
  const end = page.getByRole("region", { name: "At the end" });
  await end.waitFor();
  const [, decided, rest] = lockstep("log", "info", recording).match(/decided by (.*):\n((?: {4}.*\n)+)/);
  const wanted = decided.split("/").slice(1).map((_, i, all) => ["Test", ...all.slice(0, i + 1)].join("/"));
  assert.equal(wanted.length, rest.trim().split("\n").length);
  const path = end.getByRole("list", { name: "What decided, from the root down" }).getByRole("button");
  assert.deepEqual(await path.evaluateAll((all) => all.map((one) => one.title)), wanted);
  await soon.match(page, () => words(end), /failure, decided by second/);
  await soon.match(page, () => words(end), /grasp \(Fallback\): failure \(2 of 2 children\)/);
  await page.context().close();
});

test("a run that has succeeded opens where somebody is held first, and has nothing to explain at its end", async () => {
  const page = await openRun(door);
  await page.locator('input[aria-valuetext^="tick 222,"]').waitFor();
  await soon.match(page, () => label(page, "base"), /held.*waits for arm at barrier 0\.25/);
  await page.keyboard.press("n");
  await page.getByRole("region", { name: "At the end" }).waitFor();
  assert.equal(await page.getByText("decided by").count(), 0);
  await page.context().close();
});

test("at the end of a large tree the node that decided is in sight", async () => {
  const branch = (name) => `<Sequence name="b${name}" memory="true">${Array.from({ length: 20 }, (_, leaf) =>
    `<Advance name="l${leaf}" step="0.5"/>`).join("")}${name === 9 ? `<AlwaysFailure name="culprit"/>` : ""}</Sequence>`;
  const page = await openRun(record(tree(`<Sequence name="all" memory="true">${Array.from({ length: 12 }, (_, i) => branch(i)).join("")}</Sequence>`)));
  await soon.ok(page, async () => {
    const box = await node(page, "culprit").boundingBox(), sight = await page.locator(".tree").boundingBox();
    return box && box.y >= sight.y && box.y + box.height <= sight.y + sight.height;
  });
  await page.context().close();
});

test("a pool says who owns what, and for how long others wait", async () => {
  const page = await openRun(record(join(SOURCE, "trees/philosophers.xml")));
  await atTick(page, 30);
  const pool = page.getByRole("treeitem", { name: /^forks, resources/ });
  await soon.match(page, () => pool.getAttribute("aria-label"), /1;2 Socrates\/…\/eat, 3;4 Aristotle\/…\/eat$/);
  await soon.match(page, () => pool.textContent(), /1 of 5 free/);
  await pool.click();
  await soon.match(page, () => words(page.getByRole("group").filter({ hasText: "Node Table/forks" })), /1 Socrates\/…\/eat 2 Socrates\/…\/eat .* 5 free/i);
  await atTick(page, 1); // one waits that has never run
  await soon.match(page, () => words(page.getByRole("region", { name: "Now" })), /Kant\/…\/eat waits for 5 .* for 0\.0\d s/);
  await page.context().close();
});

test("the timeline is as high as it is dragged, or as keys make it", async () => {
  const page = await openRun(door);
  const rows = page.getByRole("group", { name: "Lanes of the nodes" });
  const height = async () => Math.round((await rows.boundingBox()).height);
  const before = await height();
  const grip = page.getByRole("separator", { name: "Height of the timeline" });
  const { x, y, width } = await grip.boundingBox();
  await page.mouse.move(x + width / 3, y + 4);
  await page.mouse.down();
  await page.mouse.move(x + width / 3, y - 96, { steps: 4 });
  await page.mouse.up();
  await soon.equal(page, height, before + 100);
  await page.mouse.move(x + width / 3, y - 200);
  await grip.focus();
  await page.keyboard.press("ArrowDown");
  await soon.equal(page, height, before + 82);
  await page.keyboard.press("ArrowUp");
  await soon.equal(page, height, before + 100);
  assert.deepEqual(await violations(page), []);
  await page.context().close();
});

test("a later part of a recording opens, with one tick and before its parallel begins", async () => {
  const whole = record(tree(`<Sequence memory="true"><Wait seconds="6"/>
    <ParallelAbsolute barriers="0.5"><Advance step="1"/><Advance step="1"/></ParallelAbsolute></Sequence>`),
    "--rate", "10", "--record-rotate", "0.1s");
  const page = await openRun(whole.replace(/\.jsonl$/, ".0051.jsonl"));
  await page.locator('input[aria-valuetext^="tick 50,"]').waitFor();
  await page.getByRole("button", { name: "zoom in" }).click();
  assert.deepEqual(await violations(page), []);
  await page.context().close();
});
