// What the tests of the page share: recordings, pages of them, a browser that reports what goes wrong in it.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const SOURCE = join(dirname(fileURLToPath(import.meta.url)), "../..");
export const BUILD = process.env.LOCKSTEP_BUILD ?? join(SOURCE, "build/release");
const require = createRequire(join(SOURCE, "interpreter/show/web/page/package.json"));
const { chromium } = require("playwright-core");
const AXE = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

const directory = mkdtempSync(join(tmpdir(), "lockstep-page-"));
process.on("exit", () => rmSync(directory, { recursive: true, force: true }));

export function path(name) {
  return join(directory, name);
}
export function file(name, text) {
  writeFileSync(path(name), text);
  return path(name);
}

export function lockstep(...args) {
  return execFileSync(join(BUILD, "lockstep"), args, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "pipe"] });
}

// The page's model of a run, without a browser.
export async function loadModel() {
  const { outputFiles } = await require("esbuild").build({
    stdin: {
      contents: ["model/run", "model/moment", "model/events", "model/spread", "model/numbers", "model/questions", "model/waiting", "model/thin", "model/lanes", "model/words", "store/span", "view/chart/data"]
        .map((name) => `export * from "./src/${name}";`).join("\n"),
      resolveDir: join(SOURCE, "interpreter/show/web/page"),
    },
    bundle: true, write: false, format: "esm",
  });
  return import(file("model.mjs", outputFiles[0].text));
}

let runs = 0;
// A recording of a tree, on the virtual clock. The result of the run does not matter.
export function record(tree, ...args) {
  const recording = path(`run-${++runs}.jsonl`);
  try {
    lockstep("run", tree, "--plugin-path", join(BUILD, "plugins"), "--clock", "virtual", "--view", "none",
      "--max-ticks", "5000", "--record", recording, ...args);
  } catch (error) {
    if (error.status === 2 || error.status === 3) throw error;
  }
  return recording;
}

// The recording of a run that was killed, and then continued.
export async function recordOverCut(tree) {
  const recording = path(`run-${++runs}.jsonl`), keep = ["--checkpoint", path(`run-${runs}.checkpoint`), "--resume"];
  const child = spawn(join(BUILD, "lockstep"), ["run", tree, "--plugin-path", join(BUILD, "plugins"), "--view", "none",
    "--record", recording, ...keep], { stdio: "ignore" });
  const ended = new Promise((done) => child.on("exit", done));
  const lines = () => existsSync(recording) && readFileSync(recording, "utf8").split("\n").length;
  while (child.exitCode === null && !(lines() > 100)) await new Promise((go) => setTimeout(go));
  child.kill("SIGKILL");
  await ended;
  lockstep("run", tree, "--plugin-path", join(BUILD, "plugins"), "--view", "none", "--clock", "virtual", "--record", recording, ...keep);
  return recording;
}

export function tree(text) {
  return file(`tree-${++runs}.xml`, `<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="Test">${text}</BehaviorTree></root>`);
}

export function pageOf(recording, ...args) {
  const page = recording.replace(/\.jsonl$/, ".html");
  lockstep("log", "page", recording, "--out", page, ...args);
  return `file://${page}`;
}

const started = [];

// lockstep with a monitor, once it has printed its link. `ended` is its exit code, or the signal that ended it.
export function start(command, tree, ...args) {
  const child = spawn(join(BUILD, "lockstep"), [command, tree, "--plugin-path", join(BUILD, "plugins"), "--view", "none",
    "--monitor", ...args], { stdio: ["ignore", "ignore", "pipe"] });
  started.push(child);
  const ended = new Promise((done) => child.on("exit", (code, signal) => done(code ?? signal)));
  return new Promise((done, fail) => {
    let text = "";
    child.stderr.on("data", (part) => {
      text += part;
      const link = text.match(/^monitor: (http:\S+)$/m);
      if (link) done({ process: child, link: link[1], ended });
    });
    ended.then((code) => fail(new Error(`lockstep ended with ${code}: ${text}`)));
  });
}

// A connection to the link that can be cut, stalled and mended.
export async function cable(link) {
  const { port, hash } = new URL(link);
  const pairs = new Set();
  let state = "whole";
  const server = createServer((near) => {
    if (state === "cut") return near.destroy();
    const far = connect(Number(port), "127.0.0.1");
    pairs.add([near, far]);
    for (const [from, to] of [[near, far], [far, near]]) {
      from.on("data", (bytes) => state === "whole" && to.write(bytes));
      from.on("close", () => to.destroy());
      from.on("error", () => to.destroy());
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  server.unref();
  return {
    link: `http://127.0.0.1:${server.address().port}/${hash}`,
    cut() {
      state = "cut";
      for (const pair of pairs) for (const socket of pair) socket.destroy();
      pairs.clear();
    },
    stall: () => (state = "stalled"),
    mend: () => (state = "whole"),
  };
}

let browser = null;
const complaints = [];

// Without a graphics card, on a busy machine, Chromium or a new page of it may come up and never draw a frame.
function draws(page) {
  const drawn = page.evaluate(() => new Promise((done) => requestAnimationFrame(() => done(true))));
  const late = new Promise((done) => setTimeout(done, 15_000, false).unref());
  return Promise.race([drawn.catch(() => false), late]);
}

async function launch(tries = 3) {
  const args = ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"];
  const launched = await chromium.launch({ executablePath: "/usr/bin/chromium", args, timeout: 120_000 });
  const page = await launched.newPage();
  if (await draws(page)) {
    await page.close();
    return launched;
  }
  await launched.close();
  assert.ok(tries > 1, "Chromium draws nothing");
  return launch(tries - 1);
}

export async function open(address, options = {}, tries = 3) {
  browser ??= await launch();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.stack ?? error.message));
  page.setDefaultTimeout(60_000); // only what hangs takes so long, also on a busy machine
  await page.goto(address);
  if (await draws(page)) return page;
  await context.close();
  assert.ok(tries > 1, "a page of Chromium draws nothing");
  return open(address, options, tries - 1);
}

// A page that has drawn a frame may draw no other one: then it is opened again. One that draws, without the tree, is wrong.
export async function openRun(recording, options, ...args) {
  const address = pageOf(recording, ...args);
  for (let tries = 3; ; --tries) {
    const page = await open(address, options);
    try {
      await page.getByRole("tree").waitFor();
      return page;
    } catch (error) {
      if (tries === 1 || await draws(page)) throw error;
    }
    await page.context().close();
  }
}

// To be called after all tests of a file; `expected` complaints are none.
export async function close(expected = /^$/) {
  await browser?.close();
  browser = null;
  for (const child of started) child.kill("SIGKILL");
  assert.deepEqual(complaints.filter((one) => !expected.test(one)), [], "the browser complains");
}

// Asserts again in the next frames until all holds; what still fails after a minute fails. The page draws when it can, and
// a busy machine may draw nothing for a while.
export async function eventually(page, assertions) {
  const until = Date.now() + 60_000;
  for (;;) {
    try {
      return await assertions();
    } catch (error) {
      if (Date.now() > until) throw error;
    }
    await page.evaluate(() => new Promise((done) => {
      requestAnimationFrame(done);
      setTimeout(done, 500);
    }));
  }
}

// soon.match(page, look, pattern) and the like: what `look` gives, eventually.
export const soon = Object.fromEntries(["equal", "deepEqual", "match", "doesNotMatch", "ok"].map((name) =>
  [name, (page, look, ...wanted) => eventually(page, async () => assert[name](await look(), ...wanted))]));

export async function goToTick(page, tick) {
  await page.getByRole("textbox", { name: "Tick" }).fill(String(tick));
  await page.getByRole("textbox", { name: "Tick" }).press("Enter");
}

// A card's accessible name begins with its name; this rule wants all of its text, in the order in which it is drawn.
const RULES = { "label-content-name-mismatch": { enabled: false } };

// What axe finds, that matters to someone.
export async function violations(page) {
  await page.evaluate(AXE);
  const { violations: found } = await page.evaluate((rules) => globalThis.axe.run(document, { rules }), RULES);
  return found.filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, help, nodes }) => `${id}: ${help}: ${nodes.map((node) => node.html).slice(0, 3).join(" | ")}`);
}
