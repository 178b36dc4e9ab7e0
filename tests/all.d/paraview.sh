#!/usr/bin/env bash
# ParaView's own reader on the snapshots that Polder writes.
# Minutes: 2
# Packages: report-test
set -u
cmake --preset release >/dev/null && cmake --build --preset release --target test_result_long >&2 || exit 1
exec scripts/run-tests build/release -R '^ParaView\.'
