#!/usr/bin/env bash
# Static analysis of what tidy-engine.sh leaves: the program, the finite elements, the slip surfaces, reports and studies.
# Minutes: 7
# Packages: all
exec bash tests/all.d/tidy-engine.sh tools
