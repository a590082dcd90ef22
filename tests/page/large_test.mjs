// A tree of 10,000 nodes: only what is in sight is drawn, what runs is kept in sight, and nothing stutters.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, eventually, goToTick, openRun, record, tree } from "./support.mjs";

after(() => close());

const LEAVES = Array.from({ length: 99 }, (_, leaf) => `<Advance name="l${leaf}" step="0.5"/>`).join("");
const BRANCHES = Array.from({ length: 100 }, (_, branch) =>
  `<Sequence name="b${branch}" memory="true">${LEAVES}</Sequence>`).join("");

// Milliseconds of processor time a frame while `act` is called once in each: what else the machine does, counts little.
async function frameTime(page, count, act) {
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable", { timeDomain: "threadTicks" });
  const busy = async () => (await session.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
  const before = await busy();
  await page.evaluate(async ([times, source]) => {
    const act = new Function("step", source);
    for (let step = 0; step < times; ++step) {
      act(step);
      await new Promise(requestAnimationFrame);
    }
    await new Promise(requestAnimationFrame); // the last one is drawn
  }, [count, act]);
  return (await busy() - before) * 1000 / count;
}

// A page that hangs: how fluid it is depends on the machine.
function assertFluid(what, took) {
  console.log(`${what}: ${took.toFixed(1)} ms of processor time a frame`);
  assert.ok(took < 1000, `${what}: ${took} ms a frame`);
}

test("10,000 nodes stay fluid", async () => {
  const page = await openRun(record(tree(`<Sequence name="all" memory="true">${BRANCHES}</Sequence>`)));
  await goToTick(page, 1000);
  const running = page.getByRole("treeitem", { name: /^l\d+, Advance, running/ });
  const few = () => eventually(page, async () => {
    const drawn = await page.getByRole("treeitem").count();
    assert.ok(drawn < 250, `${drawn} nodes are drawn`);
  });
  const isInSight = () => eventually(page, async () => {
    const box = await running.boundingBox(), sight = await page.locator(".tree").boundingBox();
    assert.ok(box !== null && box.y >= sight.y && box.y + box.height <= sight.y + sight.height, "what runs is in sight");
  });
  await isInSight();
  await few(); // what does not run is folded

  const scrub = `const slider = document.querySelector('input[aria-label="Moment"]');
    slider.value = 1000 + step * 7; slider.dispatchEvent(new Event("input", { bubbles: true }));`;
  assertFluid("scrubbing", await frameTime(page, 60, scrub));
  await isInSight();

  await page.getByRole("button", { name: "only what runs" }).click();
  await page.getByRole("treeitem", { name: /^b99, Sequence/ }).waitFor({ state: "detached" });
  await few(); // what is out of sight is not drawn
  assertFluid("scrolling", await frameTime(page, 60, `document.querySelector(".tree").scrollTop = 1000 + step * 300;`));
  await page.context().close();
});

test("10,000 children of one node, of which most are held", async () => {
  const leaves = Array.from({ length: 10_000 }, (_, leaf) => `<Advance name="l${leaf}" step="0.0${10 + (leaf * 7) % 10}"/>`);
  const page = await openRun(record(tree(`<ParallelRelative name="all" delta="0.05">${leaves.join("")}</ParallelRelative>`),
    "--seed", "1", "--timeout", "0.2"));
  await page.getByRole("treeitem", { name: /^l\d+, Advance, held.* ahead \(delta 0\.05\)$/ }).first().waitFor();
  assertFluid("scrubbing", await frameTime(page, 10, `const slider = document.querySelector('input[aria-label="Moment"]');
    slider.value = 5 + step; slider.dispatchEvent(new Event("input", { bubbles: true }));`));
  await page.context().close();
});
