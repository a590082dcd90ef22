#!/usr/bin/env bash
# ./dev package [--try] [--arch arm64]: builds with Debian's flags, makes the packages and the archive of the sources.
# For another processor, with Debian's cross compiler and packages of that processor in build/sysroot-ARCH.
set -euo pipefail
cd "$(dirname "$0")/../.."
here=interpreter/packaging
architecture="" trial=""
while [ $# -gt 0 ]; do
  case $1 in
    --try) trial=yes ;;
    --arch)
      [ $# -gt 1 ] || { echo "package: --arch needs an architecture of Debian, such as arm64" >&2 && exit 2; }
      architecture=$2 && shift
      ;;
    *) echo "package: expected [--try] [--arch ARCHITECTURE], got '$1'" >&2 && exit 2 ;;
  esac
  shift
done
[ "$architecture" != "$(dpkg --print-architecture)" ] || architecture=""
[ -z "$architecture" ] || [ -z "$trial" ] || { echo "package: packages of another processor cannot be tried here" >&2 && exit 2; }

has_git=""
if [ -e .git ] && command -v git >/dev/null; then has_git=yes; fi
if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  # Of the last commit; in an archive without git, of the change log. A repository around that is another project's.
  if [ -n "$has_git" ]; then SOURCE_DATE_EPOCH=$(git log -1 --format=%ct); else SOURCE_DATE_EPOCH=$(stat -c %Y CHANGELOG.md); fi
fi
export SOURCE_DATE_EPOCH
build=build/package options=()
if [ -n "$architecture" ]; then
  build=build/package-$architecture
  triplet=$(dpkg-architecture -a"$architecture" -qDEB_HOST_MULTIARCH 2>/dev/null)
  LOCKSTEP_SYSROOT=$PWD/build/sysroot-$architecture
  export DEB_HOST_ARCH=$architecture LOCKSTEP_SYSROOT STRIP=$triplet-strip
  # shellcheck disable=SC2086
  $here/sysroot.sh "$architecture" "$LOCKSTEP_SYSROOT" libc6-dev libstdc++-12-dev $PACKAGE_LIBRARIES
  # CMake knows Debian's folder for libraries only when it compiles for this machine.
  options=("-DCMAKE_INSTALL_LIBDIR=lib/$triplet" "-DCMAKE_TOOLCHAIN_FILE=$here/cross.cmake" "-DLOCKSTEP_TRIPLET=$triplet" "-DLOCKSTEP_SYSROOT=$LOCKSTEP_SYSROOT")
fi
export DEB_BUILD_MAINT_OPTIONS=hardening=+all DEB_CFLAGS_MAINT_STRIP=-g DEB_CXXFLAGS_MAINT_STRIP=-g
for flags in CFLAGS CXXFLAGS LDFLAGS; do
  export $flags="$(dpkg-buildflags --get $flags)"
done
CFLAGS+=" $(dpkg-buildflags --get CPPFLAGS)"
CXXFLAGS+=" $(dpkg-buildflags --get CPPFLAGS)"
# The flags are given each time: a build tree would keep those of its first time.
options+=("-DCMAKE_C_FLAGS=$CFLAGS" "-DCMAKE_CXX_FLAGS=$CXXFLAGS")
for kind in EXE SHARED MODULE; do options+=("-DCMAKE_${kind}_LINKER_FLAGS=$LDFLAGS"); done
cmake --preset package -B "$build" "${options[@]}" >/dev/null
cmake --build "$build" -j "$(nproc)"
$here/build.sh "$build"

out=$build/packages
name=lockstep-$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
if [ -n "$has_git" ]; then
  [ -z "$(git status --porcelain)" ] ||
    echo "package: warning: $name.tar.gz has the last commit, and the packages also what is not committed" >&2
  git -c tar.umask=0022 archive --format=tar --prefix="$name/" HEAD | gzip -9n >"$out/$name.tar.gz"
else
  tar --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --mtime="@$SOURCE_DATE_EPOCH" --exclude=./build \
    --exclude=./.git --exclude=node_modules --exclude=__pycache__ --transform "s,^\.,$name," -cf - . | gzip -9n >"$out/$name.tar.gz"
fi
(cd "$out" && sha256sum ./*.deb ./*.tar.gz | sed 's, \./, ,' >SHA256SUMS)
lintian --allow-root --fail-on error,warning "$out"/*.deb
[ -z "$trial" ] || $here/try.sh "$out"
