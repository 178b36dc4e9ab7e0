#!/usr/bin/env bash
# Instructions per point and step of the transfers, counted by callgrind on a block of Drucker–Prager sand: time depends
# on the machine, this does not. The limits are what was counted plus 3 % (benchmarks/instructions.limits); a change that
# saves instructions lowers them with --renew.
# Minutes: 1
# Packages: count
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release >/dev/null && cmake --build --preset release --target polder >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
limits=benchmarks/instructions.limits
steps=2 warm=2 # polder bench warms up by at least two steps

# count SPACE POINTS: lines "SPACE.KERNEL INSTRUCTIONS", per point of its phase (faces and solves: per soil point) and step
count() {
  valgrind --tool=callgrind --callgrind-out-file="$work/out" build/release/polder bench --space "$1" --points "$2" \
    --steps $steps --set material.1.law=drucker-prager --json "$work/bench.json" >/dev/null 2>"$work/log" || {
    cat "$work/log" >&2
    return 1
  }
  callgrind_annotate --inclusive=yes --threshold=100 "$work/out" >"$work/annotated"
  awk -v space="$1" -v steps=$((steps + warm)) '
    FNR == NR { gsub("[\",:]", ""); value[$1] = $2; next }
    match($0, /polder::(soil_to_grid|water_to_grid|predict_faces|grid_to_water|grid_to_soil|update_soil|project|correct_volume)</) {
      name = substr($0, RSTART + 8, RLENGTH - 9)
      gsub(",", "", $1)
      if ($1 + 0 > most[name]) most[name] = $1 + 0
    }
    END {
      for (name in most) {
        points = name ~ /water/ ? value["water_points"] : value["soil_points"]
        printf "%s.%s %.0f\n", space, name, most[name] / points / steps
      }
    }' "$work/bench.json" "$work/annotated" | sort
}

{ count plane-strain 10000 && count 3d 10000; } >"$work/counted"
if [ "${1-}" = --renew ]; then
  {
    echo "# instructions per point and step (x86-64-v3, g++ 12), counted + 3 %; renewed by tests/all.d/instructions.sh --renew"
    awk '{ printf "%s %.0f\n", $1, $2 * 1.03 }' "$work/counted"
  } >"$limits"
fi
awk '
  FNR == NR { if ($1 !~ /^#/) limit[$1] = $2; next }
  {
    bad = !($1 in limit) || $2 > limit[$1]
    printf "%-30s %6d   limit %6d%s\n", $1, $2, limit[$1], bad ? "   FAILED" : ""
    if (bad) failed++; else passed++
    delete limit[$1]
  }
  END {
    for (name in limit) { print name " was not counted: FAILED"; failed++ }
    printf "%d passed, %d failed\n", passed, failed
    exit failed > 0
  }' "$limits" "$work/counted"
