# Laboratory tests on the materials of a file: a table per test, curves per type of test, mistakes with their line.
cat >sand.toml <<'TOML'
[[material]]
name = "sand"
law = "mohr-coulomb"
young_modulus = "55.86 MPa"
poisson_ratio = 0.33
friction_angle = "37 deg"
porosity = 0.355

[[test]]
name = "CD 100 kPa"
type = "triaxial-drained"
strain = "2 %"

[[test]]
type = "oedometer"
vertical_stress = "10 kPa"
loads = ["100 kPa", "20 kPa"]
steps = 20
TOML

expect 0 polder element sand.toml
has "$out" "302.2"  # kPa: (k − 1) σ3 at φ 37°
has "$out" "sand-element"
[ "$(wc -l <sand-element/sand_CD_100_kPa.csv)" = 502 ] || fail "a header, the start and 500 steps"
[ "$(wc -l <sand-element/sand_oedometer.csv)" = 42 ] || fail "a header, the start and 2 × 20 steps"
for figure in triaxial-drained_stress triaxial-drained_volume oedometer_compression; do
  [ "$(head -c 4 sand-element/$figure.png | tail -c 3)" = PNG ] || fail "$figure.png"
done

# A folder that holds files is not written into by accident.
expect 2 polder element sand.toml
has "$err" "--force"
expect 0 polder element sand.toml --force --set "material.sand.friction_angle=30 deg"
has "$out" "200"

# Without tests the standard ones are run; a case file will do.
sed '/\[\[test\]\]/,$d' sand.toml >plain.toml
expect 0 polder element plain.toml --out plain
for test in oedometer triaxial-drained triaxial-undrained simple-shear simple-shear-undrained; do
  [ -s "plain/sand_$test.csv" ] || fail "$test"
done
expect 0 polder element dike-seepage --out dike

# Mistakes: all at once, with file, line and remedy, and nothing written.
sed -i 's/type = "oedometer"/type = "odometer"/; s/friction_angle/friction_angel/' sand.toml
expect 2 polder element sand.toml --out wrong
has "$err" "sand.toml:6:"
has "$err" "friction_angle"
has "$err" "sand.toml:15:"
has "$err" "oedometer"
[ ! -e wrong ] || fail "nothing is written"
expect 2 polder element no-such-file.toml
has "$err" "no-such-file.toml"
