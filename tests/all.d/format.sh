#!/usr/bin/env bash
# The layout of the source, where ./test could not check it for want of clang-format.
# Minutes: 1
# Packages: all
exec tests/format/check-format .
