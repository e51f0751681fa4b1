#!/usr/bin/env bash
# The pictures of README and of each scene, from the programs themselves: ./dev pictures, and the tests that compare them.
# usage: draw.sh PROGRAMS OUT NAME…         PROGRAMS: folder of the program presa; OUT: folder for NAME.png
#                                           scenes/NAME: a small picture of a scene; scene_pages: the tops of all their reports
#        draw.sh scene PROGRAMS OUT NAME ARGS…   such a small picture, with further arguments of presa run
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
    scene_pages) size=1770,3250 ;;      # up to 78 pages, 6 beside each other
    *) echo "there is no page '$2'" >&2 && return 2 ;;
  esac
  FONTCONFIG_FILE=$here/fonts.conf timeout 100 chromium --headless --no-sandbox --disable-gpu \
    --disable-dev-shm-usage --disable-quic --no-first-run --disable-background-networking --disable-component-update --disable-sync --hide-scrollbars \
    --force-device-scale-factor=1 --user-data-dir="$scratch/profile" --window-size="$size" \
    --screenshot="$3/$2.png" "file://$(realpath "$1")" >"$scratch/chromium.log" 2>&1 ||
    { cat "$scratch/chromium.log" >&2; return 1; }
}

scene() {  # PROGRAMS OUT NAME ARGS…: at the middle of the hold; where there is none, in the middle of a stroke, or at the end
  local programs=$1 out=$2 name=$3
  local args=("${@:4}")
  case $name in
    balance) args+=(--screenshot-at 13) ;; # the beam has levelled
    chain) args+=(--camera "0.45,-0.65,0.55:0,0,0.4") ;; # between the posts
    friction_torsion | layers | perturbation | texture_*) args+=(--screenshot-at 2) ;;
    material_image) args+=(--screenshot-at 2 --show texture) ;;
    mesh_material) args+=(--screenshot-at 2.2 --show texture) ;; # on the border of the pad
    groove) args+=(--screenshot-at 3.5) ;;
    guide_path) args+=(--screenshot-at 1.17) ;;
    honey | wind) args+=(--screenshot-at 1.7) ;;
    guide_wall) args+=(--screenshot-at 2) ;;
    hand_over | stick_slip) args+=(--screenshot-at 4) ;;
    incline) args+=(--screenshot-at 2) ;; # the ice has slid, the felt has not
    magnet) args+=(--screenshot-at 1.7) ;;
    cog) args+=(--screenshot-at 5) ;;
    peg_in_hole) args+=(--screenshot-at 9.3) ;; # it leans in its hole
    square_peg) args+=(--screenshot-at 9.3 --camera "0.13,-0.19,0.15:0,0,0.03") ;;
    stylus_on_bunny) args+=(--screenshot-at 12) ;;
    probe) args+=(--screenshot-at 9.4 --camera "0.03,-0.26,0.16:0,0,0.03") ;; # on the block and the ball
    ray) args+=(--screenshot-at 9.4 --camera "0.03,-0.17,0.09:0.01,0,0.028") ;; # on the rim of the cup and the rabbit
    moving_wall) args+=(--screenshot-at 0.25) ;;
    knocks) args+=(--screenshot-at 2.92) ;; # on the stone
    pile) args+=(--screenshot-at 3.4) ;;
    plane | stiffness_pair) args+=(--screenshot-at 4.5) ;;
    rate_*) args+=(--screenshot-at 1.6) ;;
    renderer_penalty) args+=(--screenshot-at 3) ;; # on the seam
    stribeck_beside_coulomb) args+=(--screenshot-at 4.3) ;;
    thin_plate) args+=(--screenshot-at 6) ;;
    two_hands | wall) args+=(--screenshot-at 4.2) ;;
    updraught) args+=(--screenshot-at 2.2) ;;
    sounds) args+=(--screenshot-at 2.9) ;; # the second block lies on the floor
    sinking) args+=(--screenshot-at 1 --camera "0.2,-0.25,0.1:0.2,0,-0.005") ;; # the ball in honey: the other falls 20 m
  esac
  mkdir -p "$out/scenes"
  "$programs/presa" run "$config/scenes/$name.xml" --lockstep --quiet --hud off --picture-size 320x180 \
    --screenshot "$out/scenes/$name.png" "${args[@]}"
}

# The four walls of config/cave unfolded: each drawn by a process of its own, all at the same frame.
cave() {  # PROGRAMS OUT
  local presa=$1/presa wall processes=()
  local join=(view --join --bus loopback --domain 177 --walls "$config/cave/cave.xml" --quiet)
  "$presa" run "$config/scenes/cube.xml" --realtime --bus loopback --domain 177 --view none --for 30 --quiet &
  processes+=($!)
  for wall in front left right floor; do
    "$presa" "${join[@]}" --wall "$wall" --view offscreen --for 17 --screenshot "$scratch/$wall.png" --screenshot-at 15 >/dev/null &
    processes+=($!)
  done
  "$presa" "${join[@]}" --head "$config/cave/head.xml" --for 20 >/dev/null &
  wait $! "${processes[@]:1}"
  kill -INT "${processes[0]}"
  wait "${processes[0]}" || (($? == 130)) # stopped by the line above
  ffmpeg -v error -y -i "$scratch/left.png" -i "$scratch/front.png" -i "$scratch/right.png" -i "$scratch/floor.png" -filter_complex \
    '[0][1][2]hstack=inputs=3[row];[3]pad=1920:480:640:0:white[below];[row][below]vstack,scale=1280:640' -frames:v 1 "$2/cave.png"
}

# The top of each scene's report, at a quarter of its size. Frames, so that each page has its own styles.
scene_pages() {  # PROGRAMS OUT
  local file name pages=$scratch/scene_pages.html
  echo '<!doctype html><style>body{margin:0;background:#fff}div{float:left;width:295px;height:250px;overflow:hidden}
    iframe{border:0;width:1180px;height:1000px;transform:scale(.25);transform-origin:0 0}</style>' >"$pages"
  for file in "$config"/scenes/*.xml; do
    name=$(basename "$file" .xml)
    "$1/presa" run "$file" --lockstep --quiet --view none --report "$scratch/$name.html"
    sed -i '/<h2>Rates/,$d' "$scratch/$name.html" # figures that differ from run to run
    echo "<div><iframe scrolling=no src=\"$name.html\"></iframe></div>" >>"$pages"
  done
  page "$pages" scene_pages "$2"
}

draw() {  # PROGRAMS OUT NAME
  local presa=$1/presa
  case $3 in
    pinch_and_lift)
      "$presa" run "$config/scenes/pinch_and_lift.xml" --lockstep --quiet --screenshot "$2/$3.png"
      ;;
    percro_arms)
      "$presa" run "$config/scenes/percro_2006.xml" --lockstep --quiet --hud minimal --picture-size 1280x560 \
        --camera "-0.5,-2.2,0.75:0,0,0.04" --screenshot "$2/$3.png"
      ;;
    field)
      "$presa" run "$config/scenes/peg_in_hole.xml" --lockstep --quiet --hud minimal --for 9.4 --screenshot-at 9.3 \
        --camera "0.07,-0.2,0.09:0,0,0.025" --show field,points --screenshot "$2/$3.png"
      ;;
    cave) cave "$1" "$2" ;;
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
    scene_pages) scene_pages "$1" "$2" ;;
    scenes/*) scene "$1" "$2" "${3#scenes/}" ;;
    *) echo "there is no picture '$3'" >&2 && return 2 ;;
  esac
}

if [[ $1 == page ]]; then
  page "$2" "$3" "$4"
elif [[ $1 == scene ]]; then
  scene "${@:2}"
else
  programs=$1 out=$2
  shift 2
  for name in "$@"; do draw "$programs" "$out" "$name"; done
fi
