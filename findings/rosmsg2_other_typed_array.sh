#!/usr/bin/env bash
# @foxglove/rosmsg2-serialization 3.1.0: numbers in a typed array of another type than the field's are not written.
#
# The writer takes a plain array, or exactly the typed array of the field: Float64Array for float64. Of any other typed array it
# writes zeros into an array of fixed length, and into others nothing behind their length, and reports no error. So a covariance
# in a Float32Array is all zeros, and a message with `float32[] ranges` in a Float64Array cannot be read, though
# calculateByteSize() counts the elements. @foxglove/rosmsg-serialization, the same for ROS 1, converts them. Array.from()
# avoids it.
#
# Debian packages: nodejs (20 or later), npm. From npm: @foxglove/rosmsg2-serialization 3.1.0, @foxglove/rosmsg 5.0.5, and
# @foxglove/rosmsg-serialization 2.0.4 with tslib 2.8.1, which it needs but does not name.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund \
  @foxglove/rosmsg2-serialization@3.1.0 @foxglove/rosmsg-serialization@2.0.4 @foxglove/rosmsg@5.0.5 tslib@2.8.1

cat >arrays.cjs <<'JS'
const { parse } = require("@foxglove/rosmsg");
const versions = { 1: require("@foxglove/rosmsg-serialization"), 2: require("@foxglove/rosmsg2-serialization") };

function roundTrip(version, type, what, values) {
  const definition = parse(`${type} values\nint32 last`, { ros2: version === "2" });
  const writer = new versions[version].MessageWriter(definition);
  const message = { values, last: 7 };
  const bytes = writer.writeMessage(message);
  let read;
  try {
    const { values, last } = new versions[version].MessageReader(definition).readMessage(bytes);
    read = `${Array.from(values).join(" ")}, then ${last}`;
  } catch {
    read = "an error";
  }
  const size = writer.calculateByteSize(message);
  console.log(`ROS ${version}, ${type} from ${what}: ${bytes.length} bytes of ${size}, read as ${read}`);
}
const given = {
  "an array": [1, 2, 3],
  Float64Array: Float64Array.of(1, 2, 3),
  Float32Array: Float32Array.of(1, 2, 3),
  "Array.from(Float32Array)": Array.from(Float32Array.of(1, 2, 3)),
};
for (const version of ["1", "2"])
  for (const type of ["float64[3]", "float64[]"])
    for (const [what, values] of Object.entries(given)) roundTrip(version, type, what, values);
JS
node arrays.cjs >seen
diff - seen <<'SEEN'
ROS 1, float64[3] from an array: 28 bytes of 28, read as 1 2 3, then 7
ROS 1, float64[3] from Float64Array: 28 bytes of 28, read as 1 2 3, then 7
ROS 1, float64[3] from Float32Array: 28 bytes of 28, read as 1 2 3, then 7
ROS 1, float64[3] from Array.from(Float32Array): 28 bytes of 28, read as 1 2 3, then 7
ROS 1, float64[] from an array: 32 bytes of 32, read as 1 2 3, then 7
ROS 1, float64[] from Float64Array: 32 bytes of 32, read as 1 2 3, then 7
ROS 1, float64[] from Float32Array: 32 bytes of 32, read as 1 2 3, then 7
ROS 1, float64[] from Array.from(Float32Array): 32 bytes of 32, read as 1 2 3, then 7
ROS 2, float64[3] from an array: 32 bytes of 32, read as 1 2 3, then 7
ROS 2, float64[3] from Float64Array: 32 bytes of 32, read as 1 2 3, then 7
ROS 2, float64[3] from Float32Array: 32 bytes of 32, read as 0 0 0, then 7
ROS 2, float64[3] from Array.from(Float32Array): 32 bytes of 32, read as 1 2 3, then 7
ROS 2, float64[] from an array: 40 bytes of 40, read as 1 2 3, then 7
ROS 2, float64[] from Float64Array: 40 bytes of 40, read as 1 2 3, then 7
ROS 2, float64[] from Float32Array: 12 bytes of 40, read as an error
ROS 2, float64[] from Array.from(Float32Array): 40 bytes of 40, read as 1 2 3, then 7
SEEN
echo "@foxglove/rosmsg2-serialization 3.1.0: as described"
