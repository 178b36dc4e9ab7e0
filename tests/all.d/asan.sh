#!/usr/bin/env bash
# The tests as the second compiler builds them, its warnings being errors, with AddressSanitizer and
# UndefinedBehaviorSanitizer: memory that is not ours, overflows, bad shifts.
# Minutes: 40
# Packages: all
set -u
cmake --preset asan >/dev/null && cmake --build --preset asan >&2 || exit 1
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/tests/leaks.supp
exec scripts/run-tests build/asan -LE 'long|layout'
