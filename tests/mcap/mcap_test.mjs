// What `log export --format mcap` and `run --record FILE.mcap` write, read with the packages of MCAP's authors, is the recording: each status,
// progress, entry and log line, at its time; and the summary is right.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";

const source = join(dirname(fileURLToPath(import.meta.url)), "../..");
const require = createRequire(join(source, "interpreter/show/web/page/package.json"));
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");

const lockstep = join(process.env.LOCKSTEP_BUILD, "lockstep");
const folder = mkdtempSync(join(tmpdir(), "lockstep-mcap-"));
after(() => rmSync(folder, { recursive: true }));

function record(tree, more = []) {
  const file = join(folder, "run.jsonl");
  spawnSync(lockstep, ["run", tree, "--clock", "virtual", "--record", file, ...more]);
  return file;
}

function linesOf(file) {
  return readFileSync(file, "utf8").trim().split("\n").map((line) => JSON.parse(line));
}

async function open(file) {
  const bytes = readFileSync(file);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
  };
  return McapIndexedReader.Initialize({ readable, decompressHandlers: await loadDecompressHandlers() });
}

// By topic: [time, message].
async function messagesOf(file) {
  const reader = await open(file);
  const topics = new Map();
  let last = 0n, count = 0n;
  for await (const { channelId, logTime, data } of reader.readMessages()) {
    assert(logTime >= last);
    last = logTime;
    ++count;
    const { topic } = reader.channelsById.get(channelId);
    if (!topics.has(topic)) topics.set(topic, []);
    topics.get(topic).push([logTime, JSON.parse(new TextDecoder().decode(data))]);
  }
  assert.equal(reader.statistics.messageCount, count);
  assert.equal(reader.statistics.channelCount, reader.channelsById.size);
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  for (const [id, { topic }] of reader.channelsById) {
    assert.equal(reader.statistics.channelMessageCounts.get(id) ?? 0n, BigInt(topics.get(topic)?.length ?? 0));
  }
  for (const { encoding, data } of reader.schemasById.values()) {
    assert.equal(encoding, "jsonschema");
    JSON.parse(new TextDecoder().decode(data));
  }
  return topics;
}

const nanoseconds = (seconds) => BigInt(Math.round(seconds * 1e9));

async function compare(file, out, start = 0) {
  const [header, ...lines] = linesOf(file);
  const topics = await messagesOf(out);
  const statuses = topics.get("/lockstep/status");
  const entries = new Map(), state = new Map();
  let at = 0;
  for (const line of lines) {
    if (!("tick" in line)) continue;
    const time = nanoseconds(line.time_s) + nanoseconds(start);
    for (const [node, status, progress, ticked, held] of line.nodes) {
      state.set(header.nodes[node].path, { status, progress, ticked: ticked === 1, held: held === 1 });
    }
    for (const [entry] of line.entries ?? []) {
      const { key } = header.entries[entry];
      entries.set(key, (entries.get(key) ?? 0) + 1);
    }
    if (statuses[at]?.[1].tick !== line.tick) continue;
    assert.equal(statuses[at][0], time);
    for (const { path, ...rest } of statuses[at][1].changes) assert.deepEqual(rest, state.get(path));
    ++at;
  }
  assert.equal(at, statuses.length);
  for (const [key, count] of entries) assert.equal(topics.get(`/lockstep/entries/${key}`).length, count);
  // The last state of all nodes follows from the changes.
  const read = new Map();
  for (const [, { changes }] of statuses) for (const { path, ...rest } of changes) read.set(path, rest);
  for (const [path, rest] of state) assert.deepEqual(read.get(path) ?? rest, rest);
  return topics;
}

function convert(file, more = []) {
  const out = join(folder, "run.mcap");
  execFileSync(lockstep, ["log", "export", file, "--format", "mcap", "--out", out, ...more]);
  return out;
}

for (const tree of ["fetch_and_carry", "museum_guide", "door_pulling", "replanning", "two_robots"]) {
  test(`${tree}: the same as its recording`, async () => {
    const file = record(join(source, `trees/${tree}.xml`), ["--max-ticks", "20000"]);
    const topics = await compare(file, convert(file));
    const log = topics.get("/lockstep/log");
    assert.match(log.at(-1)[1].message, /^run ended: /);
  });
}

test("the progress of a synchronized node is a message for each of its ticks", async () => {
  const file = record(join(source, "trees/door_pulling.xml"));
  const topics = await messagesOf(convert(file));
  const [topic] = [...topics.keys()].filter((it) => it.startsWith("/lockstep/progress/"));
  const messages = topics.get(topic);
  for (const [, { progress, held, limit }] of messages) {
    assert.deepEqual(Object.keys(progress), Object.keys(held));
    for (const value of Object.values(progress)) assert(value >= 0 && value <= 1);
    assert(limit === null || (limit >= 0 && limit <= 1));
  }
});

test("--start-time moves all times", async () => {
  const file = record(join(source, "trees/door_pulling.xml"));
  await compare(file, convert(file, ["--start-time", "1700000000"]), 1_700_000_000);
});

test("a reader that goes through the file from its begin finds no error", async () => {
  const file = convert(record(join(source, "trees/fetch_and_carry.xml")));
  const reader = new McapStreamReader({ decompressHandlers: await loadDecompressHandlers(), validateCrcs: true });
  reader.append(readFileSync(file));
  let messages = 0;
  for (let record; (record = reader.nextRecord()); ) messages += record.type === "Message" ? 1 : 0;
  assert(reader.done());
  assert.equal(BigInt(messages), (await open(file)).statistics.messageCount);
});

for (const tree of ["fetch_and_carry", "philosophers", "replanning"]) {
  test(`${tree}: run --record FILE.mcap has the messages of the export`, async () => {
    const path = join(source, `trees/${tree}.xml`), direct = join(folder, "direct.mcap");
    const exported = await messagesOf(convert(record(path, ["--max-ticks", "20000"])));
    spawnSync(lockstep, ["run", path, "--clock", "virtual", "--record", direct, "--max-ticks", "20000"]);
    assert.deepEqual(await messagesOf(direct), exported);
  });
}

// A run on the robot's clock that is ended by a signal as soon as its file has some chunks.
async function ended(signal) {
  const file = join(folder, `${signal}.mcap`);
  const args = ["run", join(source, "trees/fetch_and_carry.xml"), "--rate", "1000", "--record", file];
  const run = spawn(lockstep, args, { stdio: "ignore" });
  const end = once(run, "exit");
  while (!existsSync(file) || statSync(file).size < 20_000) await new Promise(setImmediate);
  run.kill(signal);
  await end;
  return file;
}

test("a run that is ended by SIGTERM has a complete file, with times since 1970", async () => {
  const began = BigInt(Date.now()) * 1_000_000n;
  const topics = await messagesOf(await ended("SIGTERM"));
  const log = topics.get("/lockstep/log");
  assert.match(log.at(-1)[1].message, /^run ended: stopped \(signal\)$/);
  const [first] = topics.get("/lockstep/status")[0];
  assert(first >= began - 1_000_000_000n && first <= BigInt(Date.now()) * 1_000_000n);
});

test("of a run that is killed, a reader that goes through the file has all whole chunks", async () => {
  const reader = new McapStreamReader({ decompressHandlers: await loadDecompressHandlers(), validateCrcs: true });
  reader.append(readFileSync(await ended("SIGKILL")));
  let messages = 0;
  for (let record; (record = reader.nextRecord()); ) messages += record.type === "Message" ? 1 : 0;
  assert(messages > 100);
});
