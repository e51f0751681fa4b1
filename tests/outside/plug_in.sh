#!/usr/bin/env bash
# usage: plug_in.sh BUILD KIND
# What a stranger does with the unpacked package (package.sh): writes a plug-in of that kind in an empty folder with `presa new`, builds it
# against the package alone, runs its tests, and feels it in a scene.
set -euo pipefail
build=$1 kind=$2
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=tests/outside/support.sh
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"
cp -r "$build/outside/usr" prefix
prefix=$work/prefix
use_prefix "$prefix"

project() {  # NAME: its tests pass; the current folder becomes its own
  run presa new "$kind" "$1"
  cd "$1"
  run cmake -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >cmake.log || fail "$(cat cmake.log)"
  run cmake --build build -j 2
  run ctest --test-dir build --output-on-failure --no-tests=error
  found=("${bare[@]}" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa")
}

# the page that leads to a first effect, word for word
page() { /usr/bin/python3 "$source_tree/tests/docs/page.py" "$source_tree/docs/plugins.md" "$build" --installed "$prefix"; }

effect() {
  project soft_pull
  refused "scene/lift.xml:16:5: error[E111]: unknown element <soft_pull>" "${bare[@]}" presa check scene/lift.xml
  refused "PRESA_PLUGIN_PATH" "${bare[@]}" presa check scene/lift.xml
  shows "$("${found[@]}" presa explain scene/lift.xml)" "force effect <soft_pull> of body 'cube'"
  shows "$("${found[@]}" presa plugins)" "soft_pull 0.1.0 (force effect), $PWD/build/lib/presa"
  "${found[@]}" presa run scene/lift.xml --lockstep --quiet --summary with.json
  run presa run "$prefix/share/presa/config/scenes/cube.xml" --lockstep --quiet --summary without.json
  [[ $(grep hash with.json) != "$(grep hash without.json)" ]] || fail "the effect changed nothing"
  # built against the headers of another Presa it is refused, before any of its code runs; building it again is enough
  interface=$prefix/lib/cmake/Presa/plugin_interface.cpp
  cp "$interface" interface.kept
  sed -i 's/(interface [0-9a-f]*)/(interface 0123456789ab)/' "$interface"
  run cmake --build build >/dev/null
  refused "error[E510]: built for Presa 0.1.0 (interface 0123456789ab), this program is Presa" "${found[@]}" presa run scene/lift.xml --lockstep --quiet
  cp interface.kept "$interface"
  run cmake --build build >/dev/null
  "${found[@]}" presa run scene/lift.xml --lockstep --quiet
  # in the prefix it is found without a variable
  run cmake --install build --prefix "$prefix" >/dev/null
  shows "$(run presa check scene/lift.xml)" "scene/lift.xml: good"
}

friction() {
  project slick
  shows "$("${found[@]}" presa explain scene/lift.xml)" "friction: friction_cone, slick"
  refused "scene/lift.xml:8:117: error[E111]: unknown element <slick>" "${bare[@]}" presa check scene/lift.xml
}

body() {
  project float_up
  shows "$("${found[@]}" presa explain scene/lift.xml)" "body effect <float_up> of body 'cube'"
  shows "$("${found[@]}" presa plugins)" "float_up 0.1.0 (body effect), $PWD/build/lib/presa"
  refused "scene/lift.xml:16:5: error[E111]: unknown element <float_up>" "${bare[@]}" presa check scene/lift.xml
}

surface() {
  project ripples
  shows "$("${found[@]}" presa explain scene/lift.xml)" "ripples of 0.05 mm"
  refused "scene/lift.xml:16:5: error[E111]: unknown element <ripples>" "${bare[@]}" presa check scene/lift.xml
}

renderer() {
  project small_proxy
  shows "$("${found[@]}" presa explain scene/lift.xml)" "move the proxy in up to 16 legs (small_proxy)"
  refused "scene/lift.xml:7:12: error[E116]" "${bare[@]}" presa check scene/lift.xml
}

tool_renderer() {
  project ball_tool
  shows "$("${found[@]}" presa explain scene/press.xml)" "hold tools off the bodies as balls (ball_tool)"
  shows "$("${found[@]}" presa plugins)" "ball_tool 0.1.0 (tool renderer), $PWD/build/lib/presa"
  refused "scene/press.xml:5:12: error[E116]" "${bare[@]}" presa check scene/press.xml
}

device() {
  project fingertip
  shows "$("${found[@]}" presa explain scene/lift.xml)" "presa_fingertip.so"
  refused "E590" "${bare[@]}" presa check scene/lift.xml
  shows "$("${found[@]}" presa device list)" "fingertip: simulated fingertip that lifts a cube"
  sed -i 's/key="finger"/key="fingr"/' scene/rig.xml
  refused "driver 'fingertip' has no setting 'fingr'" "${found[@]}" presa check scene/lift.xml
}

metric() {
  project force_jump
  refused "did you mean 'force_jump'?" "${bare[@]}" presa cost scene/lift.xml --metric force_jmp --allow-plugins build/lib/presa
  run presa cost scene/lift.xml --metric force_jump --quick --out study --allow-plugins build/lib/presa >cost.log 2>&1 || fail "$(tail -5 cost.log)"
  shows "$(cat study/*.csv)" "force_jump_N"
}

view() {
  project drop_lines
  shows "$(run presa explain scene/lift.xml --view offscreen --allow-plugins build/lib/presa)" "drop a line from each fingertip"
}

module() {
  project height_watch
  # a library beside a scene is found, but runs only if the user says so
  refused "plug-in 'height_watch' in build/lib/presa brings it: --allow-plugins build/lib/presa" "${bare[@]}" presa check scene/lift.xml
  shows "$(run presa explain scene/lift.xml --allow-plugins build/lib/presa)" "height_watch"
  shows "$(run presa run scene/lift.xml --lockstep --allow-plugins build/lib/presa)" "cube was above 0.05 m for"
}

experiment() {
  project jittered
  shows "$("${found[@]}" presa plugins)" "jittered 0.1.0 (method), $PWD/build/lib/presa"
  shows "$("${found[@]}" presa experiment dry-run scene/experiment.xml)" "40 at most"
  refused "scene/experiment.xml:7:5: error[E111]: unknown element <jittered>" "${bare[@]}" presa experiment dry-run scene/experiment.xml
  "${found[@]}" presa experiment run scene/experiment.xml --subject S01 --data data --lockstep --no-recording >/dev/null
}

"$kind"
