# seepage: numbers, tables and pictures of a case's seepage, and what is said of wrong ones.
expect 0 polder seepage dike-seepage --out flow
has "$out" "inflow"
has "$out" "reservoir"
has "$out" "exit gradient"
for file in nodes-0.csv head-0.png pore-pressure-0.png seepage.json; do
  [ -s flow/$file ] || fail "there is no flow/$file"
done
has "$(head -n 1 flow/nodes-0.csv)" "head (m)"

expect 0 polder seepage dike-seepage --json - --set 'seepage.times=["1 s", "2 s"]'
has "$out" '"time": 2.0'

expect 2 polder seepage hydrostatic-3d
has "$err" "three-dimensional"

expect 2 polder seepage dike-seepage --set 'seepage.mesh_sise="1 m"'
has "$err" 'did you mean "mesh_size"?'

expect 2 polder seepage dike-seepage --set seepage.deformation=true
has "$err" 'give seepage.times'

# Ground that deforms: as much cohesion as keeps the dike standing.
expect 0 polder seepage dike-seepage --out deforming --set seepage.deformation=true --set 'seepage.times=["1 s"]' \
  --set 'seepage.mesh_size="0.2 m"' --set 'material.sand.cohesion="5 kPa"' --set material.sand.permeability_change=0.875
has "$out" "largest of the ground"
[ -s deforming/strain-0.png ] || fail "there is no deforming/strain-0.png"
