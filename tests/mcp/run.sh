#!/bin/sh
# run.sh BUILD FILE: runs a test of `lockstep mcp` with the official client. Exit code 77: what it needs is not
# installed; `./dev test` installs it.
set -eu
build=$1 file=$2
command -v node >/dev/null || { echo "no node: ./dev test installs it"; exit 77; }
[ -d "$(dirname "$0")/node_modules/@modelcontextprotocol/sdk" ] || {
  echo "no @modelcontextprotocol/sdk: ./dev test installs it with npm"
  exit 77
}
LOCKSTEP_BUILD=$build exec node --test --test-reporter=spec "$file"
