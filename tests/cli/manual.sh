# The manual page has its sections, and names every command of the help page.
expect 0 polder --help
commands=$(sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' <<<"$out")
expect 0 polder man
has "$out" ".TH POLDER 1"
for section in NAME SYNOPSIS DESCRIPTION OPTIONS COMMANDS NOTES; do has "$out" $'\n'".SH $section"$'\n'; done
for command in $commands; do has "$out" $'\n'".SS $command"$'\n'; done

if command -v man >/dev/null; then
  polder man >polder.1
  expect 0 man --warnings -l polder.1
  [ -z "$err" ] || fail "man has nothing to complain about"
fi
