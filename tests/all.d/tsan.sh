#!/usr/bin/env bash
# The tests with ThreadSanitizer: data races. Address randomisation is off because GCC 12's runtime refuses the wide
# randomisation of newer kernels.
# Minutes: 60
set -u
quiet=()
setarch -R true 2>/dev/null && quiet=(setarch -R)
cmake --preset tsan >/dev/null && "${quiet[@]}" cmake --build --preset tsan >&2 || exit 1
exec "${quiet[@]}" scripts/run-tests build/tsan -LE 'long|layout'
