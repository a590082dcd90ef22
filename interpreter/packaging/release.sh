#!/usr/bin/env bash
# ./dev release [VERSION] [--arch ARCH] [--dry-run]: everything of a release but its push, in build/release-VERSION: packages,
# the archive of the sources, the site in a folder of its version, checksums, and a tag in this clone. Refuses what is not
# ready. The tag is its last step: when one before it fails, mend that and run it again.
set -euo pipefail
cd "$(dirname "$0")/../.."

version="" dry="" others=()
while [ $# -gt 0 ]; do
  case $1 in
    --dry-run) dry=yes ;;
    --arch)
      [ $# -gt 1 ] || { echo "release: --arch needs an architecture of Debian, such as arm64" >&2 && exit 2; }
      others+=("$2") && shift
      ;;
    [0-9]*.[0-9]*.[0-9]*) version=$1 ;;
    *) echo "release: expected [VERSION] [--arch ARCH] [--dry-run], got '$1'" >&2 && exit 2 ;;
  esac
  shift
done
if [ ! -e .git ] || ! command -v git >/dev/null; then
  echo "release: a release is a commit and a tag: clone the sources with git, and run it there; ./dev package needs no git" >&2
  exit 1
fi
is=$(sed -n 's/^project(lockstep VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
version=${version:-$is}
tag=v$version
problems=()
[ "$version" = "$is" ] || problems+=("CMakeLists.txt has version $is, not $version: change it there, and in the files below")

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
changes=$(git status --porcelain)
[ -z "$changes" ] || problems+=("there are changes that are not committed: commit them, or git stash --include-untracked")
[ -z "$(git tag --list "$tag")" ] ||
  problems+=("there is a tag $tag already: release a higher version; or, if it was never pushed, git tag --delete $tag")
git var GIT_COMMITTER_IDENT >/dev/null 2>&1 ||
  problems+=("a tag has an author, whom git does not know: git config user.name NAME, and user.email")
for problem in "${problems[@]}"; do echo "release: $problem" >&2; done
if [ -z "${DEBEMAIL:-}" ]; then
  echo "release: warning: the packages name a maintainer who is nobody, $(sed -n 's/^Maintainer: //p' interpreter/packaging/control):" \
    "set DEBFULLNAME and DEBEMAIL to who answers for them" >&2
fi
if [ -n "$dry" ]; then
  echo "would make, in build/release-$version: Debian packages, lockstep-$version.tar.gz, lockstep-site-$version.tar.gz, SHA256SUMS; and the tag $tag"
fi
[ ${#problems[@]} -eq 0 ] || exit 1
[ -z "$dry" ] || exit 0

out=build/release-$version
archive=$(mktemp -d)
finish() {
  local code=$?
  rm -rf "$archive"
  [ $code -eq 0 ] || echo "release: stopped, and nothing is tagged: mend that, then run it again" >&2
}
trap finish EXIT
step() { echo "release: $*" >&2; }
# quietly COMMAND…: its output, only if it fails.
quietly() { "$@" >"$archive/log" 2>&1 || { tail -n 40 "$archive/log" >&2 && return 1; }; }

SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
commit=$(git rev-parse HEAD)
rm -rf "$out"
mkdir -p "$out"
step "packages, and the archive of the sources"
./dev package
cp build/package/packages/*.deb build/package/packages/*.tar.gz "$out/"
for other in "${others[@]}"; do
  step "packages for $other"
  ./dev package --arch "$other"
  cp build/package-"$other"/packages/*_"$other".deb "$out/"
done

step "the archive builds where there is no git"
tar -xzf "$out/lockstep-$version.tar.gz" -C "$archive"
sources=$archive/lockstep-$version
quietly cmake -S "$sources" --preset release
quietly cmake --build "$sources/build/release" --target lockstep motion r1sim
quietly "$sources/build/release/lockstep" run "$sources/trees/door_pulling.xml" --clock virtual --view none

step "the site, in a folder of its version: the front page leads to the newest"
quietly interpreter/packaging/site/build.sh build/package/lockstep
mkdir -p "$out/site"
cp -r build/site "$out/site/$version"
printf '<!doctype html><meta http-equiv="refresh" content="0; url=%s/index.html"><a href="%s/index.html">lockstep %s</a>\n' \
  "$version" "$version" "$version" >"$out/site/index.html"
tar --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --mtime="@$SOURCE_DATE_EPOCH" -C "$out" -cf - site |
  gzip -9n >"$out/lockstep-site-$version.tar.gz"
(cd "$out" && sha256sum ./*.deb ./*.tar.gz | sed 's, \./, ,' >SHA256SUMS)
[ "$(git rev-parse HEAD)" = "$commit" ] || { step "the clone has another commit than when this began" && exit 1; }
git tag --annotate "$tag" --message "lockstep $version"
ls "$out"
step "$tag is made; look at $out, then: git push origin $tag, and upload the folder"
