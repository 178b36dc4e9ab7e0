# Twenty interruptions at random moments, each followed by --resume: what is left equals the run that was not disturbed.
RANDOM=20261124 # the seed
options=(--until 5 --threads 1 --quiet --set 'output.checkpoint=0.05 s')
expect 0 polder run dike-seepage --out whole "${options[@]}"

signals=(INT TERM KILL)
interruptions=0
while [ $interruptions -lt 20 ]; do
  signal=${signals[$((interruptions % 3))]}
  how=--force # killed before there was anything to resume from
  [ ! -e parts/checkpoint.h5 ] || how=--resume
  rm -f parts/log.txt
  polder run dike-seepage --out parts "${options[@]}" $how >/dev/null 2>&1 &
  # a shell's background job ignores SIGINT until the program listens: it does once it has a log
  for _ in $(seq 600); do [ ! -e parts/log.txt ] || break; sleep 0.05; done
  sleep 0.$((RANDOM % 4 + 1))$((RANDOM % 10))
  kill -$signal $! 2>/dev/null || true
  status=0
  wait $! || status=$?
  case $signal in
    KILL) [ $status = 137 ] || [ $status = 0 ] || fail "killed, status $status" ;;
    # 143: it came before the program listened
    *) [ $status = 130 ] || [ $status = 143 ] || [ $status = 0 ] || fail "$signal, status $status" ;;
  esac
  [ $status != 0 ] || break # it was faster than the signal
  interruptions=$((interruptions + 1))
  # whatever moment it was, what lies in the folder can be read
  [ ! -e parts/history.csv ] || expect 0 polder report parts
done
echo "$interruptions interruptions"
[ $interruptions -ge 5 ] || fail "the run ended too soon to be interrupted"
if ! grep -q '"status": "finished"' parts/summary.json 2>/dev/null; then
  expect 0 polder run dike-seepage --out parts "${options[@]}" --resume
fi

hash_of() { grep '"state_hash"' "$1/summary.json"; }
[ "$(hash_of whole)" = "$(hash_of parts)" ] || fail "the state differs: $(hash_of whole) $(hash_of parts)"
cmp whole/history.csv parts/history.csv || fail "history.csv differs"
cmp whole/points.pvd parts/points.pvd || fail "points.pvd differs"
for file in whole/points/*.vtp; do cmp "$file" "parts/points/${file##*/}" || fail "$file differs"; done
[ "$(ls whole/points)" = "$(ls parts/points)" ] || fail "other snapshots"
echo "record: kill showcase-interrupted $interruptions 0 by SIGINT, SIGTERM and SIGKILL in turn"
