#!/usr/bin/env bash
# Makes the site in build/site: build.sh LOCKSTEP. Pages that link to files outside of docs/ get copies of them.
set -euo pipefail
command -v mkdocs >/dev/null || exit 77 # a test is skipped then
lockstep=$(realpath "$1")
cd "$(dirname "$0")/../../.."
pages=build/site-pages
rm -rf "$pages" build/site build/site-theme
cp -r interpreter/packaging/site/theme build/site-theme
mkdir -p "$pages/trees" "$pages/schema" "$pages/plugins/sdk/lockstep"
cp -r docs/. "$pages/"
cp -r trees/*.xml trees/carry_together "$pages/trees/"
cp schema/*.json schema/*.xsd schema/*.idl "$pages/schema/"
cp -r plugins/sdk/examples "$pages/plugins/sdk/"
cp -r plugins/sdk/lockstep/leaf.h plugins/sdk/lockstep/ext "$pages/plugins/sdk/lockstep/"
sed -i -E 's,\]\(\.\./,](,g; s,\[([a-z_-]+)\.md\]\(,[\1](,g' "$pages"/*.md
cp interpreter/packaging/site/mkdocs.yml build/mkdocs.yml
printf 'docs_dir: site-pages\nsite_dir: site\n' >>build/mkdocs.yml

# The front page has a recording, as `log page` makes it.
"$lockstep" run trees/door_pulling.xml --clock virtual --view none --record build/door.jsonl >/dev/null
"$lockstep" log page build/door.jsonl --out "$pages/door.html" 2>/dev/null
frame='<iframe src="door.html" title="A recording: arm and base pull a door open" style="width:100%;height:32rem;border:1px solid gray" loading="lazy"></iframe>'
sed -i "s|<!-- site: recording -->|$frame|" "$pages/index.md"
mkdocs build --strict --quiet --config-file build/mkdocs.yml
# For pages that are opened as files: theme/offline.js.
index=build/site/search/search_index
{ printf 'takeSearchIndex(' && cat $index.json && printf ');\n'; } >$index.js

# Nothing is loaded from another host. Links that a reader follows may lead there.
if grep -rlE '<(script|link|img|iframe|source)[^>]* (src|href)="?(https?:)?//' build/site --include='*.html' |
  grep -v '/door.html$'; then
  echo "site: these pages load something from another host" >&2
  exit 1
fi
echo build/site/index.html
