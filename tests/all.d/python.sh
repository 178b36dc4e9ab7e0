#!/usr/bin/env bash
# The reader of python/ and its example on the results of a short run.
# Minutes: 1
# Packages: python
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release >/dev/null && cmake --build --preset release --target polder >&2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
build/release/polder run dike-seepage --until 3 --out "$folder/run" --quiet
# Debian's own python has Debian's numpy; another one on the path may not.
/usr/bin/python3 tests/python/polder_results_test.py "$folder/run"
/usr/bin/python3 python/examples/draw_dike.py "$folder/run" "$folder/dike.png"
