#!/usr/bin/env bash
# fmt of Debian 12 (9.1.0+ds1-2): a duration of 59.9999 seconds in a floating-point number is printed as 00:00:60.
#
# Of integers, as milliseconds, %S and %T print the fraction: 00:00:59.999. Of floating-point numbers this release drops it, and
# rounds the seconds of the minute, without a carry: a minute has a second 60, an hour ends with 59:60, and 1.5 s is 00:00:02,
# although the minutes and hours are not rounded. std::chrono::duration_cast to milliseconds before printing avoids it.
#
# Debian packages: g++ and, without installing it, libfmt-dev.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq libfmt-dev=9.1.0+ds1-2 2>/dev/null
dpkg -x libfmt-dev_*.deb .

cat >times.cpp <<'CPP'
#define FMT_HEADER_ONLY
#include <fmt/chrono.h>

int main() {
  using namespace std::chrono;
  for (double seconds : {0.4, 1.5, 59.4, 59.9999, 60.0001, 3599.9999}) {
    const duration<double> time(seconds);
    fmt::print("{} s: double {:%T}, milliseconds {:%T}\n", seconds, time, duration_cast<milliseconds>(time));
  }
}
CPP
g++ -std=c++17 -I usr/include times.cpp -o times
./times >seen
diff - seen <<'SEEN'
0.4 s: double 00:00:00, milliseconds 00:00:00.400
1.5 s: double 00:00:02, milliseconds 00:00:01.500
59.4 s: double 00:00:59, milliseconds 00:00:59.400
59.9999 s: double 00:00:60, milliseconds 00:00:59.999
60.0001 s: double 00:01:00, milliseconds 00:01:00.000
3599.9999 s: double 00:59:60, milliseconds 00:59:59.999
SEEN
echo "fmt 9.1.0+ds1-2: as described"
