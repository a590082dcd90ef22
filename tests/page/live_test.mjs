// A run that goes on, in the browser: watched, controlled, lost and found again.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { SOURCE, cable, close, goToTick, loadModel, open, pageOf, path, soon, start, tree, violations } from "./support.mjs";

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
  await page.getByRole("group", { name: "Pause the run when this node" }).getByRole("button", { name: "comes to a barrier" }).click();
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

test("a person answers what the tree asks, and a page in front attends the run", async () => {
  const { run, page } = await watch(tree(`<Sequence memory="true"><Ask name="where" text="Where to?" options="left;right" answer="{side}"/>
    <Ask name="sure" text="Really {side}?" severity="critical" timeout="60" default="no"/></Sequence>`), "--attended", "600");
  await page.getByRole("checkbox", { name: "attend" }).check();
  await page.getByRole("combobox", { name: "Speed of the run" }).selectOption("1×");
  await page.getByRole("button", { name: "resume" }).click();
  const asked = (name) => page.getByRole("group", { name: `Question of ${name}` });
  await asked("where").getByText("Where to?").waitFor();
  assert.deepEqual(await violations(page), []);
  await asked("where").getByRole("button", { name: "right", exact: true }).click();
  await asked("sure").getByText("Really right?").waitFor();
  await asked("sure").getByText("s: no").waitFor();
  await asked("sure").getByRole("button", { name: "yes", exact: true }).focus();
  await page.keyboard.press("Enter");
  await state(page, "ended: success (completed)").waitFor();
  assert.equal(await asked("sure").count(), 0);
  assert.equal(await run.ended, 0);
  await page.context().close();
});

test("a run that is unattended pauses, and the page tells it", async () => {
  const { run, page } = await watch(tree(`<Wait seconds="1000"/>`), "--attended", "0.2");
  await page.getByRole("button", { name: "resume" }).click();
  await state(page, "paused: unattended").waitFor();
  await page.getByRole("checkbox", { name: "attend" }).check();
  await state(page, "paused: unattended").waitFor({ state: "detached" });
  run.process.kill("SIGTERM");
  await page.context().close();
});

test("a click pauses the run when a node succeeds, or fails", async () => {
  const { run, page } = await watch(tree(`<Fallback memory="true"><Sequence name="first" memory="true"><Advance name="go" step="0.1"/>
    <Wait seconds="0.05"/><AlwaysFailure name="no"/></Sequence><Advance name="other" step="0.1"/></Fallback>`));
  const when = (name) => page.getByRole("group", { name: "Pause the run when this node" }).getByRole("button", { name });
  for (const [name, what] of [["go", "succeeds"], ["first", "fails"]]) {
    await node(page, name).click();
    await when(what).click();
    await page.getByRole("button", { name: `remove the breakpoint: ${name} ${what}` }).waitFor();
    await when(what).and(page.locator("[aria-pressed=true]")).waitFor();
    assert.equal(await node(page, name).locator(".stop").count(), 1);
    await page.getByRole("button", { name: "resume" }).click();
    await page.getByText(`paused, since ${name} ${what}`).waitFor();
  }
  await when("fails").click();
  await page.getByRole("button", { name: "remove the breakpoint: first" }).waitFor({ state: "detached" });
  assert.equal(await when("comes to a barrier").count(), 0);
  run.process.kill("SIGTERM");
  await page.context().close();
});

test("on a phone the control is one row, and the rest of it one button away", async () => {
  const run = await start("run", tree(`<Sequence memory="true"><Script code="step := 0.001"/><Advance step="0"/></Sequence>`),
    "--monitor-control", "--clock", "virtual", "--monitor-paused");
  const page = await open(run.link, { viewport: { width: 400, height: 850 }, hasTouch: true });
  await state(page, "paused").waitFor();
  const button = (name) => page.getByRole("button", { name, exact: true });
  const tops = async () => Promise.all(["▶ resume", "one tick", "more", "■ halt"].map(async (name) => (await button(name).boundingBox()).y));
  assert.equal(new Set(await tops()).size, 1);
  assert.equal(await page.getByRole("combobox", { name: "Entry" }).isVisible(), false);
  await button("more").click();
  await page.getByRole("combobox", { name: "Entry" }).waitFor();
  assert.equal(new Set(await tops()).size, 1);
  await button("■ halt").click();
  await page.getByRole("button", { name: "really halt" }).waitFor();
  assert.deepEqual(await violations(page), []);
  assert.ok((await page.getByRole("combobox", { name: "Find a node" }).boundingBox()).width > 90);
  assert.ok((await page.locator("header").boundingBox()).height < 80);
  run.process.kill("SIGTERM");
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

test("a run is saved as a page of its own, and a reload after the end asks first", async () => {
  const { run, page } = await watch(tree(`<Sequence memory="true"><Wait seconds="0.5"/><AlwaysFailure name="no &lt;script>"/></Sequence>`));
  await page.getByRole("button", { name: "resume" }).click();
  await state(page, "ended: failure").waitFor();
  assert.equal(await run.ended, 1);
  await page.getByRole("tree").click(); // a page that nobody has touched may not ask
  const asked = page.waitForEvent("dialog");
  page.reload().catch(() => {});
  const dialog = await asked;
  assert.equal(dialog.type(), "beforeunload");
  await dialog.dismiss();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "save this run" }).click()]);
  assert.equal(file.suggestedFilename(), "Test.html");
  await file.saveAs(path("saved.html"));
  const saved = await open(`file://${path("saved.html")}`);
  await state(saved, "recording").waitFor();
  const end = saved.getByRole("region", { name: "At the end" });
  await end.getByText("decided by").waitFor();
  assert.equal(await saved.getByRole("tree").count(), 1);
  await saved.context().close();
  await page.context().close();
});

test("with --monitor-linger a reload after the end has the whole run, and the last page to leave ends the program", async () => {
  const { run, page } = await watch(tree(`<Sequence memory="true"><Wait seconds="0.5"/><AlwaysFailure/></Sequence>`), "--monitor-linger", "60");
  await page.getByRole("button", { name: "resume" }).click();
  await state(page, "ended: failure").waitFor();
  for (let again = 0; again < 2; ++again) {
    await page.reload();
    await state(page, "ended: failure").waitFor();
    assert.equal(await tickOf(page), 50);
  }
  await page.context().close();
  assert.equal(await run.ended, 1);
});

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

// 150 failures, holds, results that last a tick or less, an entry that changes in each tick.
const EVENTFUL = `<Parallel>
  <ForceSuccess><Retry attempts="200"><AlwaysFailure name="never"/></Retry></ForceSuccess>
  <ForceSuccess><Retry attempts="150"><Sequence name="try"><Advance name="step" step="0.5"/><AlwaysFailure name="no"/></Sequence></Retry></ForceSuccess>
  <Repeat times="13"><ParallelAbsolute name="pull" barriers="0.25;0.5;0.75"><Advance name="arm" step="0.1"/><Advance name="base" step="0.25"/></ParallelAbsolute></Repeat>
  <Repeat times="120"><Script code="count := count + 1"/></Repeat>
</Parallel>`;

const monitorOf = (run) => {
  const { origin, hash } = new URL(run.link);
  return { origin, headers: { "X-Lockstep-Token": hash.replace("#token=", "") } };
};

async function order(run, what) {
  const { origin, headers } = monitorOf(run);
  assert.equal((await fetch(`${origin}/control`, { method: "POST", headers, body: JSON.stringify(what) })).status, 204);
}

// What a page says of the whole run.
async function told(page) {
  const all = { lanes: [], events: {} };
  await page.getByRole("button", { name: "newest" }).click();
  await page.getByRole("button", { name: "all nodes" }).click();
  const lanes = page.getByRole("group", { name: "Lanes of the nodes" }).getByRole("button");
  all.lanes = await lanes.evaluateAll((lane) => lane.map((it) => it.getAttribute("aria-label")));
  const groups = ["completions", "waiting", "troubles", "entries", "logs"];
  const filter = (name) => page.getByRole("group", { name: "Which events" }).getByRole("button", { name, exact: true });
  for (const name of groups) await filter(name).click();
  for (const name of groups) {
    await filter(name).click();
    await page.locator("body").evaluate(() => new Promise(requestAnimationFrame));
    all.events[name] = await page.getByRole("list", { name: "Events" }).getByRole("listitem").allInnerTexts();
    await filter(name).click();
  }
  return all;
}

test("the page of a run that has ended is that of its recording", async () => {
  const recording = path("eventful.jsonl");
  const run = await start("run", tree(EVENTFUL), "--set", "count=0", "--record", recording, "--monitor-control", "--monitor-paused");
  const page = await open(run.link, { viewport: { width: 1280, height: 1600 } });
  await order(run, { do: "step", ticks: 60 }); // no pause that the end of the run could outrun
  await page.locator(`input[aria-valuetext^="tick 59,"]`).waitFor();
  await page.reload(); // from here on it has the recording, then what happens
  await page.getByRole("button", { name: "resume" }).click();
  await state(page, "ended: success").waitFor();
  assert.equal(await run.ended, 0);
  const replayed = await open(pageOf(recording), { viewport: { width: 1280, height: 1600 } });
  await replayed.getByRole("tree").waitFor();
  const live = await told(page);
  assert.deepEqual(live, await told(replayed));
  assert.ok(live.lanes.includes("no: failed 150 times"), live.lanes.join("; "));
  assert.ok(live.lanes.includes("never: failed 200 times"), live.lanes.join("; "));
  await page.context().close();
  await replayed.context().close();
});

// As it is told: of each event its tick.
function facts(run) {
  return {
    events: run.events.all.map(({ line, kind, node, text }) => [run.ticks[line], kind, node, text]),
    states: run.nodes.map(({ states }) => [...states.lines.slice(0, states.length)].map((line, i) => [run.ticks[line], states.values[i]])),
    counts: run.nodes.map((_, node) => run.countsOf(node)),
    entries: run.entries.map((history) => history.map(({ line, value }) => [run.ticks[line], value])),
  };
}

for (const clock of ["virtual", "wall"]) {
  test(`a client of the monitor gets everything that the recording has but progress: ${clock} clock`, async () => {
    const model = await loadModel();
    const recording = path(`${clock}.jsonl`);
    const run = await start("run", tree(EVENTFUL), "--set", "count=0", "--clock", clock, "--monitor-control", "--monitor-paused",
      "--record", recording);
    const { origin, headers } = monitorOf(run);
    const events = await fetch(`${origin}/events`, { headers });
    await order(run, { do: "resume" });
    const live = new model.Run(), recorded = new model.Run();
    const lines = (await events.text()).split("\n").filter((line) => line.startsWith("data: ") && line !== "data: {}");
    for (const line of lines) {
      if (!line.startsWith(`data: {"state"`)) live.feed(line.slice(6));
    }
    assert.equal(await run.ended, 0);
    for (const line of readFileSync(recording, "utf8").trim().split("\n")) recorded.feed(line);
    assert.deepEqual(facts(live), facts(recorded));
    assert.equal(live.lost, 0);
    assert.ok(live.events.all.length > 800, `${live.events.all.length} events`);
  });
}

// How many pixels of the chart have the color of a line of its children.
const inked = (page) => page.evaluate(() => {
  const canvas = document.querySelector(".chart canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let at = 0; at < data.length; at += 4) {
    const [red, green, blue] = [data[at], data[at + 1], data[at + 2]];
    if (data[at + 3] > 200 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60) ++count;
  }
  return count;
});

test("a run that is stepped from its first tick has a chart, also before the parallel begins", async () => {
  const { page } = await watch(tree(`<Sequence memory="true"><Wait seconds="0.02"/>
    <ParallelAbsolute barriers="0.5"><Advance step="0.1"/><Advance step="0.05"/></ParallelAbsolute></Sequence>`));
  for (let tick = 0; tick < 9; ++tick) {
    await page.getByRole("button", { name: "one tick", exact: true }).click();
    await page.locator(`input[max="${tick}"][aria-valuetext^="tick ${tick},"]`).waitFor();
  }
  const count = await inked(page);
  assert.ok(count > 300, `${count} pixels of lines`);
  await page.context().close();
});
