#!/usr/bin/env bash
# urdfdom_headers 1.0.5, Debian 12: a rotation whose pitch is within 0.256 degrees of vertical is given back as vertical.
#
# urdf::Rotation holds a quaternion. getRPY() takes one whose sine of the pitch is above 0.99999 for gimbal lock: it returns a
# pitch of exactly 90 degrees, and a roll of 0. So a camera at a pitch of 89.75 degrees is turned by a quarter of a degree when
# its angles are read or written. At 10 m, that is 4 cm. The roll is added to yaw or taken from it, which then can be beyond
# 180 degrees. The quaternion itself has all of it.
#
# exportURDF() of urdfdom 3.0.1 writes these angles, so a URDF that is loaded and saved changes. Around it: take
# getQuaternion(), and compute the angles from the quaternion, as `angles` below does.
#
# Debian packages: g++ and, without installing it, liburdfdom-headers-dev.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq liburdfdom-headers-dev=1.0.5-3 2>/dev/null
dpkg -x liburdfdom-headers-dev_*.deb .

cat >pitch.cpp <<'CPP'
#include <urdf_model/pose.h>

#include <cmath>
#include <cstdio>

constexpr double degree = 1.57079632679489661923 / 90;

// The same angles without a limit: the pitch by atan2(), which is exact near 90 degrees, unlike asin().
void angles(const urdf::Rotation& turn, double& roll, double& pitch, double& yaw) {
  double x, y, z, w;
  turn.getQuaternion(x, y, z, w);
  const double forward = 1 - 2 * (y * y + z * z), left = 2 * (x * y + w * z), down = 2 * (w * y - x * z);
  roll = std::atan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y));
  pitch = std::atan2(down, std::hypot(forward, left));
  yaw = std::atan2(left, forward);
}

double between(const urdf::Rotation& a, const urdf::Rotation& b) {
  const urdf::Rotation turn = a.GetInverse() * b;
  return 2 * std::atan2(std::hypot(turn.x, turn.y, turn.z), std::fabs(turn.w)) / degree;
}

int main() {
  for (const double pitch : {45.0, 89.7, 89.75, 89.9, -89.75}) {
    urdf::Rotation turn, again;
    turn.setFromRPY(30 * degree, pitch * degree, 170 * degree);
    double read[2][3];
    turn.getRPY(read[0][0], read[0][1], read[0][2]);
    angles(turn, read[1][0], read[1][1], read[1][2]);
    std::printf("30 %g 170\n", pitch);
    for (int i = 0; i < 2; ++i) {
      again.setFromRPY(read[i][0], read[i][1], read[i][2]);
      std::printf("  %s: %.2f %.2f %.2f, turned by %.3f\n", i == 0 ? "getRPY()" : "angles()", read[i][0] / degree,
                  read[i][1] / degree, read[i][2] / degree, between(turn, again));
    }
  }
}
CPP
g++ -std=c++17 -I usr/include -I usr/include/urdfdom_headers pitch.cpp -o pitch
./pitch >seen
diff - seen <<'SEEN'
30 45 170
  getRPY(): 30.00 45.00 170.00, turned by 0.000
  angles(): 30.00 45.00 170.00, turned by 0.000
30 89.7 170
  getRPY(): 30.00 89.70 170.00, turned by 0.000
  angles(): 30.00 89.70 170.00, turned by 0.000
30 89.75 170
  getRPY(): 0.00 90.00 139.87, turned by 0.280
  angles(): 30.00 89.75 170.00, turned by 0.000
30 89.9 170
  getRPY(): 0.00 90.00 139.95, turned by 0.112
  angles(): 30.00 89.90 170.00, turned by 0.000
30 -89.75 170
  getRPY(): 0.00 -90.00 200.13, turned by 0.280
  angles(): 30.00 -89.75 170.00, turned by 0.000
SEEN
echo "urdfdom_headers 1.0.5-3: as described"
