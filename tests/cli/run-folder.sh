# What polder run does with the folder it is given.
short=(--until 0.05 --threads 1 --quiet)
expect 0 polder run dike-seepage --out a "${short[@]}"
for file in summary.json history.csv points.pvd checkpoint.h5 report.html log.txt; do
  [ -s a/$file ] || fail "$file is missing"
done

# A used folder is refused unless one says what to do with it.
expect 2 polder run dike-seepage --out a "${short[@]}"
has "$err" "--resume"
has "$err" "--force"
expect 0 polder run dike-seepage --out a "${short[@]}" --force
expect 0 polder run dike-seepage --out a --until 0.1 --threads 1 --quiet --resume
grep -q '"simulated_time": 0.1' a/summary.json || fail "not resumed to 0.1 s"

# Of a damaged checkpoint the one before is used, and the log says so; of two, none.
printf 'x' | dd of=a/checkpoint.h5 bs=1 seek=5000 conv=notrunc 2>/dev/null
expect 0 polder run dike-seepage --out a --until 0.12 --threads 1 --quiet --resume
grep -q "checksum" a/log.txt || fail "the log does not say that a checkpoint was refused"
printf 'x' | dd of=a/checkpoint.h5 bs=1 seek=5000 conv=notrunc 2>/dev/null
head -c 5000 a/checkpoint.previous.h5 >cut && mv cut a/checkpoint.previous.h5
expect 2 polder run dike-seepage --out a --threads 1 --quiet --resume
has "$err" "checksum"
has "$err" "cut off"

# A checkpoint of another case is refused.
expect 0 polder run dike-seepage --out b "${short[@]}"
expect 2 polder run dike-seepage --out b "${short[@]}" --resume --set 'material.sand.friction_angle=36 deg'
has "$err" "another case"
expect 2 polder run dike-seepage --out nothing --resume --quiet
has "$err" "no checkpoint"

# Two runs in one folder: the second is refused.
polder run dike-seepage --out c --threads 1 --quiet >/dev/null 2>&1 &
for _ in $(seq 100); do [ -e c/history.csv ] && break || sleep 0.1; done
expect 2 polder run dike-seepage --out c --force --quiet
has "$err" "another run"
kill $! && wait $! || true
echo "record: fault two-runs-in-one-folder 1 0 the second is refused"

# Nothing can be written: under a file, and on a disk that is full (a limit on the size of files stands for it).
touch file
expect 4 polder run dike-seepage --out file/results "${short[@]}"
expect 4 bash -c "trap '' XFSZ; ulimit -f 100; exec polder run dike-seepage --out full --until 0.3 --threads 1 --quiet"
[ -s full/history.csv ] || fail "what could be written is gone"

# A wrong case writes nothing.
expect 2 polder run dike-seepage --out d --set material.sand.porosity=1.4 --quiet
[ ! -e d ] || fail "a wrong case made a folder"
