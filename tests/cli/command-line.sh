# Help and version go to stdout with status 0; what is wrong goes to stderr with status 2 and a way on.
expect 0 polder --help
has "$out" "Usage: polder [OPTIONS] COMMAND"
has "$out" "Examples:"
[ -z "$err" ] || fail "help is not an error"

expect 0 polder --version
[[ $out =~ ^polder\ [0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "version"

expect 2 polder
has "$out" "Usage: polder"

expect 2 polder no-such-command
has "$err" "polder: unknown command 'no-such-command'"
has "$err" "'polder --help' says what is expected"
[ -z "$out" ] || fail "errors go to stderr"

expect 2 polder completin
has "$err" "unknown command 'completin'; did you mean 'completion'?"

expect 2 polder completion fish
has "$err" "polder completion --help"

# Every command that is listed has a help page with an example of itself.
expect 0 polder --help
commands=$(sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' <<<"$out")
has "$commands" completion
for command in $commands; do
  expect 0 polder "$command" --help
  has "$out" "polder $command"
  has "$out" "Examples:"
done
