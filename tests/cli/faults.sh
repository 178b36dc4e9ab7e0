# What a computer does to a run: a disk that is full or cannot be written to, a clock that is set, damaged checkpoints.
short=(--until 0.3 --threads 1 --quiet)
hash_of() { grep '"state_hash"' "$1/summary.json"; }
expect 0 polder run dike-seepage --out whole "${short[@]}"

# A wall clock that jumps by hours changes nothing: neither the results nor how often they are written.
LD_PRELOAD=$(dirname "$(command -v polder)")/libjumping_clock.so ASAN_OPTIONS=verify_asan_link_order=0 \
  expect 0 polder run dike-seepage --out clock "${short[@]}"
[ "$(hash_of whole)" = "$(hash_of clock)" ] || fail "the state differs"
cmp whole/history.csv clock/history.csv || fail "history.csv differs"

# A computer that miscalculates: exit status 3 with the reason, the state as it is then beside the last sound checkpoint,
# from which the run goes on to the end that it would have reached.
often=(--set 'output.checkpoint=0.01 s')
LD_PRELOAD=$(dirname "$(command -v polder)")/libwrong_exp.so ASAN_OPTIONS=verify_asan_link_order=0 \
  expect 3 polder run dike-seepage --out wrong "${short[@]}" "${often[@]}"
has "$err" "nan)"
grep -q '"status": "failed"' wrong/summary.json || fail "the summary does not say that the run failed"
for file in failed.h5 checkpoint.h5; do [ -s wrong/$file ] || fail "$file is missing"; done
expect 0 polder run dike-seepage --out wrong "${short[@]}" "${often[@]}" --resume
[ "$(hash_of whole)" = "$(hash_of wrong)" ] || fail "the state differs after a miscalculation"

# Bits that flip anywhere in a checkpoint: refused, and the one before is used.
expect 0 polder run dike-seepage --out bits --until 0.2 --threads 1 --quiet
expect 0 polder run dike-seepage --out bits --until 0.25 --threads 1 --quiet --resume
size=$(stat -c %s bits/checkpoint.h5)
RANDOM=7 # the seed
for _ in 1 2 3 4; do
  cp -r bits flipped
  at=$((RANDOM * RANDOM % size))
  byte=$(od -An -tu1 -j $at -N 1 flipped/checkpoint.h5)
  # shellcheck disable=SC2059
  printf "\\x$(printf %x $((byte ^ (1 << RANDOM % 8))))" |
    dd of=flipped/checkpoint.h5 bs=1 seek=$at conv=notrunc 2>/dev/null
  expect 0 polder run dike-seepage --out flipped "${short[@]}" --resume
  grep -q 'checkpoint refused' flipped/log.txt || fail "bit $at: not refused"
  [ "$(hash_of whole)" = "$(hash_of flipped)" ] || fail "bit $at: the state differs"
  rm -r flipped
done
# Cut off anywhere, likewise.
for share in 0 1 50 99; do
  cp -r bits cut
  truncate -s $((size * share / 100)) cut/checkpoint.h5
  expect 0 polder run dike-seepage --out cut "${short[@]}" --resume
  grep -q 'checkpoint refused' cut/log.txt || fail "$share %: not refused"
  [ "$(hash_of whole)" = "$(hash_of cut)" ] || fail "$share %: the state differs"
  rm -r cut
done

# A small file system that fills up, and one that cannot be written to; for want of rights to mount one, not tested.
mounted=(unshare --user --map-root-user --mount)
"${mounted[@]}" true 2>/dev/null || { [ "$(id -u)" = 0 ] && mounted=(unshare --mount); }
if "${mounted[@]}" bash -c 'mkdir -p disk && mount -t tmpfs none disk' 2>/dev/null; then
  export short_options="${short[*]}"
  expect 4 "${mounted[@]}" bash -c '
    mount -t tmpfs -o size=1500k none disk
    polder run dike-seepage --out disk/run $short_options
    status=$?
    cp disk/run/history.csv after.csv
    exit $status'
  has "$err" "No space left on device"
  [ "$(wc -l <after.csv)" -gt 1 ] || fail "what could be written is gone"
  expect 4 "${mounted[@]}" bash -c '
    mount -t tmpfs -o ro none disk
    polder run dike-seepage --out disk/run $short_options'
  has "$err" "Read-only file system"
  echo "record: fault disk-full 1 0 exit status 4, what was written is kept"
  echo "record: fault folder-read-only 1 0 exit status 4"
fi
echo "record: fault bit-flipped-in-a-checkpoint 4 0 refused, the one before is used"
echo "record: fault checkpoint-cut-off 4 0 refused, the one before is used"
echo "record: fault clock-that-jumps 1 0 the same state and history"
echo "record: fault computer-that-miscalculates 1 0 exit status 3, the state is kept, the checkpoint before is used"
