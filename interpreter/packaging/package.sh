#!/usr/bin/env bash
# ./dev package: builds with Debian's flags, makes the packages and the archive of the sources.
set -euo pipefail
cd "$(dirname "$0")/../.."
if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  # Of the last commit; in an archive without git, of the change log.
  SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)
fi
export SOURCE_DATE_EPOCH
export DEB_BUILD_MAINT_OPTIONS=hardening=+all DEB_CFLAGS_MAINT_STRIP=-g DEB_CXXFLAGS_MAINT_STRIP=-g
for flags in CFLAGS CXXFLAGS LDFLAGS; do
  export $flags="$(dpkg-buildflags --get $flags)"
done
CFLAGS+=" $(dpkg-buildflags --get CPPFLAGS)"
CXXFLAGS+=" $(dpkg-buildflags --get CPPFLAGS)"
cmake --preset package >/dev/null
cmake --build build/package -j "$(nproc)"
interpreter/packaging/build.sh build/package

out=build/package/packages
name=lockstep-$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' build/package/CMakeCache.txt)
if git rev-parse HEAD >/dev/null 2>&1; then
  git archive --format=tar --prefix="$name/" HEAD | gzip -9n >"$out/$name.tar.gz"
else
  tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" --exclude=./build \
    --transform "s,^\.,$name," -cf - . | gzip -9n >"$out/$name.tar.gz"
fi
(cd "$out" && sha256sum ./*.deb ./*.tar.gz | sed 's, \./, ,' >SHA256SUMS)
lintian --allow-root --fail-on error,warning "$out"/*.deb
[ "${1:-}" != --try ] || interpreter/packaging/try.sh "$out"
