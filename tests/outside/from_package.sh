#!/usr/bin/env bash
# usage: from_package.sh BUILD
# What a stranger does: makes the Debian package, unpacks it in an empty folder, writes plug-ins there with `presa new`, builds them against
# the package alone, runs their tests, and feels them in a scene.
set -euo pipefail
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
shows() { grep -qF -- "$2" <<<"$1" || fail "no '$2' in: $1"; }
refused() {  # TEXT COMMAND…: exit status 2, and the message has TEXT
  local text=$1 code=0 message
  shift
  message=$("$@" 2>&1) || code=$?
  ((code == 2)) || fail "exit status $code of: $*"
  shows "$message" "$text"
}

cpack --config "$build/CPackConfig.cmake" -B "$work/package" >cpack.log 2>&1 || { cat cpack.log >&2; fail "no package"; }
package=$(ls package/presa_*.deb)
needs=$(dpkg-deb -f "$package" Depends)
for library in libode8 libfcl libopenscenegraph libusb-1.0 libhdf5; do shows "$needs" "$library"; done
dpkg-deb -x "$package" root
prefix=$work/root/usr

# nothing of the tree that Presa was built in
bare=(env -i "PATH=$prefix/bin:/usr/bin:/bin" "HOME=$work")
run() { "${bare[@]}" "$@"; }

project() {  # KIND NAME: its tests pass; the current folder becomes its own
  cd "$work"
  run presa new "$1" "$2"
  cd "$2"
  run cmake -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >cmake.log || fail "$(cat cmake.log)"
  run cmake --build build -j 2
  run ctest --test-dir build --output-on-failure --no-tests=error
}

[[ -s $prefix/share/man/man1/presa-run.1 && -s $prefix/share/bash-completion/completions/presa ]] || fail "no man page, or no completion"

project effect soft_pull
refused "scene/lift.xml:16:5: error[E111]: unknown element <soft_pull>" "${bare[@]}" presa check scene/lift.xml
refused "PRESA_PLUGIN_PATH" "${bare[@]}" presa check scene/lift.xml
found=("${bare[@]}" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa")
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

project friction slick
shows "$(env -i "PATH=$prefix/bin:/usr/bin:/bin" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa" presa explain scene/lift.xml)" "friction: friction_cone, slick"
refused "scene/lift.xml:8:117: error[E111]: unknown element <slick>" "${bare[@]}" presa check scene/lift.xml

project body float_up
found=("${bare[@]}" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa")
shows "$("${found[@]}" presa explain scene/lift.xml)" "body effect <float_up> of body 'cube'"
shows "$("${found[@]}" presa plugins)" "float_up 0.1.0 (body effect), $PWD/build/lib/presa"
refused "scene/lift.xml:16:5: error[E111]: unknown element <float_up>" "${bare[@]}" presa check scene/lift.xml

project surface ripples
shows "$(env -i "PATH=$prefix/bin:/usr/bin:/bin" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa" presa explain scene/lift.xml)" "ripples of 0.05 mm"
refused "scene/lift.xml:16:5: error[E111]: unknown element <ripples>" "${bare[@]}" presa check scene/lift.xml

project renderer small_proxy
shows "$(env -i "PATH=$prefix/bin:/usr/bin:/bin" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa" presa explain scene/lift.xml)" "move the proxy in up to 16 legs (small_proxy)"
refused "scene/lift.xml:7:12: error[E116]" "${bare[@]}" presa check scene/lift.xml

project device fingertip
shows "$(env -i "PATH=$prefix/bin:/usr/bin:/bin" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa" presa explain scene/lift.xml)" "presa_fingertip.so"
refused "E590" "${bare[@]}" presa check scene/lift.xml
shows "$(env -i "PATH=$prefix/bin:/usr/bin:/bin" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa" presa device list)" "fingertip: simulated fingertip that lifts a cube"
sed -i 's/key="finger"/key="fingr"/' scene/rig.xml
refused "driver 'fingertip' has no setting 'fingr'" env -i "PATH=$prefix/bin:/usr/bin:/bin" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa" presa check scene/lift.xml

project metric force_jump
refused "did you mean 'force_jump'?" "${bare[@]}" presa cost scene/lift.xml --metric force_jmp --allow-plugins build/lib/presa
run presa cost scene/lift.xml --metric force_jump --quick --out study --allow-plugins build/lib/presa >cost.log 2>&1 || fail "$(tail -5 cost.log)"
shows "$(cat study/*.csv)" "force_jump_N"

project view drop_lines
shows "$(run presa explain scene/lift.xml --view offscreen --allow-plugins build/lib/presa)" "drop a line from each fingertip"

project module height_watch
# a library beside a scene is found, but runs only if the user says so
refused "plug-in 'height_watch' in build/lib/presa brings it: --allow-plugins build/lib/presa" "${bare[@]}" presa check scene/lift.xml
shows "$(run presa explain scene/lift.xml --allow-plugins build/lib/presa)" "height_watch"
shows "$(run presa run scene/lift.xml --lockstep --allow-plugins build/lib/presa)" "cube was above 0.05 m for"

project experiment jittered
found=("${bare[@]}" "PRESA_PLUGIN_PATH=$PWD/build/lib/presa")
shows "$("${found[@]}" presa plugins)" "jittered 0.1.0 (method), $PWD/build/lib/presa"
shows "$("${found[@]}" presa experiment dry-run scene/experiment.xml)" "40 at most"
refused "scene/experiment.xml:7:5: error[E111]: unknown element <jittered>" "${bare[@]}" presa experiment dry-run scene/experiment.xml
"${found[@]}" presa experiment run scene/experiment.xml --subject S01 --data data --lockstep --no-recording >/dev/null

cd "$work"
refused "error[E597]: there is a plug-in 'magnet' already" "${bare[@]}" presa new effect magnet
refused "error[E597]: <body> is an element of scenes already" "${bare[@]}" presa new effect body
refused "error[E597]: 'Magnet' cannot be the name of a plug-in" "${bare[@]}" presa new effect Magnet
refused "soft: error[E598]: exists already" "${bare[@]}" sh -c "mkdir soft; presa new effect soft"
