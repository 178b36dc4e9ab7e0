#!/usr/bin/env bash
# Each reader on bytes that a fuzzer makes of the seeds in tests/fuzz/seeds and of the shipped cases, with
# AddressSanitizer and UndefinedBehaviorSanitizer. Argument: how many thousandths of the usual number of inputs (1000).
# What it finds is kept in build/fuzz/found; a small input of its kind belongs into a unit test.
# Minutes: 30
# Packages: all
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 2
cmake --preset fuzz >/dev/null && cmake --build --preset fuzz >&2 || exit 1
export UBSAN_OPTIONS=print_stacktrace=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p build/fuzz/found "$work"/{case_file,msh,stix}
for target in msh stix; do cp tests/fuzz/seeds/$target/* "$work/$target"; done
for case in cases/*/case.toml; do cp "$case" "$work/case_file/$(basename "$(dirname "$case")")"; done
# the words of case files, from the page that the schema writes
grep -oE '`[a-z_]+`' docs/case-file.md | sort -u | tr '`' '"' >"$work/words"

passed=0 failed=0
fuzz() {
  local target=$1 runs=$(($2 * ${share:-1000} / 1000))
  shift 2
  if build/fuzz/fuzz_"$target" -runs="$runs" -seed=20261129 -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/found/$target-" "$@" "$work/$target" >"$work/$target.log" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    tail -n 40 "$work/$target.log"
  fi
  echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$work/$target.log") inputs"
}
share=${1-1000}
fuzz case_file 5000 -dict="$work/words" -max_len=8192
fuzz msh 200000 -max_len=4096
fuzz stix 20000 -max_len=12288
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
