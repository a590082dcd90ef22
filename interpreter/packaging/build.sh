#!/usr/bin/env bash
# Makes the Debian packages of a build with LOCKSTEP_PACKAGES: build.sh BUILD. The same sources, compiler and
# SOURCE_DATE_EPOCH give the same bytes. control describes the packages.
set -euo pipefail
build=$(realpath "$1")
here=$(realpath "$(dirname "$0")")
work=$build/debian
out=$build/packages
: "${SOURCE_DATE_EPOCH:?the time of the release, in seconds}"
export SOURCE_DATE_EPOCH

upstream=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
version=$upstream-1
soname=${upstream%%.*}
architecture=${DEB_HOST_ARCH:-$(dpkg --print-architecture)}
library=liblockstep-runtime$soname
# dependencies FILE…: substvars. dpkg-shlibdeps finds libraries of this machine only: those of another processor are in a
# sysroot, whose packages are needed in their version there, or later; a later revision of Debian is the same library.
dependencies() {
  if [ -z "${LOCKSTEP_SYSROOT:-}" ]; then
    printf -- '-e%s\n' "$@" | xargs dpkg-shlibdeps --ignore-missing-info -Tsubstvars
    return
  fi
  local query=(dpkg-query "--admindir=$LOCKSTEP_SYSROOT/var/lib/dpkg") library package
  readelf --dynamic "$@" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | sort -u | while read -r library; do
    package=$("${query[@]}" --search "*/$library" 2>/dev/null | sed -n '1s/:.*//p')
    [ -z "$package" ] ||
      echo "$package (>= $("${query[@]}" --show --showformat='${Version}' "$package:$architecture" | sed 's/-[^-]*$//'))"
  done | sort -u | paste -sd, | sed 's/^/shlibs:Depends=/; s/,/, /g' >substvars
}
# Package and the components that CMake installs in it.
packages=("lockstep lockstep" "lockstep-dev sdk runtime_dev" "$library runtime" "python3-lockstep python" "lockstep-doc doc")

rm -rf "$work" "$out"
mkdir -p "$work/debian" "$out"
sed "s/@SONAME@/$soname/; s/@VERSION@/$version/; s/@UPSTREAM@/$upstream/" "$here/control" >"$work/debian/control"
# The maintainer, from the variables that Debian's tools read.
if [ -n "${DEBEMAIL:-}" ]; then
  sed -i "s|^Maintainer: .*|Maintainer: ${DEBFULLNAME:-The lockstep authors} <$DEBEMAIL>|" "$work/debian/control"
fi
cat >"$work/debian/changelog" <<TEXT
lockstep ($version) unstable; urgency=medium

  * Release $upstream; lockstep-doc has its CHANGELOG.md.

 -- $(sed -n 's/^Maintainer: //p' "$work/debian/control")  $(LC_ALL=C date -u -R -d "@$SOURCE_DATE_EPOCH")
TEXT

strip_files() {
  find "$1" -type f -print0 | while IFS= read -r -d '' file; do
    case $(file -b "$file") in
      ELF*) "${STRIP:-strip}" --strip-unneeded --remove-section=.comment --remove-section=.note "$file" ;;
      *"ar archive"*) "${STRIP:-strip}" --strip-debug --remove-section=.comment --enable-deterministic-archives "$file" ;;
    esac
  done
}

# What all packages have: copyright, changelog, and what lintian would say without reason.
add_documents() {
  local root=$1 package=$2 directory=$1/usr/share/doc/$2
  mkdir -p "$directory" "$root/DEBIAN"
  cp "$here/copyright" "$directory/copyright"
  gzip -9nc "$work/debian/changelog" >"$directory/changelog.Debian.gz"
  mkdir -p "$root/usr/share/lintian/overrides"
  {
    echo "# These packages are not uploaded to Debian."
    echo "$package: initial-upload-closes-no-bugs"
  } >"$root/usr/share/lintian/overrides/$package"
}

add_scripts() {
  local root=$1 package=$2
  if [ "$package" = "$library" ]; then
    echo "liblockstep-runtime $soname $library (= $version)" >"$root/DEBIAN/shlibs"
    echo "activate-noawait ldconfig" >"$root/DEBIAN/triggers"
  fi
  if [ "$package" = python3-lockstep ]; then
    install -m 755 "$here/python/postinst" "$here/python/prerm" "$root/DEBIAN/"
  fi
}

# Sorted files, the time of the release, owned by root.
finish() {
  local root=$1 package=$2
  cd "$work"
  if [ "$package" = lockstep ] || [ "$package" = "$library" ]; then
    mapfile -t programs < <(find "$root" -type f -print0 | xargs -0 file -N | sed -n 's/: *ELF.*//p' | sort)
    dependencies "${programs[@]}"
  else
    : >substvars
  fi
  dpkg-gencontrol -p"$package" -P"$root" -Tsubstvars -fdebian/files \
    -DArchitecture="$(awk -v p="$package" '$1 == "Package:" { here = $2 == p } here && $1 == "Architecture:" { print $2 }' \
      debian/control | sed "s/any/$architecture/")" 2>/dev/null
  (cd "$root" && find usr -type f -print0 | LC_ALL=C sort -z | xargs -0 md5sum >DEBIAN/md5sums)
  chmod -R u=rwX,go=rX "$root"
  find "$root" -newermt "@$SOURCE_DATE_EPOCH" -print0 | xargs -0r touch --no-dereference --date="@$SOURCE_DATE_EPOCH"
  dpkg-deb --root-owner-group -Zxz --build "$root" "$out" >/dev/null
}

for entry in "${packages[@]}"; do
  read -r package components <<<"$entry"
  root=$work/$package
  mkdir -p "$root"
  for component in $components; do
    DESTDIR=$root cmake --install "$build" --component "$component" >/dev/null
  done
  strip_files "$root"
  add_documents "$root" "$package"
  add_scripts "$root" "$package"
  (finish "$root" "$package")
done
ls "$out"/*.deb
