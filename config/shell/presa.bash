# Completion of `presa` in bash: commands and options come from its own --help, so that they never differ from the program.
_presa() {
  local current=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command=() word help names
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == -* || $word == */* || $word == *.* ]] && break
    command+=("$word")
  done
  help=$("$program" "${command[@]}" --help 2>/dev/null) || return 0
  if [[ $current == -* ]]; then
    names=$(grep -oE '^ +(-[a-z],)?--[a-z-]+' <<<"$help" | grep -oE -- '--[a-z-]+')
  else
    names=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' <<<"$help")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$names" -- "$current")
}
complete -o default -o bashdefault -F _presa presa
