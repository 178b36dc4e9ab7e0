#!/usr/bin/env bash
# Static analysis (.clang-tidy says which checks) of what the engine is compiled from; tidy-tools.sh has the rest.
# Minutes: 6
# Packages: all
set -u
rooms=(math material case grid points boundary step stage result)
[ "${1-}" != tools ] || tools=1
cmake --preset clang >/dev/null || exit 1
files() { # the generated ones are compiled into the program, but not ours to tidy
  local engine
  engine=$(IFS='|' && echo "${rooms[*]}")
  find src apps -name '*.cpp' | grep -E ${tools:+-v} "^src/polder/($engine)/"
}
files | xargs -n 1 -P "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" clang-tidy --quiet -p build/clang 2>/dev/null
[ $? = 0 ] || exit 1
