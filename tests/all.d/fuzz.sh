#!/usr/bin/env bash
# Each reader on bytes that a fuzzer makes of the seeds in tests/fuzz/seeds and of the shipped cases, with
# AddressSanitizer and UndefinedBehaviorSanitizer. Argument: how many thousandths of the usual number of inputs (1000).
# What it finds is kept in build/asan/found; a small input of its kind belongs into a unit test.
# Minutes: 3
# Packages: all
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 2
cmake --preset asan >/dev/null && cmake --build --preset asan --target fuzz >&2 || exit 1
export UBSAN_OPTIONS=print_stacktrace=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p build/asan/found "$work"/{case_file,checkpoint,msh,stix,table}
for target in msh stix table; do cp tests/fuzz/seeds/$target/* "$work/$target"; done
for case in cases/*/case.toml; do cp "$case" "$work/case_file/$(basename "$(dirname "$case")")"; done
# the words of case files, from the page that the schema writes
grep -oE '`[a-z_]+`' docs/case-file.md | sort -u | tr '`' '"' >"$work/words"

passed=0 failed=0
said() { sed -n "s/^$1: *//p" "$work/$target.log" | tail -n 1 | grep . || echo 0; }
fuzz() {
  local target=$1 runs=$(($2 * share / 1000)) crashes=0
  shift 2
  if build/asan/fuzz_"$target" -runs="$runs" -seed=20261129 -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="build/asan/found/$target-" "$@" "$work/$target" >"$work/$target.log" 2>&1; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1)) crashes=1
    tail -n 40 "$work/$target.log"
  fi
  echo "record: fuzz $target $(said stat::number_of_executed_units) $crashes $(said refused) refused with a message"
}
share=${1-1000}
fuzz case_file 60000 -dict="$work/words" -max_len=8192
fuzz checkpoint 30000 -max_len=220
fuzz msh 500000 -max_len=4096
fuzz stix 60000 -max_len=12288
fuzz table 60000 -max_len=2048
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
