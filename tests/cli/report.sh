# A report comes from the folder of a run; what is wrong with a folder is said with its name, and nothing is written.
expect 2 polder report nowhere
has "$err" "nowhere: there is no such folder; give the --out of a run"

mkdir empty
expect 2 polder report empty
has "$err" "empty: there is neither summary.json nor history.csv: no run wrote here"
expect 2 polder report empty --figures
has "$err" "empty/points.pvd: no snapshots to draw"
expect 2 polder report empty --figures --times 2,soon
has "$err" "--times: 'soon' is no time; give seconds"
expect 2 polder report empty --times 2
has "$err" "--times requires --figures"
[ -z "$(ls empty)" ] || fail "something was written"

mkdir run
printf 'time [s],crest [m]\n0,1\n0.5,0.9\n' >run/history.csv
printf '{"status": "finished", "reason": "the last stage ended"}\n' >run/summary.json
expect 0 polder report run
has "$out" "run/report.html"
has "$(cat run/report.html)" "the last stage ended"

# A run that has ended is not waited for.
expect 0 timeout 20 polder report run --watch

# A page that cannot be written is status 4, and the old one stays. Root may write anywhere, so the place is taken.
cp run/report.html before
mkdir run/.report.html.partial
expect 4 polder report run
has "$err" "run/report.html: Is a directory"
cmp run/report.html before
