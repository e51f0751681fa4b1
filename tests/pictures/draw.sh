#!/usr/bin/env bash
# The pictures of README, from the programs themselves: ./dev pictures, and the test that compares them.
# usage: draw.sh PROGRAMS OUT NAME…         PROGRAMS: folder of the program presa; OUT: folder for NAME.png
#        draw.sh page PAGE.html NAME OUT    the picture of a page that is there already, of the size that NAME has
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
config=$here/../../config
scratch=$(mktemp -d -t presa-pictures.XXXXXX)
trap 'rm -rf "$scratch"' EXIT

page() {  # PAGE NAME OUT: the top of a page, in light colours
  local size
  case $2 in
    cube_report) size=1180,1310 ;;      # to the time axis of the first finger
    stability_report) size=1280,1240 ;; # verdict and the first cases
    *) echo "there is no page '$2'" >&2 && return 2 ;;
  esac
  FONTCONFIG_FILE=$here/fonts.conf timeout 100 chromium --headless --no-sandbox --disable-gpu \
    --disable-dev-shm-usage --disable-quic --no-first-run --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars \
    --force-device-scale-factor=1 --user-data-dir="$scratch/profile" --window-size="$size" \
    --screenshot="$3/$2.png" "file://$(realpath "$1")" >"$scratch/chromium.log" 2>&1 ||
    { cat "$scratch/chromium.log" >&2; return 1; }
}

draw() {  # PROGRAMS OUT NAME
  local presa=$1/presa
  case $3 in
    pinch_and_lift)
      "$presa" run "$config/scenes/pinch_and_lift.xml" --lockstep --quiet --screenshot "$2/$3.png"
      ;;
    temple_column)
      # status 1: the capital is not in its place yet
      "$presa" temple --auto --lockstep --seed 7 --for 59.9 --screenshot "$2/$3.png" >"$scratch/log" 2>&1 ||
        (($? == 1)) || { cat "$scratch/log" >&2; return 1; }
      ;;
    cube_report)
      "$presa" run "$config/scenes/cube.xml" --lockstep --quiet --report "$scratch/cube.html"
      page "$scratch/cube.html" "$3" "$2"
      ;;
    stability_report)
      "$presa" stability --out "$scratch/stability" >"$scratch/log" || { tail -n 3 "$scratch/log" >&2; return 1; }
      page "$scratch/stability/report.html" "$3" "$2"
      python3 "$here/stability_counts.py" "$scratch/stability/rows.jsonl" "$2/$3.tsv"
      ;;
    *) echo "there is no picture '$3'" >&2 && return 2 ;;
  esac
}

if [[ $1 == page ]]; then
  page "$2" "$3" "$4"
else
  programs=$1 out=$2
  shift 2
  for name in "$@"; do draw "$programs" "$out" "$name"; done
fi
