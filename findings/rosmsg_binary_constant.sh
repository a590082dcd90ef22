#!/usr/bin/env bash
# @foxglove/rosmsg 5.0.5: in a ROS 2 message, a constant that is written in binary or octal is 0, and 1_000 is 1.
#
# ROS 2 takes the numbers of .msg files as Python's int(text, 0) does: 0b101, 0o17 and 1_000 are valid, as is 0x1f. parse()
# with `ros2: true` reads the decimal or hexadecimal number in front, and silently leaves the rest. So a mask such as `uint8
# FAULT=0b100` is 0, and no state of a robot matches it. Of types with 64 bits, binary and octal numbers are right, and 1_000
# is an error. Hexadecimal numbers are right.
#
# Each constant also has its text, in `valueText`, by which the value can be checked. A default value has not.
#
# Debian packages: python3, nodejs, npm. From npm: @foxglove/rosmsg 5.0.5.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund @foxglove/rosmsg@5.0.5

cat >numbers.cjs <<'JS'
const { execFileSync } = require("node:child_process");
const { parse } = require("@foxglove/rosmsg");
const python = (expression) => execFileSync("python3", ["-c", `print(${expression})`], { encoding: "utf8" }).trim();
const read = (line) => {
  try {
    const [{ definitions: [{ value, defaultValue }] }] = parse(line, { ros2: true });
    return String(value ?? defaultValue);
  } catch {
    return "an error";
  }
};
const both = (type, text) => `${type} constant ${read(`${type} A=${text}`)}, default ${read(`${type} a ${text}`)}`;
for (const text of ["42", "0x1f", "0b101", "0o17", "1_000"]) {
  const found = ["int32", "int64"].map((type) => both(type, text));
  console.log(`${text}: Python ${python(`int("${text}", 0)`)}; ${found.join("; ")}`);
}
for (const text of ["2.5", "1_000.5"])
  console.log(`${text}: Python ${python(`float("${text}")`)}; ${both("float64", text)}`);
console.log(`[0b01, 0b10]: uint8[] default ${read("uint8[] a [0b01, 0b10]")}`);
JS
node numbers.cjs >seen
diff - seen <<'SEEN'
42: Python 42; int32 constant 42, default 42; int64 constant 42, default 42
0x1f: Python 31; int32 constant 31, default 31; int64 constant 31, default 31
0b101: Python 5; int32 constant 0, default 0; int64 constant 5, default 5
0o17: Python 15; int32 constant 0, default 0; int64 constant 15, default 15
1_000: Python 1000; int32 constant 1, default 1; int64 constant an error, default an error
2.5: Python 2.5; float64 constant 2.5, default 2.5
1_000.5: Python 1000.5; float64 constant 1, default 1
[0b01, 0b10]: uint8[] default 0,0
SEEN
echo "@foxglove/rosmsg 5.0.5: as described"
