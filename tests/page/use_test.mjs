// The page in use, by mouse and by keyboard: at three widths, in light and dark, and what makes a run readable.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { SOURCE, close, goToTick, openRun, record, soon, tree, violations } from "./support.mjs";

after(() => close());

const node = (page, name) => page.getByRole("treeitem", { name: new RegExp(`^${name}[,:]`) });
const words = async (locator) => (await locator.innerText()).replace(/\s+/g, " ");
const events = (page) => page.getByRole("list", { name: "Events" });
const tick = (page) => page.getByRole("slider", { name: "Moment" }).getAttribute("aria-valuetext");

let runs;
before(() => {
  const parallel = (delta, step) => `<ParallelRelative name="sync" delta="${delta}"><Advance name="gripping_jug" step="${step}"/>
    <Advance name="base" step="0.02"/></ParallelRelative>`;
  runs = {
    guide: record(join(SOURCE, "trees/museum_guide.xml")),
    door: record(join(SOURCE, "trees/door_pulling.xml"), "--arg", "barriers="),
    road: record(join(SOURCE, "trees/road/road.xml")),
    btcpp: record(join(SOURCE, "trees/btcpp.xml")),
    holds: record(tree(parallel(0.002, 0.002))),
    count: record(tree(`<Parallel failure_count="2"><Advance name="move" step="0.01"/><Sequence><Script name="script"
      code="count := count + 0.333333333"/><Wait seconds="1"/></Sequence></Parallel>`), "--set", "count=0.0"),
    fail: record(tree(`<Sequence name="mission"><AlwaysFailure name="first"/>${parallel(0.1, 0.1)}</Sequence>`)),
    many: record(tree(`<Sequence name="all" memory="true">${Array.from({ length: 200 }, (_, i) => `<Advance name="l${i}" step="0.5"/>`).join("")}</Sequence>`),
      "--timeout", "1"),
  };
});

// What is cut, in capitals, or on a bar.
const misplaced = (page) => page.evaluate(() => {
  const wrong = [];
  const box = (element) => element.getBoundingClientRect();
  if (document.documentElement.scrollWidth > innerWidth) wrong.push("the page is too wide");
  for (const control of document.querySelectorAll("header > *, .control *, .tools > *, .timeline button")) {
    if (box(control).width > 0 && (box(control).right > innerWidth + 1 || box(control).left < -1)) wrong.push(`outside: ${control.textContent}`);
  }
  for (const element of document.querySelectorAll("body *")) {
    if (getComputedStyle(element).textTransform !== "none") wrong.push(`capitals: ${element.textContent}`);
  }
  for (const card of document.querySelectorAll(".card")) {
    const bar = card.querySelector(".rest");
    for (const text of bar ? card.querySelectorAll("text.kind, text.sentence, text.limit") : []) {
      const { bottom } = box(text), scale = box(text).height / text.getBBox().height;
      if (text.textContent && bottom - 1 * scale > box(bar).top - 2 * scale) wrong.push(`on its bar: ${text.textContent} ${bottom} ${box(bar).top}`);
    }
  }
  return wrong;
});

// A page is opened once and then made narrower, as a window is, and opened as narrow as a phone.
for (const name of ["guide", "door", "road", "btcpp", "holds", "fail", "many"]) {
  test(`${name}: nothing is cut, in capitals, or on a bar, at three widths, in light and dark`, async () => {
    for (const widths of [[1400, 800, 400], [400]]) {
      const page = await openRun(runs[name], { viewport: { width: widths[0], height: 900 }, reducedMotion: "reduce" });
      await page.getByRole("treeitem").first().click();
      await page.getByRole("group").filter({ hasText: /^Node / }).waitFor();
      for (const width of widths) {
        await page.setViewportSize({ width, height: 900 });
        for (const colorScheme of ["light", "dark"]) {
          await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
          await soon.deepEqual(page, () => misplaced(page), []);
          if ((name === "door" || name === "holds") && width !== 800) assert.deepEqual(await violations(page), [], `${width} px, ${colorScheme}`);
        }
      }
      await page.context().close();
    }
  });
}

test("the header is one row, and the focus frame is around all of the tree", async () => {
  const page = await openRun(runs.guide, { viewport: { width: 800, height: 900 } });
  assert.ok((await page.locator("header").boundingBox()).height < 60);
  await page.getByRole("tree").focus();
  await page.keyboard.press("ArrowDown");
  const frame = () => page.evaluate(() => [".tree", ".tree > svg"].map((it) => getComputedStyle(document.querySelector(it)).outlineStyle));
  await soon.deepEqual(page, frame, ["solid", "none"]);
  await page.context().close();
});

test("the ports of a node have the values of the moment", async () => {
  const page = await openRun(runs.guide);
  await goToTick(page, 10);
  const ports = page.getByRole("table", { name: "Ports" });
  await node(page, "arm").first().click();
  await soon.match(page, () => words(ports), /step 0\.008 entrance\/arm_step/);
  await soon.match(page, () => words(ports), /noise 0\.003/);
  await node(page, "entrance").click();
  await soon.match(page, () => words(ports), /arm_step 0\.008 entrance\/arm_step/);
  await node(page, "explain").first().click();
  await soon.match(page, () => words(ports), /seconds 1/);
  await page.context().close();
});

const view = (page) => page.locator(".tree").evaluate((it) => [it.scrollLeft, it.scrollTop]);
const boxOf = (page, name) => node(page, name).first().boundingBox();

test("a drag pans the tree, the wheel zooms around the pointer, fit shows all of it", async () => {
  const page = await openRun(runs.many, { reducedMotion: "reduce" });
  await page.getByRole("button", { name: "follow" }).click();
  const { x, y, width, height } = await page.locator(".tree").boundingBox();
  await page.locator(".tree").evaluate((it) => it.scrollTo(0, 2000));
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2, y + height / 2 - 100, { steps: 4 });
  await page.mouse.up();
  await soon.deepEqual(page, () => view(page), [0, 2100]);
  assert.equal(await page.locator('[role="treeitem"][aria-selected="true"]').count(), 0);
  await page.getByRole("tree").focus();
  await page.keyboard.press("Shift+ArrowUp");
  await soon.deepEqual(page, () => view(page), [0, 2020]);

  const before = (await page.getByRole("treeitem").first().boundingBox()).height;
  const name = (await page.getByRole("treeitem").nth(8).getAttribute("aria-label")).split(",")[0];
  const at = await boxOf(page, name);
  await page.mouse.move(at.x + 20, at.y + 10);
  await page.mouse.wheel(0, -200);
  await soon.ok(page, async () => (await page.getByRole("treeitem").first().boundingBox()).height > before * 1.2);
  const now = await boxOf(page, name);
  assert.ok(now.y < at.y + 10 && now.y + now.height > at.y + 10, "what is under the pointer stays there");

  const all = () => page.locator(".tree").evaluate((it) => it.scrollHeight <= it.clientHeight && it.scrollWidth <= it.clientWidth);
  assert.equal(await all(), false);
  await page.getByRole("button", { name: "fit" }).click();
  await soon.ok(page, all);
  await soon.equal(page, () => page.getByRole("treeitem").count(), 201);
  await page.keyboard.press("F");
  await soon.equal(page, all, false);
  await page.keyboard.press("F");
  await soon.ok(page, all);
  await page.keyboard.press("z");
  await page.getByRole("button", { name: "fit", pressed: false }).waitFor();
  await page.context().close();
});

// Pixels of a canvas that are not gray.
const inked = (canvas) => canvas.evaluate((it) => {
  const { data } = it.getContext("2d").getImageData(0, 0, it.width, it.height);
  let count = 0;
  for (let at = 0; at < data.length; at += 4) {
    const [red, green, blue, opacity] = data.subarray(at, at + 4);
    if (opacity > 200 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60) ++count;
  }
  return count;
});

test("an entry is a curve, with numbers that can be read", async () => {
  const page = await openRun(runs.count);
  await goToTick(page, 50);
  const board = page.getByRole("table", { name: "Blackboard" });
  await soon.match(page, () => words(board), /count 17 0\.500 s/);
  await goToTick(page, 51);
  await soon.match(page, () => words(board), /count 17\.3333 0\.510 s/);
  await soon.equal(page, () => board.locator(".small-curve path").count(), 1);
  await board.getByRole("button", { name: "count" }).click();
  const curve = page.getByRole("img", { name: "count over time" });
  await soon.ok(page, async () => await inked(curve.locator("canvas")) > 50);
  await page.context().close();
});

test("the keys pass by an entry that changes in every tick, which is one event", async () => {
  const page = await openRun(runs.count);
  await goToTick(page, 50);
  await page.getByRole("tree").focus();
  await soon.match(page, () => words(events(page)), /count = 17, 51 times in succession/);
  assert.equal(await events(page).getByText("count =").count(), 1);
  await page.keyboard.press("]");
  await soon.match(page, () => tick(page), /^tick 99,/); // move succeeds
  await page.keyboard.press("[");
  await soon.match(page, () => tick(page), /^tick 0,/);
  await page.getByRole("button", { name: "completions" }).click();
  await page.keyboard.press("]");
  await soon.match(page, () => tick(page), /^tick 100,/); // the end
  await page.context().close();
});

test("hundreds of short holds are a share of the time, and one event until it is opened", async () => {
  const page = await openRun(runs.holds);
  await page.keyboard.press("n");
  const lanes = page.getByRole("group", { name: "Lanes of the nodes" });
  await lanes.getByRole("button", { name: /^base: held (8|9)\d % of 4.89 s \(\d+ times\), succeeded once$/ }).waitFor();
  await soon.match(page, () => words(events(page)), /sync: base held (8|9)\d % of \d\.\d\d s \(\d+ times\)/);
  const rows = () => events(page).getByRole("listitem").count();
  assert.ok(await rows() < 8, `${await rows()} rows`);
  await events(page).getByRole("button", { name: "each" }).click();
  await soon.ok(page, async () => await rows() > 60);
  await events(page).getByRole("button", { name: "as one" }).click();
  await soon.ok(page, async () => await rows() < 8);
  await page.context().close();
});

test("the spread is a curve beside its bound", async () => {
  const page = await openRun(runs.holds);
  const plot = page.getByRole("img", { name: "Spread of sync over time, and its bound" });
  await soon.ok(page, async () => await inked(plot.locator("canvas")) > 100);
  await soon.match(page, () => words(page.getByRole("list", { name: "Spread at this moment" })),
    /spread 0\.\d{3} at most 0\.02\d bound 0\.022 delta 0\.002 \+ longest step 0\.0200/);
  await page.context().close();
});

test("there is no chart of what was never reached", async () => {
  const page = await openRun(runs.fail);
  await page.getByText("run ended: failure").first().waitFor();
  assert.equal(await page.getByText("Progress over time").count(), 0);
  await page.context().close();
});

test("the events of a tick follow their causes", async () => {
  const page = await openRun(runs.fail);
  await soon.match(page, () => words(events(page)), /run ended: .* after 1 tick .*mission failed .*first failed/);
  await page.context().close();
});

test("the bar of a failed node has what it had, and that it failed", async () => {
  const page = await openRun(runs.door);
  await page.keyboard.press("n");
  await soon.match(page, () => node(page, "base").getAttribute("aria-label"), /failure, progress 0\.6\d/);
  const [done, rest] = await Promise.all([".done", ".rest"].map(async (part) => (await node(page, "base").locator(part).boundingBox()).width));
  assert.ok(done / rest > 0.6 && done / rest < 0.7);
  assert.equal(await node(page, "base").locator(".broken").count(), 1);
  assert.equal(await node(page, "release").locator(".broken").count(), 0);
  await page.context().close();
});

test("the lanes reach each node, also on a phone", async () => {
  const page = await openRun(runs.fail);
  const lanes = page.getByRole("group", { name: "Lanes of the nodes" });
  await soon.equal(page, () => lanes.getByRole("button").count(), 1);
  await node(page, "mission").click();
  await lanes.getByRole("button", { name: "mission: failed once" }).waitFor();
  await page.getByRole("button", { name: "all nodes" }).click();
  await lanes.getByRole("button", { name: "base: not reached" }).waitFor();
  await page.context().close();

  const many = await openRun(runs.many);
  await many.getByRole("treeitem", { name: /^l\d+,/ }).first().waitFor();
  await many.keyboard.press("/");
  await many.keyboard.type("l150");
  await many.keyboard.press("Enter");
  await many.getByRole("group", { name: "Lanes of the nodes" }).getByRole("button", { name: /^l150: not reached/ }).waitFor();
  await many.context().close();

  const phone = await openRun(runs.fail, { viewport: { width: 400, height: 850 }, hasTouch: true });
  assert.equal(await phone.locator(".lanes").isVisible(), false);
  await phone.getByRole("button", { name: "lanes", exact: true }).click();
  await phone.getByRole("group", { name: "Lanes of the nodes" }).getByRole("button", { name: "first: failed once" }).waitFor();
  assert.deepEqual(await violations(phone), []);
  await phone.context().close();
});
