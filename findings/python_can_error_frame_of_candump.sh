#!/usr/bin/env bash
# python-can 4.1.0, Debian 12: in a log of candump, it takes most error frames for data frames, and replays them as such.
#
# candump of can-utils logs error frames if it is told to: `candump -l can0,0:0,#FFFFFFFF`. Their identifier has the bit
# 20000000 and bits for the kinds of error. CanutilsLogReader, documented to read such logs, takes only a frame with the bit 80,
# a bus error, for an error frame. All others, such as bus off or no acknowledgment, become data frames with an extended
# identifier. can.player sends them on the bus, although it is documented to send error frames only with --error-frames.
# can.logconvert makes data frames of them in every other format. log2asc of can-utils reads the same log rightly.
#
# Around it: take out the lines of error frames before python-can reads the log, as below.
#
# Debian packages: python3 (3.11) and, without installing them, those named below.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq python3-can=4.1.0-1 python3-wrapt=1.14.1-2+b2 python3-typing-extensions=4.4.0-1 python3-packaging=23.0-1 \
  python3-msgpack=1.0.3-2+b1 can-utils=2020.11.0-1 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
export PYTHONPATH=usr/lib/python3/dist-packages

cat >bus.log <<'LOG'
(1700000000.000000) can0 123#0102
(1700000000.010000) can0 20000004#0004000000000000
(1700000000.020000) can0 20000020#0000000000000000
(1700000000.030000) can0 20000040#0000000000000000
(1700000000.040000) can0 20000080#0000000000000000
(1700000000.050000) can0 20000100#0000000000000000
(1700000000.060000) can0 00000040#0304
LOG
grep -v ' [23][0-9A-F]\{7\}#' bus.log >"without errors.log"

cat >replay.py <<'PY'
import contextlib, io, sys
import can
import can.player

def shown(message):
    kind = "error" if message.is_error_frame else "data"
    form = "extended" if message.is_extended_id else "standard"
    return kind if message.is_error_frame else f"{kind} {message.arbitration_id:x} {form} {message.data.hex()}"

for path in sys.argv[1:]:
    for message in can.LogReader(path):
        print(f"{path}, CanutilsLogReader: {shown(message)}")
    with can.Bus("robot", bustype="virtual") as robot:
        sys.argv = ["player", "-i", "virtual", "-c", "robot", path]
        with contextlib.redirect_stdout(io.StringIO()):
            can.player.main()
        while message := robot.recv(0):
            print(f"{path}, sent by can.player: {shown(message)}")
PY
{
  usr/bin/log2asc -I bus.log can0 | sed -n 's/^ *[0-9.]* 1 */bus.log, log2asc: /p' | tr -s ' '
  /usr/bin/python3 replay.py bus.log "without errors.log"
  /usr/bin/python3 -m can.logconvert bus.log again.log
  echo "again.log, by can.logconvert: frames $(grep -c '#' again.log), errors $(grep -c ' [23][0-9A-F]\{7\}#' again.log)"
} >seen
diff - seen <<'SEEN'
bus.log, log2asc: 123 Rx d 2 01 02
bus.log, log2asc: ErrorFrame
bus.log, log2asc: ErrorFrame
bus.log, log2asc: ErrorFrame
bus.log, log2asc: ErrorFrame
bus.log, log2asc: ErrorFrame
bus.log, log2asc: 40x Rx d 2 03 04
bus.log, CanutilsLogReader: data 123 standard 0102
bus.log, CanutilsLogReader: data 4 extended 0004000000000000
bus.log, CanutilsLogReader: data 20 extended 0000000000000000
bus.log, CanutilsLogReader: data 40 extended 0000000000000000
bus.log, CanutilsLogReader: error
bus.log, CanutilsLogReader: data 100 extended 0000000000000000
bus.log, CanutilsLogReader: data 40 extended 0304
bus.log, sent by can.player: data 123 standard 0102
bus.log, sent by can.player: data 4 extended 0004000000000000
bus.log, sent by can.player: data 20 extended 0000000000000000
bus.log, sent by can.player: data 40 extended 0000000000000000
bus.log, sent by can.player: data 100 extended 0000000000000000
bus.log, sent by can.player: data 40 extended 0304
without errors.log, CanutilsLogReader: data 123 standard 0102
without errors.log, CanutilsLogReader: data 40 extended 0304
without errors.log, sent by can.player: data 123 standard 0102
without errors.log, sent by can.player: data 40 extended 0304
again.log, by can.logconvert: frames 7, errors 1
SEEN
echo "python-can 4.1.0-1: as described"
