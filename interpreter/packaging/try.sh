#!/usr/bin/env bash
# Installs the packages, uses them as a stranger would, and purges them: try.sh DIRECTORY. As root. It happens in a
# view of this machine in which /usr, /etc and /var are copied on write, and which is gone afterwards.
set -euo pipefail
packages=$(realpath "$1")
sources=$(realpath "$(dirname "$0")/../..")
if [ "${2:-}" != inside ]; then
  [ "$(id -u)" = 0 ] || { echo "try: it mounts, and installs packages: as root" >&2 && exit 1; }
  top=$(mktemp -d)
  trap 'rmdir "$top"' EXIT
  unshare --mount --pid --fork --mount-proc "$0" "$packages" inside "$top"
  exit
fi
top=$3
mount --make-rprivate /
mount -t tmpfs lockstep-try "$top"
for folder in usr etc var; do
  mkdir -p "$top/$folder/upper" "$top/$folder/work"
  mount -t overlay overlay -o "lowerdir=/$folder,upperdir=$top/$folder/upper,workdir=$top/$folder/work" "/$folder"
done
home=$top/home
mkdir "$home"
cd "$home"
export HOME=$home PATH=/usr/sbin:/usr/bin:/sbin:/bin
unset LOCKSTEP LOCKSTEP_PLUGIN_PATH PYTHONPATH LD_LIBRARY_PATH
all() { (cd / && find usr etc var -xdev \( -path var/lib/dpkg -o -path var/log -o -path var/cache \) -prune -o -print) | LC_ALL=C sort; }
step() { echo "try: $*" >&2; }

all >before
step "install"
dpkg --install "$packages"/*.deb >install.log 2>&1 || { cat install.log && exit 1; }
step "the demo, help and completion"
lockstep run /usr/share/lockstep/trees/door_pulling.xml --clock virtual --view none >/dev/null
lockstep run /usr/share/lockstep/trees/door_pulling.xml --clock virtual --view none --isolate >/dev/null
lockstep doctor --rate 1 >/dev/null
[ ! -e /usr/bin/man ] || man -P cat lockstep-run | grep -q -e --overrun
bash -c 'source /usr/share/bash-completion/completions/lockstep && complete -p lockstep' >/dev/null
[ ! -x /usr/bin/systemd-analyze ] || {
  cp /usr/share/doc/lockstep/examples/lockstep@.service lockstep@door.service
  systemd-analyze verify ./lockstep@door.service
  systemd-analyze security --offline=true --threshold=25 ./lockstep@door.service >/dev/null
}
step "a plugin in C++, one in Python, a program with the library"
lockstep new plugin sweep >/dev/null 2>&1
cmake -S sweep -B sweep/build >/dev/null
cmake --build sweep/build >/dev/null
lockstep run sweep/tree.xml --plugin-path sweep/build --clock virtual --view none >/dev/null
lockstep new plugin look --lang python >/dev/null 2>&1
lockstep run look/tree.xml --plugin-path look --clock virtual --view none >/dev/null
cp /usr/share/lockstep/examples/in_c.c .
# shellcheck disable=SC2046
cc in_c.c -o in_c $(pkg-config --cflags --libs lockstep-runtime)
./in_c >/dev/null 2>&1 || [ $? -le 2 ]
step "the tutorial and the recipes, from their first line to their last"
for page in tutorial recipes; do
  python3 "$sources/tests/help/tutorial_test.py" "$sources/docs/$page.md" /usr/bin "$home/$page"
done
step "the module of Python"
python3 -c 'import lockstep
tree = "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><AlwaysSuccess/></BehaviorTree></root>"
assert str(lockstep.Tree(text=tree).run())'
step "purge"
dpkg --purge python3-lockstep lockstep-doc lockstep-dev lockstep "$(cd "$packages" && ls liblockstep*.deb | cut -d_ -f1)" >purge.log 2>&1 ||
  { cat purge.log && exit 1; }
all >after
if ! diff before after >left; then
  echo "try: files are left, or gone:" >&2
  cat left >&2
  exit 1
fi
step "nothing is left"
