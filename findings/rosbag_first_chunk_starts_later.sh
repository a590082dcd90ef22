#!/usr/bin/env bash
# @foxglove/rosbag 0.4.1: messageIterator() skips the messages that are earlier than the first chunk of the file.
#
# The chunks of a bag may overlap in time. rosbag writes them so when it is given one topic after the other, as by a converter
# of data sets. `startTime` is documented as the time of the earliest message, and messageIterator() without `start` as without
# a filter. In truth, `startTime` is that of the first chunk in the file, and the iterator begins there. With `reverse`, it
# begins at the end of the last chunk, and skips what is later. No error tells of the lost messages, here 5 of 16.
#
# rosbag 1.15.15, Debian 12, reads all of them, but its get_start_time() is that of the first chunk too. With `start: {sec: 0,
# nsec: 0}`, and for reverse a late `start`, no message is skipped.
#
# Debian packages: python3 (3.11), nodejs, npm and, without installing them, those named below. From npm: @foxglove/rosbag
# 0.4.1 with tslib 2.8.1, which it needs but does not name.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq python3-rosbag=1.15.15+ds-2 python3-rospy=1.15.15+ds-2 python3-rosgraph=1.15.15+ds-2 \
  python3-genmsg=0.6.0-1 python3-genpy=0.6.16-2 python3-roslib=1.15.8-3 python3-rospkg=1.4.0-2 python3-catkin=0.8.10-9 \
  python3-std-msgs=0.5.13-2 python3-rosgraph-msgs=1.11.3-2 python3-roscpp-msg=1.15.15+ds-2 python3-yaml=6.0-3+b2 \
  python3-catkin-pkg=0.5.2-5 python3-pycryptodome=3.11.0+dfsg1-4 python3-gnupg=0.4.9-1 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund @foxglove/rosbag@0.4.1 tslib@2.8.1

cat >write.py <<'PY'
import rosbag, rospy
from std_msgs.msg import UInt8

def write(path, topics):
    with rosbag.Bag(path, "w", chunk_threshold=100) as bag:
        for topic, times in topics:
            for time in times:
                bag.write(topic, UInt8(time), rospy.Time(time))
    with rosbag.Bag(path) as bag:
        times = [time.secs for _, _, time in bag.read_messages()]
        reach = f"from {bag.get_start_time():.0f} to {bag.get_end_time():.0f}"
        print(f"{path}, rosbag: {reach}, {len(times)} messages: {min(times)} to {max(times)}")

camera = ("/camera", range(10, 13))
lidar = ("/lidar", range(5, 18))
write("camera first.bag", [camera, lidar])
write("lidar first.bag", [lidar, camera])
PY
cat >read.cjs <<'JS'
const { Bag } = require("@foxglove/rosbag");
const { FileReader } = require("@foxglove/rosbag/node");

async function read(path, options) {
  const file = new FileReader(path);
  const bag = new Bag(file);
  await bag.open();
  const times = [];
  for await (const { timestamp } of bag.messageIterator(options)) times.push(timestamp.sec);
  await file.close();
  const range = `from ${bag.startTime.sec} to ${bag.endTime.sec}`;
  const found = `${times.length} messages: ${Math.min(...times)} to ${Math.max(...times)}`;
  console.log(`${path}, @foxglove/rosbag ${JSON.stringify(options)}: ${range}, ${found}`);
}
(async () => {
  for (const path of ["camera first.bag", "lidar first.bag"]) {
    await read(path, {});
    await read(path, { reverse: true });
  }
  await read("camera first.bag", { start: { sec: 0, nsec: 0 } });
  await read("lidar first.bag", { reverse: true, start: { sec: 100, nsec: 0 } });
})();
JS
{
  PYTHONPATH=usr/lib/python3/dist-packages /usr/bin/python3 write.py 2>errors || cat errors >&2
  node read.cjs
} >seen
diff - seen <<'SEEN'
camera first.bag, rosbag: from 10 to 17, 16 messages: 5 to 17
lidar first.bag, rosbag: from 5 to 12, 16 messages: 5 to 17
camera first.bag, @foxglove/rosbag {}: from 10 to 17, 11 messages: 10 to 17
camera first.bag, @foxglove/rosbag {"reverse":true}: from 10 to 17, 16 messages: 5 to 17
lidar first.bag, @foxglove/rosbag {}: from 5 to 12, 16 messages: 5 to 17
lidar first.bag, @foxglove/rosbag {"reverse":true}: from 5 to 12, 11 messages: 5 to 12
camera first.bag, @foxglove/rosbag {"start":{"sec":0,"nsec":0}}: from 10 to 17, 16 messages: 5 to 17
lidar first.bag, @foxglove/rosbag {"reverse":true,"start":{"sec":100,"nsec":0}}: from 5 to 12, 16 messages: 5 to 17
SEEN
echo "@foxglove/rosbag 0.4.1: as described"
