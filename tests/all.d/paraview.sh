#!/usr/bin/env bash
# ParaView's own reader on snapshots from formulas and on every step of the showcase; the first picture that python/ draws.
# Minutes: 1
# Packages: report-test python
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release >/dev/null && cmake --build --preset release --target test_result_long polder >&2
scripts/run-tests build/release -R '^ParaView\.'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/polder run dike-seepage --out "$folder/run" --quiet
/usr/bin/python3 tests/python/polder_results_test.py "$folder/run"
pvpython --force-offscreen-rendering tests/python/every_step_in_paraview.py "$folder/run"
# Debian's ParaView draws through an X server; without -noreset it may be gone between two of its connections.
xvfb-run -a -s "-noreset -screen 0 1280x800x24" \
  pvpython python/paraview_first_picture.py "$folder/run" --time 8 --out "$folder/first.png" --state "$folder/first.pvsm"
pvpython --force-offscreen-rendering tests/python/picture_shows.py "$folder/first.png"
grep -q 'name="soil"' "$folder/first.pvsm" || { echo "the state does not name the soil"; exit 1; }
