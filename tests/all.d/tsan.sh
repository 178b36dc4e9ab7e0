#!/usr/bin/env bash
# The tests that use several threads, and random models with two, with ThreadSanitizer: data races. The others cannot have
# any. Address randomisation is off because GCC 12's runtime refuses the wide randomisation of newer kernels.
# Minutes: 4
set -u
quiet=()
setarch -R true 2>/dev/null && quiet=(setarch -R)
cmake --preset tsan >/dev/null && "${quiet[@]}" cmake --build --preset tsan --target test_grid test_stage >&2 || exit 1
export POLDER_THREADS=2
exec "${quiet[@]}" scripts/run-tests build/tsan -R \
  '^(PressureSolver\.|RandomModels\.|Run\.IsTheSameForAnyNumberOfThreads|Checkpoint\.ContinuesBitForBit)'
