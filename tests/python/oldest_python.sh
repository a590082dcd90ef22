#!/usr/bin/env bash
# oldest_python.sh BUILD: the tests of the Python module and of a plugin in Python, with Python 3.9 of Debian 11, the oldest
# that SUPPORT.md names. It is unpacked in build/python-3.9, and seen as /usr/bin/python3 by the tests alone.
set -euo pipefail
build=$(realpath "$1")
cd "$(dirname "$0")/../.."
root=$PWD/build/python-3.9
if [ ! -e "$root/.done" ]; then
  mkdir -p "$root"/apt/{lists,cache/archives}/partial
  touch "$root/apt/status"
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bullseye main" >"$root/apt/sources.list"
  apt=(-qq -o "Dir::Etc::sourcelist=$root/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null -o "Dir::State::Lists=$root/apt/lists"
    -o "Dir::Cache=$root/apt/cache" -o "Dir::State::status=$root/apt/status" -o APT::Sandbox::User=root
    -o APT::Install-Recommends=false)
  apt-get "${apt[@]}" update
  apt-get "${apt[@]}" --download-only --yes install python3.9 libffi7 >/dev/null
  for package in "$root"/apt/cache/archives/{python3.9,libpython3.9,libffi7,libssl1.1,libmpdec3}[-_]*.deb; do
    dpkg-deb --extract "$package" "$root"
  done
  touch "$root/.done"
fi
export PYTHONPATH=$PWD/plugins/sdk/python PYTHONDONTWRITEBYTECODE=1 LOCKSTEP=$build/lockstep
as_root=()
[ "$(id -u)" = 0 ] || as_root=(--map-root-user)
# shellcheck disable=SC2016 # the inner shell expands them
unshare --mount "${as_root[@]}" bash -ec '
  mount --make-rprivate /
  mount -t overlay overlay -o "lowerdir=$1/usr:/usr" /usr
  mount --bind /usr/bin/python3.9 "$(realpath /usr/bin/python3)"
  /usr/bin/python3 --version
  for plugin in advance_class shapes_class; do "$LOCKSTEP" plugin check "tests/programs/$plugin.py" | tail -n 1; done
  exec timeout 300 /usr/bin/python3 tests/python/trees_test.py' oldest "$root"
