# new, check, list and schema: a case from nothing, its mistakes, its drawing.
expect 0 polder new my-dike.toml
has "$out" "polder check my-dike.toml"
expect 2 polder new my-dike.toml
has "$err" "exists already"

expect 0 polder check my-dike.toml
has "$out" "540 cells"
has "$out" "my-dike-model.svg"
[ -s my-dike-model.svg ] && [ -s my-dike-model.png ] || fail "no drawing"
[ -z "$err" ] || fail "a new case has nothing to complain about"

# All mistakes at once, like a compiler's; nothing is written.
mkdir wrong
expect 2 polder check my-dike.toml --set 'model.cell=0.1 kg' --set material.sand.friction_angle=34 --out wrong
has "$err" '--set:1:12: error: model.cell: "0.1 kg" is a mass; a length is needed'
has "$err" 'write "34 deg"'
has "$err" "2 errors"
[ -z "$(ls wrong)" ] || fail "a wrong case was drawn"

expect 2 polder check my-dike.toml --set 'numerics.clf=0.5' --json
has "$out" '"ok": false'
has "$out" 'did you mean \"cfl\"?'
[ -z "$err" ] || fail "with --json all goes to stdout"

expect 2 polder check dike-sepage
has "$err" 'did you mean "dike-seepage"?'

expect 0 polder list
has "$out" "dike-seepage "
has "$out" "Seepage failure of a dike"

expect 0 polder new copies/darcy --from dike-paper-darcy
has "$(cat copies/darcy/case.toml)" 'drag = "darcy"'
expect 0 polder check copies/darcy --no-drawing --json
has "$out" '"cells": 2448'

expect 0 polder schema
has "$out" "# The case file"
expect 0 polder schema --json
has "$out" '"$schema"'
