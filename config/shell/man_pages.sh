#!/usr/bin/env bash
# usage: man_pages.sh PRESA FOLDER VERSION
# Writes presa.1 and a page for every command (presa-run.1) into FOLDER, from what the program PRESA says of itself with --help.
set -euo pipefail
presa=$1 folder=$2 version=$3
mkdir -p "$folder"

commands_in() { sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' <<<"$1"; }

page() {  # WORD…: of one command, and of those below it
  local name help summary inner file command
  name=$(IFS=-; echo "presa${*:+-$*}")
  help=$("$presa" "$@" --help)
  summary=$(sed -n '1p' <<<"$help")
  file=$folder/$name.1
  {
    printf '.TH "%s" 1 "" "Presa %s" "Presa"\n' "${name^^}" "$version"
    printf '.SH NAME\n%s \\- %s\n' "$name" "${summary//\\/\\\\}"
    printf '.SH SYNOPSIS\n%s\n' "$(sed -n 's/^Usage: //p' <<<"$help")"
    printf '.SH DESCRIPTION\n.nf\n'
    # a line that begins with a dot or a quote would be a request of the formatter
    sed -e '1d' -e '/^Usage: /d' -e 's/\\/\\\\/g' -e 's/-/\\-/g' -e "s/^\\([.']\\)/\\\\\\&\\1/" <<<"$help"
    printf '.fi\n'
  } >"$file"
  inner=$(commands_in "$help")
  for command in $inner; do page "$@" "$command"; done
}

page
