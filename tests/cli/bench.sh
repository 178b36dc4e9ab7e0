# bench: a block in both spaces, a case, JSON, and what is refused.
expect 0 polder bench --points 400 1600 --steps 3 --json speed.json
has "$out" "plane strain"
has "$out" "3d"
has "$out" "memory grows by"
has "$(cat speed.json)" '"soil_points": 400'
has "$(cat speed.json)" '"points_to_grid"'

expect 0 polder bench hydrostatic --steps 5 --threads 2
has "$out" "hydrostatic"

expect 2 polder bench hydrostatic --set stage.rest.duration=0.001 --steps 5
has "$err" "give fewer --steps"
expect 2 polder bench --space 4d
expect 2 polder bench no-such-case
