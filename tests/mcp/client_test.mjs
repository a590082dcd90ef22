// The official client of the Model Context Protocol drives `lockstep mcp`: from an empty folder to a verified tree.
import assert from "node:assert/strict";
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Client } from "@modelcontextprotocol/sdk/client/index.js";
import { StdioClientTransport } from "@modelcontextprotocol/sdk/client/stdio.js";

const program = join(process.env.LOCKSTEP_BUILD, "lockstep");
const folder = mkdtempSync(join(tmpdir(), "lockstep-mcp-test-"));
const client = new Client({ name: "test", version: "1" });

before(async () => {
  await client.connect(
    new StdioClientTransport({ command: program, args: ["mcp", "--workspace", folder, "--time", "120"], stderr: "inherit" }),
  );
  await client.listTools(); // from now on the client compares each result with its schema
});

after(async () => {
  await client.close();
  rmSync(folder, { recursive: true });
});

async function call(name, args) {
  const result = await client.callTool({ name, arguments: args });
  assert.ok(!result.isError, `${name}: ${result.content?.[0]?.text}`);
  assert.deepEqual(JSON.parse(result.content[0].text), result.structuredContent);
  return result.structuredContent;
}

// Applies an edit, as a program does that knows nothing but the JSON of check.
function applied(text, edit) {
  let bytes = Buffer.from(text);
  for (const { begin, end, text: patch } of [...edit.patches].sort((a, b) => b.begin - a.begin)) {
    bytes = Buffer.concat([bytes.subarray(0, begin), Buffer.from(patch), bytes.subarray(end)]);
  }
  return bytes.toString();
}

const broken = `<root lockstep="1">
  <barrier name="door" barriers="0.5"/>
  <BehaviorTree ID="OpenDoor">
    <Sequnce memroy="true">
      <Wait secnds="1" name="reach"/>
      <Parallel>
        <SyncProgress barrier="dor"><Wait name="pull" seconds="1"/></SyncProgress>
        <SyncProgress barrier="door"><Wait name="back" seconds="two"/></SyncProgress>
      </Parallel>
    </Sequnce>
  </BehaviorTree>
</root>
`;
const leaves = '<leaves lockstep="1" rate="10"/>\n';

test("it says what it is", () => {
  assert.equal(client.getServerVersion().name, "lockstep");
  assert.match(client.getInstructions(), /behavior trees/);
});

test("all tools have schemas, and none writes", async () => {
  const { tools } = await client.listTools();
  const names = ["nodes", "check", "format", "show", "test", "verify", "simulate", "measure", "why", "diff", "scenario_from"];
  assert.deepEqual(tools.map((it) => it.name), names);
  for (const it of tools) {
    assert.equal(it.inputSchema.type, "object");
    assert.equal(it.outputSchema.type, "object");
    assert.ok(it.annotations.readOnlyHint);
  }
});

test("resources can be read", async () => {
  const { resources } = await client.listResources();
  const uris = resources.map((it) => it.uri);
  for (const uri of ["lockstep://docs/nodes-and-attributes", "lockstep://docs/nodes", "lockstep://examples/door_pulling"]) {
    assert.ok(uris.includes(uri), uri);
    const { contents } = await client.readResource({ uri });
    assert.ok(contents[0].text.length > 100);
  }
  await assert.rejects(client.readResource({ uri: "lockstep://docs/../../etc/passwd" }));
});

test("from an empty folder to a verified tree", async () => {
  const { nodes } = await call("nodes", { id: "SyncProgress" });
  assert.equal(nodes[0].id, "SyncProgress");
  let text = broken;
  let rounds = 0;
  for (; ; ++rounds) {
    assert.ok(rounds < 10, text);
    const { messages } = await call("check", { text });
    const mendable = messages.find((it) => it.severity === "error");
    if (mendable === undefined) break;
    assert.ok(mendable.edits.length > 0, JSON.stringify(mendable));
    text = applied(text, mendable.edits[0]);
  }
  assert.equal(rounds, 5);
  ({ text } = await call("format", { text }));
  writeFileSync(join(folder, "door.xml"), text);
  writeFileSync(join(folder, "door.leaves.xml"), leaves);
  const tree = "door.xml";
  assert.match((await call("show", { tree })).drawing, /Sequence/);
  const proof = await call("verify", { tree, leaves: "door.leaves.xml", properties: ["never reach.failure"] });
  assert.equal(proof.exit_code, 0, JSON.stringify(proof));
  const { summary } = await call("simulate", { tree, leaves: "door.leaves.xml" });
  assert.equal(summary.result, "success");
  assert.ok((await call("measure", {})).measures);
  assert.ok((await call("why", { node: "reach" })).reasons);
  const { scenario } = await call("scenario_from", { tree });
  writeFileSync(join(folder, "door.test.xml"), scenario);
  const tested = await call("test", { paths: ["door.test.xml"] });
  assert.equal(tested.exit_code, 0, JSON.stringify(tested));
  const { changes } = await call("diff", { before: tree, after_text: text.replace('name="reach"', 'name="grasp"') });
  assert.ok(JSON.stringify(changes).includes("grasp"));
  const last = await client.readResource({ uri: "lockstep://recordings/last" });
  assert.match(last.contents[0].text, /lockstep/);
  assert.deepEqual(readdirSync(folder).sort(), ["door.leaves.xml", "door.test.xml", "door.xml"]);
});

test("what is wrong is a result that says so", async () => {
  for (const [name, args, why] of [
    ["check", { tree: "../outside.xml" }, /outside of the workspace/],
    ["check", { tree: "/etc/passwd" }, /outside of the workspace/],
    ["check", {}, /needs one of/],
    ["check", { text: "<a/>", tree: "door.xml" }, /needs only one of/],
    ["check", { txt: "<a/>" }, /did you mean 'text'/],
    ["verify", { text: "<root/>" }, /BehaviorTree|root/],
    ["why", { recording: "none.jsonl" }, /none.jsonl/],
    ["nodes", { id: "--help" }, /begins with/],
  ]) {
    const result = await client.callTool({ name, arguments: args });
    assert.ok(result.isError, name);
    assert.match(result.content[0].text, why);
  }
  await assert.rejects(client.callTool({ name: "chek", arguments: {} }), /did you mean 'check'/);
});

// A search that does not end by itself.
const endless = `<root lockstep="1"><BehaviorTree ID="Main"><Parallel success_count="9" failure_count="9">
${Array.from({ length: 9 }, (_, i) => `<Retry attempts="${i + 2}"><Sequence memory="true"><A${i}/><B${i}/></Sequence></Retry>`).join("\n")}
</Parallel></BehaviorTree></root>`;

test("a call can be canceled, and reports its progress", async () => {
  const stop = new AbortController();
  let notes = 0;
  const waiting = client.callTool({ name: "verify", arguments: { text: endless, mock: true } }, undefined, {
    signal: stop.signal,
    onprogress: ({ progress }) => {
      assert.ok(progress > 0);
      ++notes;
      stop.abort("enough");
    },
  });
  await assert.rejects(waiting, /enough/);
  assert.equal(notes, 1);
  assert.ok(await client.ping());
});
