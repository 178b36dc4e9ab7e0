#!/usr/bin/env bash
# The tests as the second compiler builds them, its warnings being errors, too.
# Minutes: 30
# Packages: all
set -u
cmake --preset clang >/dev/null && cmake --build --preset clang >&2 || exit 1
exec scripts/run-tests build/clang -LE 'long|layout'
