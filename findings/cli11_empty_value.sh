#!/usr/bin/env bash
# CLI11 of Debian 12 (2.1.2+ds-1): an option that is written with an empty value, as `--record=`, takes the next word as its value.
#
# The next word may be another option, which then is not given. An empty word of its own, as in `--record ''`, is an empty value.
# So `--record=$FILE --json` of a shell in which FILE is not set records to a file called --json, and prints no JSON. Around it:
# look at the words before CLI11 does, and refuse one that ends with the '=' behind the name of an option.
#
# Debian packages: g++ and, without installing it, libcli11-dev.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -qq libcli11-dev=2.1.2+ds-1 2>/dev/null
dpkg -x libcli11-dev_*.deb .

cat >words.cpp <<'CPP'
#include <CLI/CLI.hpp>
#include <cstdio>

int main(int argc, char** argv) {
  CLI::App app;
  std::string record;
  bool json = false;
  app.add_option("--record", record);
  app.add_flag("--json", json);
  CLI11_PARSE(app, argc, argv);
  std::printf("record is '%s', json is %s\n", record.c_str(), json ? "given" : "not given");
}
CPP
g++ -std=c++17 -I usr/include words.cpp -o words
{
  ./words --record=a --json
  ./words --record= --json
  ./words --record= a
  ./words --record '' --json
} >seen
diff - seen <<'SEEN'
record is 'a', json is given
record is '--json', json is not given
record is 'a', json is not given
record is '', json is given
SEEN
echo "CLI11 2.1.2+ds-1: as described"
