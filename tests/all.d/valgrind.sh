#!/usr/bin/env bash
# A short run under valgrind: values that nobody set, memory that is not ours or is lost, in the libraries, too.
# Minutes: 2
# Packages: all
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release >/dev/null && cmake --build --preset release --target polder >&2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
checked=(valgrind --quiet --suppressions=tests/all.d/valgrind.supp --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite)
run=(build/release/polder run dike-seepage --threads 1 --quiet --out "$folder/run")
"${checked[@]}" "${run[@]}" --until 0.003
"${checked[@]}" "${run[@]}" --until 0.006 --resume
"${checked[@]}" build/release/polder stability dike-seepage --method bishop >/dev/null
steps=$(sed -n 's/^ *"steps": *\([0-9]*\).*/\1/p' "$folder/run/summary.json")
echo "record: valgrind dike-seepage $steps 0 steps with a checkpoint, its resumption and a search by Bishop's method"
