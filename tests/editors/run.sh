#!/bin/sh
# run.sh BUILD FILE: runs a test of the extension for VS Code. Exit code 77: what it needs is not installed; `./dev test`
# installs it.
set -eu
build=$1 file=$2
modules=$(dirname "$0")/../../schema/editors/vscode/node_modules
command -v node >/dev/null || { echo "no node: ./dev test installs it"; exit 77; }
[ -d "$modules/vscode-jsonrpc" ] || { echo "no $modules: ./dev test installs it"; exit 77; }
LOCKSTEP=${LOCKSTEP:-$build/lockstep} exec node --test --test-reporter=spec "$file"
