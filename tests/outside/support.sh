# For the scripts beside it: a scratch folder, and the words of a stranger who has the package and nothing else.
# shellcheck shell=bash
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
shows() { grep -qF -- "$2" <<<"$1" || fail "no '$2' in: $1"; }
refused() {  # TEXT COMMAND…: exit status 2, and the message has TEXT
  local text=$1 code=0 message
  shift
  message=$("$@" 2>&1) || code=$?
  ((code == 2)) || fail "exit status $code of: $*"
  shows "$message" "$text"
}
# PREFIX: from here on `run` knows nothing of the tree that Presa was built in
use_prefix() { bare=(env -i "PATH=$1/bin:/usr/bin:/bin" "HOME=$work"); }
run() { "${bare[@]}" "$@"; }
