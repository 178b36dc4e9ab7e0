# stability: factors of a case, and what is said of a model that cannot be computed.
expect 0 polder stability griffiths-lane-1 --method bishop
has "$out" "1.379"

# Without a limit of its own a dike of sand is not judged by the skin of its face.
expect 0 polder stability dike-seepage --method bishop --json -
factor=$(sed -n 's/.*"factor_of_safety": \([0-9.]*\).*/\1/p' <<<"$out")
awk -v f="$factor" 'BEGIN { exit !(f > 0.5 && f < 2) }' || fail "the dike's factor is $factor"

expect 2 polder stability griffiths-lane-1 --method bischop
has "$err" "there is no method 'bischop'; known: bishop"

slope() {
  cat <<TOML
[model]
size = ["50 m", "10 m"]
cell = "0.5 m"
[[material]]
name = "soil"
law = "mohr-coulomb"
unsaturated_unit_weight = "20 kN/m3"
grain_density = "2650 kg/m3"
permeability = "1e-6 m/s"
young_modulus = "100 MPa"
poisson_ratio = 0.3
cohesion = "10 kPa"
friction_angle = "20 deg"
[[stage]]
name = "rest"
duration = "1 s"
${1-}
TOML
}
layer() { printf '[[soil]]\nmaterial = "soil"\npolygon = %s\n' "$1"; }
bank='[["12 m", "2 m"], ["50 m", "2 m"], ["50 m", "10 m"], ["32 m", "10 m"]]'
base='[["0 m", "0 m"], ["50 m", "0 m"], ["50 m", "2 m"], ["0 m", "2 m"]]'

slope >no-soil.toml
expect 2 polder stability no-soil.toml
has "$err" "soil"

slope "$(layer "$bank" && layer "${base//2 m/1.8 m}")" >gap.toml
expect 2 polder stability gap.toml
has "$err" "gap of 0.200 m between layer 1 and layer 2"
has "$err" "share the points of their common boundary"

two=$(layer "$bank" && layer "$base")
slope "$two" >slope.toml
expect 0 polder stability slope.toml --method bishop
[ -z "$err" ] || fail "nothing is wrong with this slope"

slope "$two
[stability]
minimum_depth = \"20 m\"" >deep.toml
expect 3 polder stability deep.toml --method bishop
has "$err" "limit: minimum depth"
has "$err" "Widen the limits (entry, exit, minimum_depth"

slope "$two
[stability]
entry = [\"80 m\", \"90 m\"]" >beyond.toml
expect 2 polder stability beyond.toml --method bishop
has "$err" "entry from 80 to 90 m lies outside the section (0 to 50 m)"

slope "$two
[initial]
water_table = [[\"0 m\", \"5 m\"], [\"50 m\", \"5 m\"]]" >flooded.toml
expect 2 polder stability flooded.toml --method bishop
has "$err" "the water table is 3.00 m above the ground"
has "$err" "[[free_water]]"

slope "$two
[stability]
phreatic_line = [[\"0 m\", \"5 m\"], [\"50 m\", \"5 m\"]]" >flooded-line.toml
expect 0 polder stability flooded-line.toml --method bishop
has "$err" "note: the phreatic line is above the ground"

slope "$two
[stability]
triangles = 100
[[dike_check]]
name = \"toe\"
at = \"5 m\"
aquifer = \"soil\"" >check.toml
expect 2 polder stability check.toml
has "$err" "uplift (toe): nothing lies on 'soil' at x = 5 m"

# The page, the JSON with slices, and keys changed on the command line.
expect 0 polder stability griffiths-lane-1 --method bishop --report page --json rows.json --slices \
  --set stability.partial_friction=1.25 --set stability.partial_cohesion=1.25
has "$out" "bishop (design)"
has "$(cat page/stability.html)" "<h2>bishop</h2>"
has "$(cat rows.json)" '"slices"'
has "$(cat rows.json)" '"strengths": "design"'

# Every method is offered, strength reduction among them.
expect 0 polder stability --help
has "$out" "srm"
