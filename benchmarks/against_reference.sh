#!/usr/bin/env bash
# A soil and a water point through a step's transfers, faces and sort, beside the frozen reference kernels in
# the same run, one thread, 1e6 points: "c1" is the yardstick (collocated, one phase), "w_row" and "s_row" the one-file
# staggered kernels for water and soil.
#   benchmarks/against_reference.sh FOLDER      FOLDER has mac_bench.cpp and the headers beside it
# Run it on an otherwise idle machine: only the ratios count. Needs build/release/step_benchmark (POLDER_BENCHMARKS=ON).
set -eu
[ $# = 1 ] && [ -f "$1/mac_bench.cpp" ] || { echo "usage: $0 FOLDER, with mac_bench.cpp in it" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
kernels=$root/build/release/step_benchmark
[ -x "$kernels" ] || { echo "$kernels is missing: build it with -DPOLDER_BENCHMARKS=ON" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# FEW leaves out the reference's other variants, which nobody asks for here.
g++ -O3 -march=x86-64-v3 -std=c++20 -fopenmp -w -DFEW -I"$1" "$1/mac_bench.cpp" -o "$work/mac_bench"

compare() {  # AXES POINTS_PER_CELL BLOCKS
  "$work/mac_bench" "$1" 1e6 "$2" 1 "$3" c1,w_row,s_row >"$work/reference"
  "$kernels" --benchmark_format=csv --benchmark_filter="(points_to_grid|faces|grid_to_points|sort).*/${1}d/1e6" 2>/dev/null >"$work/kernels"
  awk -v axes="$1" '
    FNR == NR { for (i = 1; i < NF; i++) if ($i == "tot") reference[$1] = $(i + 1); next }
    { split($0, column, ","); name = column[1]; gsub("\"", "", name); ns[name] = 1e9 * column[split($0, column, ",")] }
    function of(kernel,   name) {
      for (name in ns) if (index(name, kernel "/" axes "d/1e6") == 1) return ns[name]
      return 0
    }
    function row(what, value) { printf "  %-40s %8.1f\n", what, value }
    END {
      staggered = reference["w_row"] + reference["s_row"]
      print axes "d, ns a point:"
      row("reference c1", reference["c1"])
      row("reference w_row + s_row", staggered)
      n = split("points_to_grid/soil points_to_grid/water faces_with_drag grid_to_points/water", part, " ")
      part[++n] = "grid_to_points/soil/drucker-prager"
      for (i = 1; i <= n; i++) { row(part[i], of(part[i])); pair += of(part[i]) }
      row("sort, every 20 steps", of("sort") / 20)
      pair += of("sort") / 20
      row("pair", pair)
      printf "  ratio of the pair to c1 %.2f, to the staggered kernels %.2f\n", pair / reference["c1"], pair / staggered
    }' "$work/reference" "$work/kernels"
}

compare 2 4 3
compare 3 8 2
