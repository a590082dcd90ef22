#!/usr/bin/env bash
# KDL 1.5.1, Debian 12: after the end of a spline profile, the position goes on along the polynomial, away from the goal.
#
# A velocity profile gives a position for a time. The trapezoidal and rectangular ones stay at the goal after their duration,
# and at the start before 0, with a velocity of 0. VelocityProfile_Spline does not. Half a second after the end of a cubic of
# 2 s, the robot is a fifth of the way back. After twice the duration, it is beyond the start, by four times the distance. A
# quintic is then at 32 times the distance. Vel() agrees, and Trajectory_Segment moves so too. No documentation of them says
# what happens after the end.
#
# A loop that asks for the position by a clock, until it is told to stop, holds the goal with one profile. With the other, it
# drives off. Around it: never ask for a time outside of 0 to Duration(), as `held` does.
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

cat >after.cpp <<'CPP'
#include <kdl/path_line.hpp>
#include <kdl/rotational_interpolation_sa.hpp>
#include <kdl/trajectory_segment.hpp>
#include <kdl/velocityprofile_rect.hpp>
#include <kdl/velocityprofile_spline.hpp>
#include <kdl/velocityprofile_trap.hpp>

#include <algorithm>
#include <cstdio>

double held(double time, const KDL::VelocityProfile& profile) { return std::clamp(time, 0.0, profile.Duration()); }

void show(const char* what, const KDL::VelocityProfile& profile) {
  std::printf("%s, %g s:", what, profile.Duration());
  for (const double time : {-1.0, 0.0, 1.0, 2.0, 2.1, 2.5, 4.0}) std::printf(" %.3f", profile.Pos(time));
  std::printf(" m, Vel(4) %g m/s, held: %g m\n", profile.Vel(4), profile.Pos(held(4, profile)));
}

int main() {
  KDL::VelocityProfile_Trap trapezoidal(1, 2);
  KDL::VelocityProfile_Rectangular rectangular(1);
  KDL::VelocityProfile_Spline linear, cubic, quintic;
  trapezoidal.SetProfileDuration(0, 1, 2);
  rectangular.SetProfileDuration(0, 1, 2);
  linear.SetProfileDuration(0, 1, 2);
  cubic.SetProfileDuration(0, 0, 1, 0, 2);
  quintic.SetProfileDuration(0, 0, 0, 1, 0, 0, 2);
  std::printf("from 0 m to 1 m, at -1, 0, 1, 2, 2.1, 2.5 and 4 s\n");
  show("trapezoidal", trapezoidal);
  show("rectangular", rectangular);
  show("spline, linear", linear);
  show("spline, cubic", cubic);
  show("spline, quintic", quintic);

  const KDL::Frame start, goal(KDL::Vector(1, 0, 0));
  const KDL::Trajectory_Segment trajectory(
      new KDL::Path_Line(start, goal, new KDL::RotationalInterpolation_SingleAxis(), 1), cubic.Clone());
  std::printf("Trajectory_Segment with the cubic at 4 s: %.3f m\n", trajectory.Pos(4).p.x());
}
CPP
g++ -std=c++17 -O1 -I usr/include -I usr/include/eigen3 after.cpp -o after -L "$library" -l:liborocos-kdl.so.1.5
LD_LIBRARY_PATH=$library ./after >seen
diff - seen <<'SEEN'
from 0 m to 1 m, at -1, 0, 1, 2, 2.1, 2.5 and 4 s
trapezoidal, 2 s: 0.000 0.000 0.500 1.000 1.000 1.000 1.000 m, Vel(4) 0 m/s, held: 1 m
rectangular, 2 s: 0.000 0.000 0.500 1.000 1.000 1.000 1.000 m, Vel(4) 0 m/s, held: 1 m
spline, linear, 2 s: -0.500 0.000 0.500 1.000 1.050 1.250 2.000 m, Vel(4) 0.5 m/s, held: 1 m
spline, cubic, 2 s: 1.000 0.000 0.500 1.000 0.992 0.781 -4.000 m, Vel(4) -6 m/s, held: 1 m
spline, quintic, 2 s: -2.375 0.000 0.500 1.000 1.001 1.221 32.000 m, Vel(4) 60 m/s, held: 1 m
Trajectory_Segment with the cubic at 4 s: -4.000 m
SEEN
echo "KDL 1.5.1-2+b4: as described"
