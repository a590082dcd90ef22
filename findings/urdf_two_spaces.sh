#!/usr/bin/env bash
# roslib 2.1.0: UrdfModel puts a joint to 0 0 0 when two spaces are between the numbers of its origin in the URDF.
#
# Files have more than one space to align columns, or from a generator. urdfdom 3.0.1, Debian 12, skips them. roslib takes
# "0  0 0.5" for four numbers, one of which is empty. It then silently drops all of `xyz`, `rpy`, the color or the size. Such an
# `axis` is an error. urdf-loader 0.13.1 skips spaces in `xyz` and `rpy`, but not everywhere. In an axis that begins with a
# space, and in a color with two spaces, one number is NaN, and the others move on.
#
# Replacing each run of white space in these attributes by one space, before the model is made, avoids it.
#
# Debian packages: g++, nodejs, npm and, without installing them, those named below. From npm: roslib 2.1.0, urdf-loader
# 0.13.1, three 0.187.0 and, for a document without a browser, jsdom 26.1.0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq liburdfdom-dev=3.0.1-1 liburdfdom-model3.0=3.0.1-1 liburdfdom-headers-dev=1.0.5-3 \
  libtinyxml-dev=2.6.2-6+deb12u1 libtinyxml2.6.2v5=2.6.2-6+deb12u1 libconsole-bridge-dev=1.0.1+dfsg2-3+b1 \
  libconsole-bridge1.0=1.0.1+dfsg2-3+b1 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
library=$(dirname "$(find . -name 'liburdfdom_model.so.3.0')")
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund roslib@2.1.0 urdf-loader@0.13.1 three@0.187.0 jsdom@26.1.0

robot() { # XYZ RPY SIZE COLOR AXIS
  cat <<XML
<robot name="robot">
  <link name="base"/>
  <link name="arm">
    <visual>
      <origin xyz="$1" rpy="$2"/>
      <geometry><box size="$3"/></geometry>
      <material name="paint"><color rgba="$4"/></material>
    </visual>
  </link>
  <joint name="shoulder" type="continuous">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="$1" rpy="$2"/>
    <axis xyz="$5"/>
  </joint>
</robot>
XML
}
robot "1 2 0.5" "0 0 1.5" "1 2 3" "0.2 0.4 0.6 1" "0 0 1" >"one space.urdf"
robot "1  2 0.5" "0  0 1.5" "1  2 3" "0.2  0.4 0.6 1" "0 0 1" >"two spaces.urdf"
robot " 1 2 0.5" " 0 0 1.5" " 1 2 3" " 0.2 0.4 0.6 1" "0 0 1" >"space in front.urdf"
robot "1 2 0.5" "0 0 1.5" "1 2 3" "0.2 0.4 0.6 1" " 0 0 1" >"space in front of axis.urdf"

cat >urdfdom.cpp <<'CPP'
#include <urdf_parser/urdf_parser.h>

#include <cstdio>

int main(int, char** files) {
  while (*++files) {
    const auto robot = urdf::parseURDFFile(*files);
    if (!robot) return 1;
    const auto joint = robot->getJoint("shoulder");
    const auto visual = robot->getLink("arm")->visual;
    const auto box = std::static_pointer_cast<urdf::Box>(visual->geometry);
    const auto& at = joint->parent_to_joint_origin_transform;
    double roll, pitch, yaw;
    at.rotation.getRPY(roll, pitch, yaw);
    std::printf("%s, urdfdom: at %g %g %g, yaw %.1f, axis %g %g %g, box %g %g %g, color %g %g %g\n", *files, at.position.x,
                at.position.y, at.position.z, yaw, joint->axis.x, joint->axis.y, joint->axis.z, box->dim.x, box->dim.y,
                box->dim.z, visual->material->color.r, visual->material->color.g, visual->material->color.b);
  }
}
CPP
g++ -std=c++17 -I usr/include -I usr/include/urdfdom_headers urdfdom.cpp -o urdfdom -L "$library" -Wl,-rpath-link,"$library" \
  -lurdfdom_model -lconsole_bridge

cat >read.mjs <<'JS'
import { readFileSync } from "node:fs";
import { JSDOM } from "jsdom";
import { UrdfModel } from "roslib";
import { Euler } from "three";

const { window } = new JSDOM("");
for (const name of ["DOMParser", "Document", "Element"]) globalThis[name] = window[name];
const { default: URDFLoader } = await import("urdf-loader");

const list = (...numbers) => numbers.map((number) => Number(number.toFixed(3))).join(" ");
function roslib(text) {
  const model = new UrdfModel({ string: text });
  const { origin, axis } = model.joints.shoulder;
  const { position: at, orientation: q } = origin;
  const { geometry, material } = model.links.arm.visuals[0];
  const yaw = Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)).toFixed(1);
  const size = geometry.dimension;
  const box = size ? list(size.x, size.y, size.z) : "without a size";
  const color = list(material.color.r, material.color.g, material.color.b);
  return `at ${list(at.x, at.y, at.z)}, yaw ${yaw}, axis ${list(axis.x, axis.y, axis.z)}, box ${box}, color ${color}`;
}
function urdfLoader(text) {
  const robot = new URDFLoader().parse(text);
  const { position: at, quaternion, axis } = robot.joints.shoulder;
  const yaw = new Euler().setFromQuaternion(quaternion, "ZYX").z.toFixed(1);
  const mesh = robot.links.arm.children[0].children[0];
  const color = list(...mesh.material.color.toArray());
  return `at ${list(...at)}, yaw ${yaw}, axis ${list(...axis)}, box ${list(...mesh.scale)}, color ${color}`;
}
for (const file of process.argv.slice(2))
  for (const [name, read] of Object.entries({ roslib, "urdf-loader": urdfLoader })) {
    let found;
    try {
      found = read(readFileSync(file, "utf8"));
    } catch {
      found = "an error";
    }
    console.log(`${file}, ${name}: ${found}`);
  }
JS
files=("one space.urdf" "two spaces.urdf" "space in front.urdf" "space in front of axis.urdf")
{
  LD_LIBRARY_PATH=$library ./urdfdom "${files[@]}"
  node read.mjs "${files[@]}"
} >seen
diff - seen <<'SEEN'
one space.urdf, urdfdom: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 0.4 0.6
two spaces.urdf, urdfdom: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 0.4 0.6
space in front.urdf, urdfdom: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 0.4 0.6
space in front of axis.urdf, urdfdom: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 0.4 0.6
one space.urdf, roslib: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 0.4 0.6
one space.urdf, urdf-loader: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 0.4 0.6
two spaces.urdf, roslib: at 0 0 0, yaw 0.0, axis 0 0 1, box without a size, color 0 0 0
two spaces.urdf, urdf-loader: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color 0.2 NaN 0.4
space in front.urdf, roslib: at 0 0 0, yaw 0.0, axis 0 0 1, box without a size, color 0 0 0
space in front.urdf, urdf-loader: at 1 2 0.5, yaw 1.5, axis 0 0 1, box 1 2 3, color NaN 0.2 0.4
space in front of axis.urdf, roslib: an error
space in front of axis.urdf, urdf-loader: at 1 2 0.5, yaw 1.5, axis NaN 0 0, box 1 2 3, color 0.2 0.4 0.6
SEEN
echo "roslib 2.1.0, urdf-loader 0.13.1: as described"
