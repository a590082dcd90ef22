#!/usr/bin/env bash
# Ignition Math 6.10.0, Debian 12: Quaternion::ToAxis() gives an angle of 0 for every rotation below 0.002 rad.
#
# ToAxis() compares the square of a length with a tolerance that is meant for a length. So a rotation of less than 0.115
# degrees comes back as none, about the x axis. The quaternion itself holds it. A gyroscope at 100 Hz gives such steps up to
# 0.2 rad/s. Who adds them up as axis and angle gets a robot that never turns. The documentation names no limit. Later
# releases, called Gazebo Math, compare the length.
#
# Around it: take twice Log(), which is the axis times the angle, and which is right for small rotations too.
#
# Debian packages: g++ and, without installing it, libignition-math-dev.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq libignition-math-dev=6.10.0+ds3-7+b4 libignition-math6-6=6.10.0+ds3-7+b4 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
library=$(dirname "$(find . -name 'libignition-math6.so.6')")

cat >steps.cpp <<'CPP'
#include <cstdio>
#include <ignition/math/Quaternion.hh>

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

double by_axis(const Quaterniond& turn) {
  Vector3d axis;
  double angle;
  turn.ToAxis(axis, angle);
  return axis.Z() * angle;
}

double by_logarithm(const Quaterniond& turn) { return 2 * turn.Log().Z(); }

int main() {
  for (const double angle : {0.1, 0.0021, 0.0019, 0.001}) {
    const Quaterniond turn(Vector3d::UnitZ, angle);
    std::printf("%g rad about z: Yaw() %.4f, ToAxis() %.4f, Log() %.4f\n", angle, turn.Yaw(), by_axis(turn),
                by_logarithm(turn));
  }
  // Ten seconds of a robot that turns, at 100 Hz: the steps between one heading and the next are added up.
  for (const double speed : {0.25, 0.15}) {
    double sums[2] = {0, 0};
    for (int i = 0; i < 1000; ++i) {
      const Quaterniond before(Vector3d::UnitZ, i * speed / 100), now(Vector3d::UnitZ, (i + 1) * speed / 100);
      const Quaterniond step = before.Inverse() * now;
      sums[0] += by_axis(step);
      sums[1] += by_logarithm(step);
    }
    std::printf("10 s at %g rad/s: turned by %.3f, ToAxis() %.3f, Log() %.3f\n", speed, speed * 10, sums[0], sums[1]);
  }
}
CPP
g++ -std=c++17 -I usr/include -I usr/include/ignition/math6 steps.cpp -o steps -L "$library" -l:libignition-math6.so.6
LD_LIBRARY_PATH=$library ./steps >seen
diff - seen <<'SEEN'
0.1 rad about z: Yaw() 0.1000, ToAxis() 0.1000, Log() 0.1000
0.0021 rad about z: Yaw() 0.0021, ToAxis() 0.0021, Log() 0.0021
0.0019 rad about z: Yaw() 0.0019, ToAxis() 0.0000, Log() 0.0019
0.001 rad about z: Yaw() 0.0010, ToAxis() 0.0000, Log() 0.0010
10 s at 0.25 rad/s: turned by 2.500, ToAxis() 2.500, Log() 2.500
10 s at 0.15 rad/s: turned by 1.500, ToAxis() 0.000, Log() 1.500
SEEN
echo "Ignition Math 6.10.0+ds3-7+b4: as described"
