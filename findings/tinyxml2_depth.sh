#!/usr/bin/env bash
# tinyxml2 of Debian 12 (9.0.0+dfsg-3.1): a document with more than 98 levels of elements is an error.
#
# XML has no such limit, and xmllint reads the same document. tinyxml2 returns XML_ELEMENT_DEPTH_EXCEEDED, by the constant
# TINYXML2_MAX_ELEMENT_DEPTH of its header: 100 in this release, 500 in later ones, and the document counts too. So a program
# that was tried with a newer, bundled tinyxml2 refuses deep files where it is linked with Debian's.
#
# Debian packages: g++, libxml2-utils (xmllint) and, without installing it, libtinyxml2-dev with libtinyxml2-9.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq libtinyxml2-dev=9.0.0+dfsg-3.1 libtinyxml2-9=9.0.0+dfsg-3.1 2>/dev/null
for package in *.deb; do dpkg -x "$package" .; done
library=$(dirname "$(find . -name 'libtinyxml2.so.9' | head -n 1)")

cat >deep.cpp <<'CPP'
#include <tinyxml2.h>

#include <cstdio>
#include <string>

int main() {
  for (int levels : {98, 99, 200}) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += "<a>";
    for (int i = 0; i < levels; ++i) text += "</a>";
    tinyxml2::XMLDocument document;
    document.Parse(text.c_str());
    std::printf("%d levels: %s\n", levels, document.ErrorName());
    if (std::FILE* file = std::fopen((std::to_string(levels) + ".xml").c_str(), "w")) {
      std::fputs(text.c_str(), file);
      std::fclose(file);
    }
  }
}
CPP
g++ -std=c++17 -I usr/include deep.cpp -L "$library" -l:libtinyxml2.so.9 -o deep
{
  LD_LIBRARY_PATH=$library ./deep
  for levels in 98 99 200; do xmllint --noout $levels.xml && echo "$levels levels: xmllint reads it"; done
} >seen
diff - seen <<'SEEN'
98 levels: XML_SUCCESS
99 levels: XML_ELEMENT_DEPTH_EXCEEDED
200 levels: XML_ELEMENT_DEPTH_EXCEEDED
98 levels: xmllint reads it
99 levels: xmllint reads it
200 levels: xmllint reads it
SEEN
echo "tinyxml2 9.0.0+dfsg-3.1: as described"
