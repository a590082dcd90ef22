#!/usr/bin/env bash
# KDL 1.5.1, Debian 12: a half trapezoidal profile that is made longer can exceed its greatest acceleration, without a bound.
#
# VelocityProfile_TrapHalf accelerates from rest, by at most the acceleration that it was given. Over a short distance,
# SetProfile() plans to end below the greatest velocity, as its documentation says. SetProfileDuration(), to take more time for
# the same distance, is documented to lower the acceleration, or to wait first. But it always plans to end at the greatest
# velocity: over 1 mm, with 1 m/s and 2 m/s2, it waits, and then accelerates with 500 m/s2. A braking profile does the same the
# other way round. And after SetProfile() with a distance of 0, Duration() is NaN.
#
# Around it: before SetProfileDuration(), lower the greatest velocity to what can be reached, sqrt(2 * acceleration *
# distance), by SetMax(). And leave out a move of no distance.
#
# Debian packages: g++ and, without installing them, liborocos-kdl-dev, liborocos-kdl1.5 and libeigen3-dev.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq liborocos-kdl-dev=1.5.1-2+b4 liborocos-kdl1.5=1.5.1-2+b4 libeigen3-dev=3.4.0-4 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
library=$(dirname "$(find . -name 'liborocos-kdl.so.1.5')")

cat >half.cpp <<'CPP'
#include <kdl/velocityprofile_traphalf.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

// What the positions of a profile need, by their differences: it does not rely on Vel() and Acc().
void show(const char* what, const KDL::VelocityProfile& profile) {
  const double duration = profile.Duration(), step = duration / 10000;
  double velocity = 0, acceleration = 0;
  for (int i = 1; i < 10000; ++i) {
    const double before = profile.Pos((i - 1) * step), here = profile.Pos(i * step), behind = profile.Pos((i + 1) * step);
    velocity = std::max(velocity, std::fabs(behind - here) / step);
    acceleration = std::max(acceleration, std::fabs(behind - 2 * here + before) / (step * step));
  }
  std::printf("  %s: %.3f m in %.3f s, up to %.2f m/s and %.1f m/s2\n", what, profile.Pos(duration) - profile.Pos(0), duration,
              velocity, acceleration);
}

int main() {
  const double greatest_velocity = 1, greatest_acceleration = 2;
  for (const bool starts : {true, false}) {
    for (const double distance : {1.0, 0.1, 0.01, 0.001}) {
      std::printf("%s, %g m:\n", starts ? "starting" : "ending", distance);
      KDL::VelocityProfile_TrapHalf profile(greatest_velocity, greatest_acceleration, starts);
      profile.SetProfile(0, distance);
      show("SetProfile()", profile);
      const double longer = 2 * profile.Duration();
      profile.SetProfileDuration(0, distance, longer);
      show("SetProfileDuration()", profile);
      const double reached = std::sqrt(2 * greatest_acceleration * distance);
      profile.SetMax(std::min(greatest_velocity, reached), greatest_acceleration, starts);
      profile.SetProfileDuration(0, distance, longer);
      show("with a lower velocity", profile);
    }
  }
  KDL::VelocityProfile_TrapHalf none(greatest_velocity, greatest_acceleration, true);
  none.SetProfile(1, 1);
  std::printf("no distance: %s\n", std::isnan(none.Duration()) ? "NaN s" : "a duration");
}
CPP
g++ -std=c++17 -O1 -I usr/include -I usr/include/eigen3 half.cpp -o half -L "$library" -l:liborocos-kdl.so.1.5
LD_LIBRARY_PATH=$library ./half >seen
diff - seen <<'SEEN'
starting, 1 m:
  SetProfile(): 1.000 m in 1.250 s, up to 1.00 m/s and 2.0 m/s2
  SetProfileDuration(): 1.000 m in 2.500 s, up to 1.00 m/s and 0.5 m/s2
  with a lower velocity: 1.000 m in 2.500 s, up to 1.00 m/s and 0.5 m/s2
starting, 0.1 m:
  SetProfile(): 0.100 m in 0.316 s, up to 0.63 m/s and 2.0 m/s2
  SetProfileDuration(): 0.100 m in 0.632 s, up to 1.00 m/s and 5.0 m/s2
  with a lower velocity: 0.100 m in 0.632 s, up to 0.63 m/s and 2.0 m/s2
starting, 0.01 m:
  SetProfile(): 0.010 m in 0.100 s, up to 0.20 m/s and 2.0 m/s2
  SetProfileDuration(): 0.010 m in 0.200 s, up to 1.00 m/s and 50.0 m/s2
  with a lower velocity: 0.010 m in 0.200 s, up to 0.20 m/s and 2.0 m/s2
starting, 0.001 m:
  SetProfile(): 0.001 m in 0.032 s, up to 0.06 m/s and 2.0 m/s2
  SetProfileDuration(): 0.001 m in 0.063 s, up to 1.00 m/s and 500.0 m/s2
  with a lower velocity: 0.001 m in 0.063 s, up to 0.06 m/s and 2.0 m/s2
ending, 1 m:
  SetProfile(): 1.000 m in 1.250 s, up to 1.00 m/s and 2.0 m/s2
  SetProfileDuration(): 1.000 m in 2.500 s, up to 1.00 m/s and 0.5 m/s2
  with a lower velocity: 1.000 m in 2.500 s, up to 1.00 m/s and 0.5 m/s2
ending, 0.1 m:
  SetProfile(): 0.100 m in 0.316 s, up to 0.63 m/s and 2.0 m/s2
  SetProfileDuration(): 0.100 m in 0.632 s, up to 1.00 m/s and 5.0 m/s2
  with a lower velocity: 0.100 m in 0.632 s, up to 0.63 m/s and 2.0 m/s2
ending, 0.01 m:
  SetProfile(): 0.010 m in 0.100 s, up to 0.20 m/s and 2.0 m/s2
  SetProfileDuration(): 0.010 m in 0.200 s, up to 1.00 m/s and 50.0 m/s2
  with a lower velocity: 0.010 m in 0.200 s, up to 0.20 m/s and 2.0 m/s2
ending, 0.001 m:
  SetProfile(): 0.001 m in 0.032 s, up to 0.06 m/s and 2.0 m/s2
  SetProfileDuration(): 0.001 m in 0.063 s, up to 1.00 m/s and 500.0 m/s2
  with a lower velocity: 0.001 m in 0.063 s, up to 0.06 m/s and 2.0 m/s2
no distance: NaN s
SEEN
echo "KDL 1.5.1-2+b4: as described"
