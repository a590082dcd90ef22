#!/usr/bin/env bash
# libsdformat 12.3.0, Debian 12: of a URDF, a link without mass is left out with all that is beyond it, without an error.
#
# In URDF, `inertial` is optional, and links without it are common. Where two axes cross, one is between them, and a flange is
# one at a fixed joint. libsdformat, by which Gazebo reads a URDF, drops it, and the rest of the arm with it, though that has a
# mass. So it does with a link of 1 mg or less. Load() returns no error, and nothing is printed. urdfdom 3.0.1 reads the whole
# robot. Later releases tell of it, and drop nothing that a fixed joint holds.
#
# Around it: give each link that has links beyond it an inertia and more than 1 mg, and compare the mass of the model.
#
# Debian packages: g++ and, without installing them, those named below.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq libsdformat-dev=12.3.0+ds-2 libsdformat12-12=12.3.0+ds-2 libignition-math-dev=6.10.0+ds3-7+b4 \
  libignition-math6-6=6.10.0+ds3-7+b4 libignition-utils-dev=1.2.0+ds-1 libtinyxml2-9=9.0.0+dfsg-3.1 liburdfdom-dev=3.0.1-1 \
  liburdfdom-model3.0=3.0.1-1 liburdfdom-headers-dev=1.0.5-3 libtinyxml-dev=2.6.2-6+deb12u1 libtinyxml2.6.2v5=2.6.2-6+deb12u1 \
  libconsole-bridge-dev=1.0.1+dfsg2-3+b1 libconsole-bridge1.0=1.0.1+dfsg2-3+b1 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
library=$(dirname "$(find . -name 'liburdfdom_model.so.3.0')")

inertial() { # MASS
  echo "<inertial><mass value='$1'/><inertia ixx='1e-3' ixy='0' ixz='0' iyy='1e-3' iyz='0' izz='1e-3'/></inertial>"
}
joint() { # NAME TYPE PARENT CHILD
  local limit="<limit lower='-1' upper='1' effort='10' velocity='1'/>"
  echo "<joint name='$1' type='$2'><parent link='$3'/><child link='$4'/><origin xyz='0 0 0.1'/><axis xyz='0 1 0'/>$limit</joint>"
}
robot() { # INERTIAL TYPE: the link `cross` has this inertial, and is held by a joint of this type
  echo "<robot name='robot'>"
  echo "<link name='base'>$(inertial 5)</link><link name='cross'>$1</link>"
  echo "<link name='arm'>$(inertial 2)</link><link name='hand'>$(inertial 1)</link>"
  joint pan "$2" base cross
  joint tilt revolute cross arm
  joint wrist revolute arm hand
  echo "</robot>"
}
robot "" revolute >"no inertial.urdf"
robot "" fixed >"no inertial, fixed.urdf"
robot "$(inertial 1e-6)" revolute >"1 mg.urdf"
robot "$(inertial 1e-5)" revolute >"10 mg.urdf"

cat >count.cpp <<'CPP'
#include <urdf_parser/urdf_parser.h>

#include <cstdio>
#include <sdf/sdf.hh>

int main(int, char** files) {
  while (*++files) {
    const auto robot = urdf::parseURDFFile(*files);
    sdf::Root root;
    const sdf::Errors errors = root.Load(*files);
    const sdf::Model* const model = root.Model();
    if (!robot || !model) return 1;
    double mass = 0;
    for (std::uint64_t i = 0; i < model->LinkCount(); ++i) mass += model->LinkByIndex(i)->Inertial().MassMatrix().Mass();
    double read = 0;
    for (const auto& [name, link] : robot->links_) read += link->inertial ? link->inertial->mass : 0;
    std::printf("%s: urdfdom %zu joints, %.1f kg; libsdformat %d joints, %.1f kg, %zu errors\n", *files, robot->joints_.size(),
                read, static_cast<int>(model->JointCount()), mass, errors.size());
  }
}
CPP
g++ -std=c++17 -I usr/include -I usr/include/sdformat-12.3 -I usr/include/ignition/math6 -I usr/include/ignition/utils1 \
  -I usr/include/urdfdom_headers count.cpp -o count -L "$library" -Wl,-rpath-link,"$library" \
  -lsdformat12 -lignition-math6 -lurdfdom_model -lconsole_bridge
LD_LIBRARY_PATH=$library ./count "no inertial.urdf" "no inertial, fixed.urdf" "1 mg.urdf" "10 mg.urdf" >seen 2>&1
diff - seen <<'SEEN'
no inertial.urdf: urdfdom 3 joints, 8.0 kg; libsdformat 0 joints, 5.0 kg, 0 errors
no inertial, fixed.urdf: urdfdom 3 joints, 8.0 kg; libsdformat 0 joints, 5.0 kg, 0 errors
1 mg.urdf: urdfdom 3 joints, 8.0 kg; libsdformat 0 joints, 5.0 kg, 0 errors
10 mg.urdf: urdfdom 3 joints, 8.0 kg; libsdformat 3 joints, 8.0 kg, 0 errors
SEEN
echo "libsdformat 12.3.0+ds-2: as described"
