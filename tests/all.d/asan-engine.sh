#!/usr/bin/env bash
# The engine's tests as the second compiler builds them, its warnings being errors, with AddressSanitizer and
# UndefinedBehaviorSanitizer: memory that is not ours, overflows, bad shifts. asan-tools.sh has all others.
# Minutes: 11
# Packages: all
set -u
rooms=(math material case grid points stage result)
cmake --preset asan >/dev/null && cmake --build --preset asan --target "${rooms[@]/#/test_}" >&2 || exit 1
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=print_suppressions=0:suppressions=$PWD/tests/leaks.supp
part=engine exec scripts/run-tests build/asan -L "^($(IFS='|' && echo "${rooms[*]}"))\$"
