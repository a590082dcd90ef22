#!/usr/bin/env bash
# uPlot 1.6.32: after a scale's range() has returned a range of no width, setData() never asks it again.
#
# A scale with `auto: false` and a function `range` decides itself what it shows. With a single point at 0 it is
# natural to return [0, 0]. From then on setData() reads the scale's last min and max, finds that they are equal, and
# returns before it calls range(): the chart stays at [0, 0], whatever data comes. Width 1e-3 for the first point is
# enough to avoid it.
#
# Debian packages: nodejs, npm. From npm: uplot 1.6.32 and, for a document without a browser, jsdom 26.1.0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund uplot@1.6.32 jsdom@26.1.0

cat >chart.cjs <<'JS'
const { readFileSync } = require("node:fs");
const { JSDOM } = require("jsdom");
const { window } = new JSDOM("<body></body>", { pretendToBeVisual: true, runScripts: "outside-only" });
// jsdom has no canvas, and nothing needs to be drawn.
const nothing = new Proxy(() => {}, { get: (_, name) => (name === "measureText" ? () => ({ width: 0 }) : nothing), set: () => true });
window.HTMLCanvasElement.prototype.getContext = () => nothing;
window.matchMedia = () => ({ addEventListener() {}, removeEventListener() {} });
window.Path2D = class { arc() {} rect() {} moveTo() {} lineTo() {} };
const uPlot = window.eval(readFileSync("node_modules/uplot/dist/uPlot.iife.js", "utf8") + "; uPlot");
const frame = () => new Promise((done) => setTimeout(done, 20));

async function shown(leastWidth) {
  let times = [], asked = 0;
  const plot = new uPlot({
    width: 300, height: 200, series: [{}, {}],
    scales: { x: { time: false, auto: false, range: () => (++asked, [0, Math.max(leastWidth, times.at(-1) ?? 1)]) } },
  }, [[], []], window.document.body);
  for (let length = 1; length <= 4; ++length) {
    times = Array.from({ length }, (_, place) => place);
    asked = 0;
    plot.setData([times, times]);
    await frame();
    console.log(`points: ${length}, range() ${asked ? "called" : "not called"}, x from ${plot.scales.x.min} to ${plot.scales.x.max}`);
  }
}
(async () => {
  console.log("range of no width at first:");
  await shown(0);
  console.log("range of width 0.001 at first:");
  await shown(1e-3);
  process.exit(0);
})();
JS
node chart.cjs >seen
diff - seen <<'SEEN'
range of no width at first:
points: 1, range() called, x from 0 to 0
points: 2, range() not called, x from 0 to 0
points: 3, range() not called, x from 0 to 0
points: 4, range() not called, x from 0 to 0
range of width 0.001 at first:
points: 1, range() called, x from 0 to 0.001
points: 2, range() called, x from 0 to 1
points: 3, range() called, x from 0 to 2
points: 4, range() called, x from 0 to 3
SEEN
echo "uplot 1.6.32: as described"
