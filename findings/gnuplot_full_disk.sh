#!/usr/bin/env bash
# gnuplot of Debian 12 (gnuplot-nox 5.4.4+dfsg1-2+b2): it ends with exit code 0 and without a message when the disk is full.
#
# It does not look at what comes of its writes: of images of every kind, of `set table` and of `print`. So a script that draws
# figures leaves cut ones, and succeeds. Other programs, such as `cat`, report it. Whoever draws with gnuplot has to look
# at the images: a whole SVG has "</svg>", a whole PNG ends with its chunk IEND.
#
# /dev/full takes no byte, as a full disk. Debian packages that must be installed: gnuplot-nox.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
version=$(dpkg-query -W -f='${Version}' gnuplot-nox)
[ "$version" = 5.4.4+dfsg1-2+b2 ] || { echo "gnuplot-nox is $version here" >&2; exit 1; }

seen() { # what COMMAND…: its exit code and its messages
  local code=0
  "${@:2}" >said 2>&1 || code=$?
  echo "$1: exit code $code, $(wc -c <said) bytes of messages"
}
draw() { echo "$1" | gnuplot; }
{
  for terminal in svg pngcairo postscript; do
    seen "$terminal" draw "set terminal $terminal; set output '/dev/full'; plot sin(x)"
  done
  seen "set table" draw "set table '/dev/full'; plot sin(x); unset table"
  seen "print" draw "set print '/dev/full'; print 1"
  seen "cat" bash -c 'echo 1 | cat >/dev/full' | sed 's/[0-9]* bytes of/with/'
} >all
diff - all <<'SEEN'
svg: exit code 0, 0 bytes of messages
pngcairo: exit code 0, 0 bytes of messages
postscript: exit code 0, 0 bytes of messages
set table: exit code 0, 0 bytes of messages
print: exit code 0, 0 bytes of messages
cat: exit code 1, with messages
SEEN
echo "gnuplot-nox 5.4.4+dfsg1-2+b2: as described"
