#!/usr/bin/env bash
# @turf/line-offset and @turf/square-grid 7.4.0: away from the equator, a distance to the east or west comes out too short.
#
# lineOffset() is documented to move a line by a distance, and squareGrid() to make cells with a side of a length. Both turn
# meters into degrees as at the equator, and use them as degrees of longitude too. At 60 degrees north, a line to the north is
# moved by 5 m instead of 10 m, and "squares" are 10 m by 5 m. At 45 degrees it is 7 m. A line that runs askew is also not
# parallel. A robot that mows by such lines cuts each strip twice, and one that keeps a distance to a line keeps half of it.
#
# Around it: multiply the longitudes by the cosine of the latitude, and divide those of the result by it, as `right` does. For
# lines of some kilometers this is good enough. buffer(), pointGrid() and hexGrid() of the same library are right.
#
# Debian packages: nodejs, npm. From npm: @turf/line-offset, @turf/square-grid, @turf/destination, @turf/distance, all 7.4.0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund \
  @turf/line-offset@7.4.0 @turf/square-grid@7.4.0 @turf/destination@7.4.0 @turf/distance@7.4.0

cat >offset.mjs <<'JS'
import { destination } from "@turf/destination";
import { distance } from "@turf/distance";
import { lineOffset } from "@turf/line-offset";
import { squareGrid } from "@turf/square-grid";

const meters = { units: "meters" };
const line = (coordinates) => ({ type: "Feature", properties: {}, geometry: { type: "LineString", coordinates } });
const far = (from, length, bearing) => destination(from, length, bearing, meters).geometry.coordinates;
const plain = (points, by) => lineOffset(line(points), by, meters).geometry.coordinates;
const right = (points, by) => {
  const scale = Math.cos((points[0][1] * Math.PI) / 180);
  const moved = plain(points.map(([longitude, latitude]) => [longitude * scale, latitude]), by);
  return moved.map(([longitude, latitude]) => [longitude / scale, latitude]);
};

for (const latitude of [0, 45, 60]) {
  const start = [10, latitude];
  for (const [heading, bearing] of Object.entries({ east: 90, north: 0 })) {
    const ends = [start, far(start, 100, bearing)];
    const shown = [plain, right].map((move) => distance(start, move(ends, 10)[0], meters).toFixed(2));
    console.log(`latitude ${latitude}, to the ${heading}: 10 m aside is ${shown[0]} m, with the cosine ${shown[1]} m`);
  }
  const area = [...start, ...far(far(start, 100, 90), 100, 0)];
  const [corner, next, last] = squareGrid(area, 10, meters).features[0].geometry.coordinates[0];
  const sides = [distance(corner, next, meters), distance(next, last, meters)].map((side) => side.toFixed(2));
  console.log(`latitude ${latitude}, a square with a side of 10 m: ${sides.join(" m by ")} m`);
}
JS
node offset.mjs >seen
diff - seen <<'SEEN'
latitude 0, to the east: 10 m aside is 10.00 m, with the cosine 10.00 m
latitude 0, to the north: 10 m aside is 10.00 m, with the cosine 10.00 m
latitude 0, a square with a side of 10 m: 10.00 m by 10.00 m
latitude 45, to the east: 10 m aside is 10.00 m, with the cosine 10.00 m
latitude 45, to the north: 10 m aside is 7.07 m, with the cosine 10.00 m
latitude 45, a square with a side of 10 m: 10.00 m by 7.07 m
latitude 60, to the east: 10 m aside is 10.00 m, with the cosine 10.00 m
latitude 60, to the north: 10 m aside is 5.00 m, with the cosine 10.00 m
latitude 60, a square with a side of 10 m: 10.00 m by 5.00 m
SEEN
echo "@turf/line-offset, @turf/square-grid 7.4.0: as described"
