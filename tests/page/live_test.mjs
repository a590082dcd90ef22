// A run that goes on, in the browser: watched, controlled, lost and found again.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { SOURCE, cable, close, goToTick, open, soon, start, tree, violations } from "./support.mjs";

// What is lost, or wrong, on purpose is a complaint of the browser, too.
after(() => close(/net::ERR_|status of 400/));

const node = (page, name) => page.getByRole("treeitem", { name: new RegExp(`^${name}[,:]`) });
const state = (page, text) => page.locator("header [role=status]").getByText(text);
const tickOf = async (page) => Number(await page.getByRole("textbox", { name: "Tick" }).inputValue());

async function watch(...args) {
  const run = await start("run", ...args, "--clock", "virtual", "--monitor-control", "--monitor-paused");
  const page = await open(run.link);
  await state(page, "paused").waitFor();
  return { run, page };
}

// On the wall clock, without control.
async function look(...args) {
  const run = await start("run", ...args);
  const page = await open(run.link);
  await state(page, "live").waitFor();
  return { run, page };
}

test("the door opens: the base is seen held at 0.25, tick by tick, back and on", async () => {
  const { run, page } = await watch(join(SOURCE, "trees/door_pulling.xml"));
  for (let tick = 0; tick < 6; ++tick) {
    await page.getByRole("button", { name: "one tick", exact: true }).click();
    await page.locator(`input[max="${tick}"][aria-valuetext^="tick ${tick},"]`).waitFor();
  }
  await soon.match(page, () => node(page, "reach").getAttribute("aria-label"), /running, progress 0\.04/);
  await page.getByRole("combobox", { name: "Speed of the run" }).selectOption("1×");
  await node(page, "pull").click();
  await page.getByRole("combobox", { name: "When to pause" }).selectOption("comes to a barrier");
  await page.getByRole("button", { name: "pause when pull" }).click();
  await page.getByRole("button", { name: "remove the breakpoint: pull comes to a barrier" }).waitFor();
  await page.getByRole("button", { name: "resume" }).click();
  await page.getByText("paused, since pull comes to a barrier").waitFor();
  await soon.equal(page, () => node(page, "base").getAttribute("aria-label"),
    "base, BackAway, held, progress 0.25, waits for arm at barrier 0.25");
  const held = await tickOf(page);
  await page.getByRole("tree").focus();
  await page.keyboard.press(",");
  await page.getByText("looking back").waitFor();
  await soon.match(page, () => node(page, "base").getAttribute("aria-label"), /running/);
  await page.keyboard.press("n");
  await page.locator(`input[aria-valuetext^="tick ${held},"]`).waitFor();
  await page.getByRole("button", { name: "remove the breakpoint" }).click();
  await page.getByRole("combobox", { name: "Speed of the run" }).selectOption("as fast as possible");
  await page.getByRole("button", { name: "resume" }).click();
  await state(page, "ended: success (completed)").waitFor();
  assert.equal(await run.ended, 0);
  await page.getByRole("region", { name: "At the end" }).waitFor();
  await page.context().close();
});

test("an entry is set, a wrong value is refused with a reason", async () => {
  const { run, page } = await watch(tree(
    `<Sequence memory="true"><Script code="step := 0.001"/><Repeat><Advance step="{step}"/></Repeat></Sequence>`));
  for (const _ of [0, 1]) await page.getByRole("button", { name: "one tick", exact: true }).click();
  await page.getByRole("combobox", { name: "Entry" }).selectOption("step");
  await page.getByRole("textbox", { name: "Value" }).fill("soon");
  await page.getByRole("button", { name: "set", exact: true }).click();
  await page.getByText("not done: 'soon' is not").waitFor();
  await page.getByRole("textbox", { name: "Value" }).fill("0.25");
  await page.getByRole("button", { name: "set", exact: true }).click();
  await page.getByText("step = 0.25 from the next tick on").waitFor();
  await page.getByRole("button", { name: "one tick", exact: true }).click();
  await page.getByRole("table", { name: "Blackboard" }).getByRole("row", { name: /step 0\.25/ }).waitFor();
  await page.getByRole("button", { name: "halt" }).click();
  await page.getByRole("button", { name: "really halt the run?" }).click();
  await state(page, "ended: stopped").waitFor();
  await run.ended;
  await page.context().close();
});

test("a page that only looks has no control", async () => {
  const { run, page } = await look(tree(`<AlwaysRunning/>`));
  assert.equal(await page.getByRole("button", { name: "pause" }).count(), 0);
  run.process.kill("SIGKILL");
  await state(page, "connection lost").waitFor();
  await soon.match(page, () => node(page, "AlwaysRunning").getAttribute("aria-label"), /running/);
  await page.context().close();
});

for (const how of ["cut", "stall"]) {
  test(`a connection that was lost comes back, with what went on in between: ${how}`, async () => {
    const run = await start("run", tree(`<Repeat><Advance step="0.01"/></Repeat>`));
    const line = await cable(run.link);
    const page = await open(line.link);
    await state(page, "live").waitFor();
    line[how]();
    await state(page, "connection lost").waitFor();
    const before = await tickOf(page);
    line.cut();
    line.mend();
    await state(page, "live").waitFor();
    await page.waitForFunction((tick) => Number(document.querySelector("input.tick").value) > tick + 20, before);
    run.process.kill("SIGTERM");
    await state(page, "ended: stopped (signal)").waitFor();
    await page.context().close();
  });
}

test("a reload in the middle has the whole run", async () => {
  const { run, page } = await look(tree(`<Repeat><Advance step="0.01"/></Repeat>`));
  await page.waitForFunction(() => Number(document.querySelector("input.tick").value) > 100);
  await page.reload();
  await page.getByRole("tree").waitFor();
  await state(page, "live").waitFor();
  await goToTick(page, 12); // typed while the run goes on
  await page.getByText("looking back").waitFor();
  const tick = await tickOf(page);
  assert.ok(tick > 3 && tick <= 12, `tick ${tick}`);
  run.process.kill("SIGTERM");
  await page.context().close();
});

test("on the wall clock the page says that the robot will stand, before it is paused", async () => {
  const { run, page } = await look(tree(`<Repeat><Advance step="0.01"/></Repeat>`), "--monitor-control");
  await page.getByText("the robot stands still until it is resumed").waitFor();
  await page.getByRole("tree").focus();
  await page.keyboard.press("p");
  await state(page, "paused").waitFor();
  const tick = await tickOf(page);
  await page.keyboard.press("s");
  await page.locator(`input[aria-valuetext^="tick ${tick + 1},"]`).waitFor();
  await page.getByRole("button", { name: "resume" }).click(); // p would pause while the tick is not over yet
  await page.waitForFunction((from) => Number(document.querySelector("input.tick").value) > from + 10, tick);
  assert.deepEqual(await violations(page), []);
  run.process.kill("SIGTERM");
  await page.context().close();
});

test("a page that nobody looks at asks for nothing, and goes on when somebody does", async () => {
  const { run, page } = await look(tree(`<Repeat><Advance step="0.01"/></Repeat>`));
  const hide = (hidden) => page.evaluate((value) => {
    Object.defineProperty(document, "hidden", { value, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await hide(true);
  await state(page, "asleep").waitFor();
  const tick = await tickOf(page);
  const asked = page.waitForRequest(/events\?after=\d+$/);
  await hide(false);
  await asked;
  await state(page, "live").waitFor();
  await page.waitForFunction((from) => Number(document.querySelector("input.tick").value) > from, tick);
  run.process.kill("SIGTERM");
  await page.context().close();
});
