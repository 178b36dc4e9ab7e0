#!/usr/bin/env bash
# What asan-engine.sh leaves: the program, the finite elements, the slip surfaces, the reports and studies with
# AddressSanitizer and UndefinedBehaviorSanitizer.
# Minutes: 14
# Packages: all
set -u
engine=$(sed -n 's/^rooms=(\(.*\))$/\1/p' tests/all.d/asan-engine.sh)
mapfile -t rooms < <(printf '%s\n' tests/*/*_test.cpp | grep -v '_long_test' | cut -d/ -f2 | sort -u | grep -vxF "${engine// /$'\n'}")
cmake --preset asan >/dev/null && cmake --build --preset asan --target polder jumping_clock wrong_exp "${rooms[@]/#/test_}" >&2 || exit 1
export UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=print_suppressions=0:suppressions=$PWD/tests/leaks.supp
# without the long ones, and two problems that would take five minutes with the code of the others
part=tools exec scripts/run-tests build/asan -LE "^(long|layout|${engine// /|})\$" \
  -E '_NOT_BUILT$|VerificationProblem.*/(hydrostatic_jump|dupuit)$'
