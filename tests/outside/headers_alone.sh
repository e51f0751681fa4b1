#!/usr/bin/env bash
# usage: headers_alone.sh SOURCE BUILD
# Each installed header compiles when it is the only one included. The build has shown it for a header that is the first
# include of the .cpp file beside it; the others are compiled here.
set -euo pipefail
source=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work" >/dev/null
cd "$work/include/presa"
flags=$(pkg-config --cflags eigen3)
alone() {  # HEADER
  g++ -std=c++20 -Wall -Wextra -Werror -fsyntax-only -x c++ -I. $flags - <<<"#include \"$1\"" && echo "$1"
}
export -f alone
export flags
mapfile -t headers < <(find . -name '*.h' -printf '%P\n' | sort)
((${#headers[@]} > 50)) || { echo "FAILED: only ${#headers[@]} headers are installed" >&2; exit 1; }
rest=()
for header in "${headers[@]}"; do
  beside=$source/${header%.h}.cpp
  [[ -f $beside && $(grep -m1 '^#include' "$beside") == "#include \"$header\"" ]] || rest+=("$header")
done
printf '%s\n' "${rest[@]}" | xargs -P 2 -I{} bash -c 'alone {}' | wc -l | {
  read -r good
  echo "${#headers[@]} headers: $good of the ${#rest[@]} that stand alone in no source file compile alone"
  ((good == ${#rest[@]}))
}
