#!/usr/bin/env bash
# ./dev release [VERSION] [--dry-run]: everything of a release but its push, in build/release-VERSION: packages, the archive
# of the sources, the site in a folder of its version, checksums, and a tag in this clone. Refuses what is not ready.
set -euo pipefail
cd "$(dirname "$0")/../.."

version="" dry=""
for word in "$@"; do
  case $word in
    --dry-run) dry=yes ;;
    [0-9]*.[0-9]*.[0-9]*) version=$word ;;
    *) echo "release: expected [VERSION] [--dry-run], got '$word'" >&2 && exit 2 ;;
  esac
done
is=$(sed -n 's/^project(lockstep VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
version=${version:-$is}
problems=()
[ "$version" = "$is" ] || problems+=("CMakeLists.txt has version $is, not $version")

# says FILE PATTERN: the version stands there as everywhere else.
says() { grep -q -- "$2" "$1" || problems+=("$1 has another version: expected $2"); }
says package.xml "<version>$version</version>"
says plugins/ros2/package.xml "<version>$version</version>"
says plugins/lockstep_ros/package.xml "<version>$version</version>"
says plugins/sdk/python/pyproject.toml "^version = \"$version\""
says schema/editors/vscode/package.json "\"version\": \"$version\""
says CHANGELOG.md "^## $version\$"
awk '/^## Unreleased/ { here = 1; next } /^## / { here = 0 } here && NF { exit 1 }' CHANGELOG.md ||
  problems+=("CHANGELOG.md has lines under 'Unreleased': move them under '$version'")
[ -d "tests/frozen/${version%.*}" ] || [ "${version##*.}" != 0 ] ||
  problems+=("tests/frozen has no folder ${version%.*}: copy the last one without 'given' and 'expected', then frozen_test.py --write")
[ -z "$(git status --porcelain)" ] || problems+=("there are changes that are not committed")
tag=v$version
[ -z "$(git tag --list "$tag")" ] || problems+=("there is a tag $tag already")
for problem in "${problems[@]}"; do echo "release: $problem" >&2; done
if [ -n "$dry" ]; then
  echo "would make, in build/release-$version: Debian packages, lockstep-$version.tar.gz, site/$version, SHA256SUMS; and the tag $tag"
fi
[ ${#problems[@]} -eq 0 ] || exit 1
[ -z "$dry" ] || exit 0

out=build/release-$version
rm -rf "$out"
mkdir -p "$out"
./dev package
cp build/package/packages/*.deb build/package/packages/*.tar.gz "$out/"

# The archive builds where there is no git.
archive=$(mktemp -d)
trap 'rm -rf "$archive"' EXIT
tar -xzf "$out/lockstep-$version.tar.gz" -C "$archive"
(
  cd "$archive/lockstep-$version"
  cmake --preset release >/dev/null
  cmake --build build/release --target lockstep motion r1sim >/dev/null
  build/release/lockstep run trees/door_pulling.xml --clock virtual --view none >/dev/null
)

# A folder for each release; the front page leads to the newest.
interpreter/packaging/site/build.sh build/package/lockstep >/dev/null
mkdir -p "$out/site"
cp -r build/site "$out/site/$version"
printf '<!doctype html><meta http-equiv="refresh" content="0; url=%s/index.html"><a href="%s/index.html">lockstep %s</a>\n' \
  "$version" "$version" "$version" >"$out/site/index.html"
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" -C "$out" -cf - site | gzip -9n \
  >"$out/lockstep-site-$version.tar.gz"
(cd "$out" && sha256sum ./*.deb ./*.tar.gz | sed 's, \./, ,' >SHA256SUMS)
git tag --annotate "$tag" --message "lockstep $version"
ls "$out"
echo "release: $tag is made; look at $out, then: git push origin $tag, and upload the folder" >&2
