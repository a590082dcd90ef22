// The commands of the extension for VS Code, with a stand-in for VS Code: what they start, and the page of a run.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, beforeEach, test } from "node:test";
import { pathToFileURL } from "node:url";

const FOLDER = new URL("../../schema/editors/vscode/", import.meta.url).pathname;
const { build } = createRequire(join(FOLDER, "package.json"))("esbuild");
const work = mkdtempSync(join(tmpdir(), "lockstep-commands-"));
after(() => rmSync(work, { recursive: true }));

const STUB = new URL("vscode_stub.mjs", import.meta.url).pathname;
const entry = join(work, "entry.mjs");
writeFileSync(entry, `export * from ${JSON.stringify(join(FOLDER, "src/commands.ts"))};
export * from ${JSON.stringify(join(FOLDER, "src/client.ts"))};
export { RunView } from ${JSON.stringify(join(FOLDER, "src/run_view.ts"))};
export { stub, Uri } from ${JSON.stringify(STUB)};`);
await build({ entryPoints: [entry], outfile: join(work, "commands.mjs"), bundle: true, platform: "node", format: "esm", alias: { vscode: STUB, "vscode-languageclient/node": STUB } });
const { monitor, onlyLockstep, RunView, stub, test: runTest, Uri, verify, watchSettings } = await import(pathToFileURL(join(work, "commands.mjs")).href);

const tree = join(work, "a tree.xml");
writeFileSync(tree, `<root lockstep="1" main_tree_to_execute="One">
  <BehaviorTree ID="One"><Wait name="first" seconds="1"/></BehaviorTree>
  <BehaviorTree ID="Two"><Wait name="second" seconds="1"/></BehaviorTree></root>`);
const lens = (name) => ({ uri: pathToFileURL(tree).href, path: tree, name });

beforeEach(() => {
  mkdirSync(join(work, "build"), { recursive: true });
  Object.assign(stub, { settings: { program: process.env.LOCKSTEP, pluginPath: ["build", "none"] }, folder: work, documents: [tree],
    active: tree, isTrusted: true, tasks: [], errors: [], panels: [], saved: [] });
});

const words = () => stub.tasks[0].execution.words;
const paths = ["--plugin-path", join(work, "build")]; // and not that of a directory that is not there

test("a lens of a tree or a scenario names it, and the file is saved first", async () => {
  await verify(lens("Two"));
  assert.deepEqual(words(), ["verify", tree, "--tree", "Two", ...paths]);
  assert.deepEqual(stub.saved, [tree]);
  stub.tasks = [];
  await runTest(lens("the arm slips"));
  assert.deepEqual(words(), ["test", tree, "--filter", "the arm slips", ...paths]);
  assert.equal(stub.tasks[0].execution.options.cwd, work);
});

test("from the palette, it is the file of the editor, with the settings", async () => {
  Object.assign(stub.settings, { arguments: { speed: "2" }, plugins: ["motion", "out/arm.so"] });
  await monitor();
  assert.deepEqual(words(), ["run", tree, "--monitor", "--monitor-open", "--arg", "speed=2", ...paths, "--plugin", "motion", "--plugin",
    join(work, "out/arm.so")]);
  Object.assign(stub, { tasks: [], settings: { pluginPath: ["build"] } });
  await runTest(Uri.file(tree)); // from a menu
  assert.deepEqual(words(), ["test", tree, ...paths]);
});

test("in a workspace that is not trusted nothing runs, also from a lens", async () => {
  stub.isTrusted = false;
  for (const command of [runTest, verify, monitor, (given) => new RunView(output).run(given)]) await command(lens("One"));
  assert.equal(stub.tasks.length + stub.panels.length + stub.saved.length, 0);
  assert.equal(stub.errors.length, 4);
  assert.match(stub.errors[0], /trust the workspace/);
});

test("without a file there is a message, and nothing is started", async () => {
  stub.active = undefined;
  await verify();
  assert.equal(stub.tasks.length, 0);
  assert.match(stub.errors[0], /save the file/);
});

const output = { text: "", append(text) { this.text += text; }, show() { this.text += "(shown)"; } };

test("a run shows the page of its recording beside the text, in the same place again", async () => {
  const view = new RunView(output);
  await view.run(lens("Two"));
  assert.deepEqual(stub.errors, []);
  const [panel] = stub.panels;
  assert.match(panel.webview.html, /^<!doctype html>/i);
  assert.equal(panel.title, "Run of a tree.xml");
  assert.ok(panel.options.enableScripts && panel.options.localResourceRoots.length === 0);
  assert.match(output.text, /run of Two starts/);
  await view.run();
  assert.equal(stub.panels.length, 1);
  assert.match(output.text, /run of One starts/);
});

test("a tree that is refused has no run: the output says why", async () => {
  output.text = "";
  const broken = join(work, "broken.xml");
  writeFileSync(broken, "<root");
  stub.active = broken;
  await new RunView(output).run();
  assert.equal(stub.panels.length, 0);
  assert.match(output.text, /broken.xml:1:.*error/);
  assert.match(output.text, /\(shown\)/);
  assert.match(stub.errors[0], /no run.*exit code 3/);
});

test("a program that is not there is named", async () => {
  output.text = "";
  stub.settings.program = join(work, "nowhere/lockstep");
  await new RunView(output).run();
  assert.match(output.text, /ENOENT/);
  assert.equal(stub.panels.length, 0);
});

// A document whose text changes, and the notifications that the server gets.
function watched() {
  const told = [];
  const client = { sendNotification: async (type, params) => told.push([type, params]),
    code2ProtocolConverter: { asOpenTextDocumentParams: (document) => document.getText() } };
  const document = { uri: Uri.file(join(work, "x.xml")), text: "", getText: () => document.text };
  const middleware = onlyLockstep(() => client);
  const next = (what) => async () => void told.push([what]);
  return { told, async open(text) {
    document.text = text;
    await middleware.didOpen(document, next("open"));
  }, async change(text) {
    document.text = text;
    await middleware.didChange({ document }, next("change"));
  }, save: () => middleware.didSave(document, next("save")), close: () => middleware.didClose(document, next("close")) };
}

test("the server gets files of lockstep only, and others as soon as they become one", async () => {
  const other = watched();
  await other.open("<project/>");
  await other.change("<project><a/></project>");
  await other.save();
  await other.close();
  assert.deepEqual(other.told, []);
  const becomes = watched();
  await becomes.open("<project/>");
  await becomes.change('<root lockstep="1">');
  await becomes.change('<root lockstep="1"></root>');
  await becomes.save();
  await becomes.close();
  assert.deepEqual(becomes.told, [["didOpen", '<root lockstep="1">'], ["change"], ["save"], ["close"]]);
  const empty = watched();
  await empty.open("");
  await empty.change("<ro");
  assert.deepEqual(empty.told, [["open"], ["change"]]);
});

test("the server hears that the workspace is trusted, and that settings change", async () => {
  const told = [];
  stub.isTrusted = false;
  watchSettings(() => ({ sendNotification: async (_, { settings }) => told.push(settings.lockstep) }));
  stub.changed({ affectsConfiguration: (it) => it === "editor" });
  stub.changed({ affectsConfiguration: (it) => it === "lockstep" });
  stub.isTrusted = true;
  stub.granted();
  const expected = { plugins: [], pluginPath: [join(work, "build")], arguments: {} };
  assert.deepEqual(told, [{ trusted: false, ...expected }, { trusted: true, ...expected }]);
});
