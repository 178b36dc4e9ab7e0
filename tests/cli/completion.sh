# Completion in bash knows the commands, their options, and files.
source <(polder completion bash)

complete_line() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _polder
  out=" ${COMPREPLY[*]} " err=
}

complete_line polder ""
has "$out" " completion "
has "$out" " --version "
complete_line polder comp
[ "$out" = " completion " ] || fail "one command begins with 'comp'"
complete_line polder completion --h
[ "$out" = " --help " ] || fail "one option begins with '--h'"
touch my-dike.toml
complete_line polder completion my-
[ "$out" = " my-dike.toml " ] || fail "a file is completed"

# In zsh, where there is one, the script is at least free of mistakes of syntax.
if command -v zsh >/dev/null; then expect 0 zsh -n <(polder completion zsh); fi
