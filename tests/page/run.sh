#!/bin/sh
# run.sh BUILD FILE: runs a test of the page in Chromium, headless. Exit code 77: what it needs is not installed;
# `./dev test-page` installs it.
set -eu
build=$1 file=$2
modules=$(dirname "$0")/../../interpreter/show/web/page/node_modules
for program in node chromium; do
  command -v $program >/dev/null || { echo "no $program: ./dev test-page installs it"; exit 77; }
done
[ -d "$modules/playwright-core" ] || { echo "no $modules: ./dev test-page installs it"; exit 77; }
LOCKSTEP_BUILD=$build exec node --test --test-reporter=spec "$file"
