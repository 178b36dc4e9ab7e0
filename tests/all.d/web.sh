#!/usr/bin/env bash
# Minutes: 3
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

cmake --build ../build/release --target synthetic_run polder >&2
polder=$PWD/../build/release/polder
../build/release/synthetic_run "$folder/run" 0.03 60

# Other pages, from runs that take seconds.
cat > "$folder/grids.toml" <<'END'
title = "Pipe leak: two grids"
case  = "pipe-leak-5kpa"
set   = ["stage.leak.duration=0.02 s", "output.snapshots=0.01 s"]
[[vary]]
key    = "model.cell"
label  = "h"
values = ["0.1 m", "0.05 m"]
[[measure]]
name    = "heave"
monitor = "heave"
trend   = "rises"
[[curve]]
monitor = "heave"
[profiles]
times = ["0.02 s"]
END
"$polder" study "$folder/grids.toml" --out "$folder/study" >/dev/null
"$polder" verify hydrostatic terzaghi --quick --report "$folder/verify" >/dev/null
"$polder" stability acads-1a --method bishop --report "$folder/stability" >/dev/null
"$polder" run levee-flood --set 'model.cell=["1 m", "1 m"]' --set 'output.snapshots=30 min' --until 25000 --out "$folder/levee" --quiet
"$polder" run pipe-leak --until 0.2 --out "$folder/pipe" --quiet

POLDER_REPORT="$folder/run/report.html" \
  POLDER_PAGES="$folder/study/report.html:$folder/verify/index.html:$folder/stability/stability.html:$folder/levee/report.html:$folder/pipe/report.html" \
  npm test --silent
