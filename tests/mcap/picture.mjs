// Draws docs/mcap.svg from the messages of an MCAP file alone, as Foxglove or PlotJuggler would: progress beside joints.
//     build/release/lockstep run trees/late_progress.xml --arg sync=absolute --arg barrier_count=4 --arg latency=0.25 \
//       --rate 20 --clock virtual --record run.mcap && node tests/mcap/picture.mjs run.mcap docs/mcap.svg
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(new URL("../../interpreter/show/web/page/package.json", import.meta.url));
const { McapIndexedReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");

const [file, picture] = process.argv.slice(2);
const bytes = readFileSync(file);
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
};
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: await loadDecompressHandlers() });

const curves = new Map();
function add(name, time, value) {
  if (!curves.has(name)) curves.set(name, []);
  curves.get(name).push(`${Number(time) / 1e9} ${value ?? "nan"}`);
}
for await (const { channelId, logTime, data } of reader.readMessages()) {
  const { topic } = reader.channelsById.get(channelId);
  const message = JSON.parse(new TextDecoder().decode(data));
  if (topic.startsWith("/lockstep/progress/")) {
    for (const [child, value] of Object.entries(message.progress)) add(`progress.${child}`, logTime, value);
    add("limit", logTime, message.limit);
  } else if (/^\/lockstep\/entries\/(arm|base)$/.test(topic)) {
    add(`${topic}.value`, logTime, message.value);
  }
}

const names = [...curves.keys()];
const block = (name) => `$curve${names.indexOf(name)}`;
const style = (name) => (name === "limit" ? "steps dt 2 lc black" : "lines lw 1.5");
const plot = (chosen) => "plot " + chosen.map((name) => `${block(name)} with ${style(name)} title "${name}"`).join(", ");
const data = names.map((name) => `${block(name)} << end\n${curves.get(name).join("\n")}\nend`).join("\n");
const isJoint = (name) => name.startsWith("/");
execFileSync("gnuplot", {
  input: `${data}
set terminal svg size 820,440 font "sans,11" background "white"
set output "${picture}"
set multiplot layout 2,1
set key outside right top width -4
set lmargin 8
set rmargin 30
set xrange [0:5]
set yrange [0:1.05]
set ylabel "/lockstep/progress/…"
${plot(names.filter((name) => !isJoint(name)))}
set ylabel "joints"
set xlabel "seconds"
${plot(names.filter(isJoint))}
`,
});
