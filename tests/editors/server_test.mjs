// The language server, as VS Code's own client library speaks to it: what it says of a file is what check says.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const SOURCES = new URL("../../", import.meta.url).pathname;
const LOCKSTEP = process.env.LOCKSTEP;
const require = createRequire(join(SOURCES, "schema/editors/vscode/package.json"));
const rpc = require("vscode-jsonrpc/node");

let server, connection;
const waiting = new Map(); // for the diagnostics of a URI

before(async () => {
  server = spawn(LOCKSTEP, ["lsp"], { stdio: ["pipe", "pipe", "inherit"] });
  connection = rpc.createMessageConnection(new rpc.StreamMessageReader(server.stdout), new rpc.StreamMessageWriter(server.stdin));
  connection.onNotification("textDocument/publishDiagnostics", (params) => waiting.get(params.uri)?.(params));
  connection.onRequest("client/registerCapability", () => null);
  connection.listen();
  const capabilities = { textDocument: { publishDiagnostics: { relatedInformation: true } } };
  await connection.sendRequest("initialize", { processId: process.pid, rootUri: pathToFileURL(SOURCES).href, capabilities });
  await connection.sendNotification("initialized", {});
});

after(async () => {
  await connection.sendRequest("shutdown");
  await connection.sendNotification("exit");
  assert.equal(await new Promise((resolve) => server.once("exit", resolve)), 0);
});

// Once they have all of `messages`, or 30 s later: what a search finds comes after the rest.
async function diagnosticsOf(path, text, messages = []) {
  const uri = pathToFileURL(path).href;
  const told = new Promise((resolve) => {
    waiting.set(uri, (params) => {
      const found = params.diagnostics.map((it) => `${it.range.start.line + 1}: ${it.message}`);
      if (messages.every((it) => found.includes(it))) resolve(params);
      else setTimeout(resolve, 30_000, params).unref();
    });
  });
  await connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "xml", version: 1, text } });
  const { diagnostics } = await told;
  waiting.delete(uri);
  await connection.sendNotification("textDocument/didClose", { textDocument: { uri } });
  return diagnostics;
}

function checked(path) {
  const { stdout } = spawnSync(LOCKSTEP, ["check", "--format", "json", path], { encoding: "utf8" });
  return JSON.parse(stdout);
}

const BAD = join(SOURCES, "tests/trees/bad");
const files = readdirSync(BAD).filter((name) => name.endsWith(".xml") && !name.endsWith(".test.xml") && !name.endsWith(".leaves.xml"));

test("each bad tree has the messages of check, in its lines", async () => {
  let count = 0;
  for (const name of files) {
    const path = join(BAD, name);
    const bytes = readFileSync(path);
    const text = bytes.toString("utf8");
    if (!Buffer.from(text, "utf8").equals(bytes)) continue; // no editor has such a text
    const expected = checked(path).filter((it) => it.file === path).map((it) => `${it.line}: ${it.message}`);
    const found = (await diagnosticsOf(path, text, expected)).map((it) => `${it.range.start.line + 1}: ${it.message}`);
    for (const message of expected) assert.ok(found.includes(message), `${name}: ${message}\nin ${JSON.stringify(found)}`);
    count += expected.length;
  }
  assert.ok(count > 100, `${count} messages`);
});

test("the commands of code lenses are those of the extension, and say which file and what in it", async () => {
  const about = JSON.parse(readFileSync(join(SOURCES, "schema/editors/vscode/package.json"), "utf8"));
  const known = about.contributes.commands.map((it) => it.command);
  const texts = { "a.xml": '<root lockstep="1"><BehaviorTree ID="One"><Wait seconds="1"/></BehaviorTree></root>',
    "a.test.xml": '<scenarios lockstep="1" tree="a.xml"><scenario name="all"/></scenarios>' };
  const found = [];
  for (const [name, text] of Object.entries(texts)) {
    const uri = pathToFileURL(join("/tmp", name)).href;
    await connection.sendNotification("textDocument/didOpen", { textDocument: { uri, languageId: "xml", version: 1, text } });
    for (const { command } of await connection.sendRequest("textDocument/codeLens", { textDocument: { uri } })) {
      assert.ok(known.includes(command.command), command.command);
      assert.equal(command.arguments[0].uri, uri);
      found.push(`${command.command} ${command.arguments[0].name}`);
    }
  }
  assert.deepEqual(found.sort(), ["lockstep.run One", "lockstep.test all", "lockstep.verify One"]);
});

test("a cancelled request is refused as cancelled, and the server goes on", async () => {
  const cancel = new rpc.CancellationTokenSource();
  const answer = connection.sendRequest("textDocument/hover", { textDocument: { uri: "file:///none.xml" }, position: { line: 0, character: 0 } }, cancel.token);
  cancel.cancel();
  await answer.catch(() => undefined);
  assert.ok((await diagnosticsOf("/tmp/lockstep-none.xml", "<root lockstep=\"1\">")).length > 0);
});
