#!/usr/bin/env bash
# Static analysis (.clang-tidy says which checks) of every file that the release build compiles for the program.
# Minutes: 60
# Packages: all
set -u
cmake --preset clang >/dev/null || exit 1
# The generated file is compiled into the program, but not ours to tidy.
find src apps -name '*.cpp' -print0 |
  xargs -0 -n 1 -P "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" clang-tidy --quiet -p build/clang 2>/dev/null
status=$?
[ $status = 0 ] || exit 1
