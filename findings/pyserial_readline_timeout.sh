#!/usr/bin/env bash
# pyserial 3.5, Debian 12: the timeout of readline() starts anew with every byte, so it does not limit how long a line may take.
#
# The documentation says to set a timeout, since readline() could block forever without one. It blocks as long as bytes come
# without a newline, each within the timeout: readline() is that of Python's io, which reads byte by byte. Here a line takes
# 1.5 s with a timeout of 0.3 s. A device that sends at another baud rate, or binary data, stops a control loop for as long.
# readlines() waits likewise. read() and read_until() keep to the timeout, and leave what comes later for the next call.
#
# Around it: read_until() in place of readline(). Either may return a part of a line, which has no newline at its end.
#
# Debian packages: python3 (3.11) and, without installing it, python3-serial. It uses a pseudo terminal as the serial port.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq python3-serial=3.5-1.1 2>/dev/null
dpkg -x python3-serial_*.deb .

cat >line.py <<'PY'
import os, pty, threading, time, tty
import serial

def device(end):
    for byte in b"123456789\n":
        time.sleep(0.15)
        os.write(end, bytes([byte]))

def read(name, timeout, *arguments):
    end, port_end = pty.openpty()
    tty.setraw(port_end)
    with serial.Serial(os.ttyname(port_end), timeout=timeout) as port:
        sender = threading.Thread(target=device, args=(end,))
        sender.start()
        began = time.monotonic()
        found = getattr(port, name)(*arguments)
        took = time.monotonic() - began
        sender.join()
        rest = port.read(port.in_waiting)
    held = "within 0.8 s" if took < 0.8 else "later than 1.2 s" if took > 1.2 else "between"
    whole = "a whole line" if found.endswith(b"\n") else "a part"
    print(f"{name}(), timeout {timeout} s: {whole}, {held}, nothing lost: {found + rest == b'123456789' + bytes([10])}")

read("readline", 0.3)
read("read_until", 0.3)
read("read", 0.3, 10)
read("readline", 3)
read("read_until", 3)
PY
PYTHONPATH=usr/lib/python3/dist-packages /usr/bin/python3 line.py >seen
diff - seen <<'SEEN'
readline(), timeout 0.3 s: a whole line, later than 1.2 s, nothing lost: True
read_until(), timeout 0.3 s: a part, within 0.8 s, nothing lost: True
read(), timeout 0.3 s: a part, within 0.8 s, nothing lost: True
readline(), timeout 3 s: a whole line, later than 1.2 s, nothing lost: True
read_until(), timeout 3 s: a whole line, later than 1.2 s, nothing lost: True
SEEN
echo "pyserial 3.5-1.1: as described"
