# verify: the list, a table with its verdicts, JSON, a page, and an error that is caught.
expect 0 polder verify --list
has "$out" "hydrostatic-jump"

expect 0 polder verify hydrostatic triaxial-drained --json rows.json --report page
has "$out" "2 of 2 problems within their tolerances"
has "$(cat rows.json)" '"problem": "hydrostatic"'
has "$(cat rows.json)" '"pass": true'
has "$(cat page/index.html)" "<svg"

expect 1 polder verify hydrostatic --set model.gravity=10.3
has "$out" "OUT"
has "$out" "0 of 1 problems"

expect 2 polder verify hydrostatc
has "$err" "did you mean 'hydrostatic'?"
