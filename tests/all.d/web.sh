#!/usr/bin/env bash
# Minutes: 10
# Packages: report-test
# The viewer of report.html: its types, its bundle against the one that is committed, and the report in a browser.
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../../web"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
npm ci --no-audit --no-fund --loglevel=error

npm run --silent check
cp -r dist "$folder/committed"
npm run --silent build
diff -r "$folder/committed" dist >/dev/null || { echo "web/dist is not what web/src gives: run npm run build there and commit it"; exit 1; }

cmake --build ../build/release --target synthetic_run >&2
../build/release/synthetic_run "$folder/run" 0.03 60
POLDER_REPORT="$folder/run/report.html" npm test --silent
