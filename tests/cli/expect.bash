# What the scripts of this folder have at hand.

# expect STATUS COMMAND...: runs it; `out` and `err` hold what it printed.
expect() {
  local wanted=$1 status=0
  shift
  "$@" >expect.out 2>expect.err </dev/null || status=$?
  out=$(cat expect.out) err=$(cat expect.err)
  rm expect.out expect.err
  [ "$status" = "$wanted" ] || fail "exit status of '$*' is $status, not $wanted"
}

# has TEXT PART: the text contains the part.
has() { [[ $1 == *"$2"* ]] || fail "'$2' is missing"; }

fail() {
  printf '%s\n--- stdout\n%s\n--- stderr\n%s\n' "$1" "${out-}" "${err-}"
  exit 1
}
