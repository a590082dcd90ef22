#!/usr/bin/env bash
# run.sh [--found | --build] [NAME]: the tests of plugins/ros2 against real servers, or those whose name
# contains NAME. --found: only whether there is a ROS 2. Without one, or with nothing built, it says so
# and ends with 77, which ctest counts as skipped.
set -euo pipefail
cd "$(dirname "$0")/../.."

installed=(/opt/ros/*/)
prefix=${ROS2_PREFIX:-${installed[-1]}}
prefix=${prefix%/}
if [ -z "$prefix" ] || [ ! -d "$prefix/share/rcl_action" ]; then
  echo "no ROS 2 in ROS2_PREFIX or /opt/ros: the tests of plugins/ros2 are skipped"
  exit 77
fi
[ "${1:-}" != --found ] || exit 0
export AMENT_PREFIX_PATH=$prefix CMAKE_PREFIX_PATH=$prefix LD_LIBRARY_PATH=$prefix/lib
# Where CMake's files of ROS find their own modules.
PYTHONPATH=$(printf '%s:' "$prefix"/lib/python3*/site-packages "$prefix"/local/lib/python3*/dist-packages)
export PYTHONPATH

if [ "${1:-}" = --build ]; then
  shift
  python=-DPython3_EXECUTABLE=/usr/bin/python3
  cmake -S plugins/ros2 -B build/ros2/plugin -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo $python \
    -Dlockstep_DIR="$PWD/build/release/cmake/lockstep" >/dev/null
  cmake --build build/ros2/plugin
  # An interface package is used from where it is installed.
  cmake -S tests/ros2/interfaces -B build/ros2/interfaces -G Ninja $python \
    -DCMAKE_INSTALL_PREFIX="$PWD/build/ros2/installed" >/dev/null
  cmake --build build/ros2/interfaces
  cmake --install build/ros2/interfaces >/dev/null
  cmake -S plugins/lockstep_ros -B build/ros2/lockstep_ros -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo $python \
    -Dlockstep_DIR="$PWD/build/release/cmake/lockstep" -DCMAKE_INSTALL_PREFIX="$PWD/build/ros2/installed" >/dev/null
  cmake --build build/ros2/lockstep_ros
  cmake --install build/ros2/lockstep_ros >/dev/null
  cmake -S tests/ros2 -B build/ros2/tests -G Ninja -DCMAKE_BUILD_TYPE=Release $python \
    -Dlockstep_ros2_test_interfaces_DIR="$PWD/build/ros2/installed/share/lockstep_ros2_test_interfaces/cmake" \
    -Dlockstep_DIR="$PWD/build/release/cmake/lockstep" -Dlockstep_ros_DIR="$PWD/build/ros2/installed/share/lockstep_ros/cmake" \
    >/dev/null
  cmake --build build/ros2/tests
elif [ ! -e build/ros2/plugin/ros2.so ] || [ ! -e build/ros2/tests/counting_server ]; then
  echo "the tests of plugins/ros2 are not built: ./dev test-ros2 builds and runs them"
  exit 77
fi
export AMENT_PREFIX_PATH=$PWD/build/ros2/installed:$AMENT_PREFIX_PATH
export LD_LIBRARY_PATH=$PWD/build/ros2/installed/lib:$LD_LIBRARY_PATH
# Others on the same network must neither see nor disturb them. Cyclone DDS finds its peers here
# without multicast, and there are more of them than it expects.
export ROS_DOMAIN_ID=${ROS_DOMAIN_ID:-77}
loopback='<NetworkInterface name="lo" multicast="false"/>'
export CYCLONEDDS_URI=${CYCLONEDDS_URI:-"<CycloneDDS><Domain>
  <General><Interfaces>$loopback</Interfaces><AllowMulticast>false</AllowMulticast></General>
  <Discovery><ParticipantIndex>auto</ParticipantIndex>
    <MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>
    <Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>"}
export PYTHONDONTWRITEBYTECODE=1
exec python3 -W error -m unittest discover -s tests/ros2 -p '*_test.py' ${1:+-k "$1"}
