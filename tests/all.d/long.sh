#!/usr/bin/env bash
# The tests that take long (tests/<room>/*_long_test.cpp), in the release build that ./test left.
# Minutes: 4
set -u
if ctest --test-dir build/release -N -L long | grep -q 'Total Tests: 0$'; then
  echo "No test is labelled long."
  echo "0 passed, 0 failed"
  exit
fi
exec scripts/run-tests build/release -L long
