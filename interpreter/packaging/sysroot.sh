#!/usr/bin/env bash
# sysroot.sh ARCHITECTURE DIRECTORY PACKAGE…: Debian packages of another architecture, with what they need, unpacked in
# DIRECTORY, and a database of dpkg for them. It changes nothing of this machine.
set -euo pipefail
architecture=$1
mkdir -p "$2"
root=$(realpath "$2")
shift 2
[ ! -e "$root/.done" ] || [ "$(cat "$root/.done")" != "$*" ] || exit 0
mkdir -p "$root"/var/lib/dpkg/{info,updates} "$root"/apt/{lists,cache/archives}/partial
echo 1 >"$root/var/lib/dpkg/info/format"
touch "$root/var/lib/dpkg/status" "$root/var/lib/dpkg/available"
apt=(-qq -o "APT::Architecture=$architecture" -o "APT::Architectures=$architecture" -o "Dir::State::Lists=$root/apt/lists"
  -o "Dir::Cache=$root/apt/cache" -o "Dir::State::status=$root/var/lib/dpkg/status" -o APT::Sandbox::User=root
  -o APT::Install-Recommends=false)
apt-get "${apt[@]}" update
apt-get "${apt[@]}" --download-only --yes install "$@" >/dev/null
for package in "$root"/apt/cache/archives/*.deb; do
  dpkg-deb --extract "$package" "$root"
  name=$(dpkg-deb --field "$package" Package)
  # What dpkg-shlibdeps asks: the files of a package, its symbols and its shared libraries.
  info=$root/var/lib/dpkg/info/$name
  [ "$(dpkg-deb --field "$package" Multi-Arch)" != same ] || info+=:$architecture
  control=$(mktemp -d)
  dpkg-deb --control "$package" "$control"
  for kind in symbols shlibs md5sums; do [ ! -e "$control/$kind" ] || cp "$control/$kind" "$info.$kind"; done
  rm -rf "$control"
  dpkg-deb --fsys-tarfile "$package" | tar -t | sed 's,^\.,,; s,/$,,; s,^$,/.,' >"$info.list"
  { dpkg-deb --field "$package" && echo "Status: install ok installed" && echo; } >>"$root/var/lib/dpkg/status"
done
# Links of packages lead from the root of their machine.
find "$root/usr/lib" "$root/lib" -type l -lname '/*' 2>/dev/null | while read -r link; do
  ln -sfn "$root$(readlink "$link")" "$link"
done
echo "$*" >"$root/.done"
