#!/usr/bin/env bash
# usage: effect_from_package.sh BUILD
# Makes the Debian package, unpacks it in an empty folder, writes a new effect there with `presa new`, builds it against the package
# alone, runs its tests, and feels it in a scene.
set -euo pipefail
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }
shows() { grep -qF "$2" <<<"$1" || fail "no '$2' in: $1"; }

cpack --config "$build/CPackConfig.cmake" -B "$work/package" >cpack.log 2>&1 || { cat cpack.log >&2; fail "no package"; }
package=$(ls package/presa_*.deb)
needs=$(dpkg-deb -f "$package" Depends)
for library in libode8 libfcl libopenscenegraph libusb-1.0 libhdf5; do shows "$needs" "$library"; done
dpkg-deb -x "$package" root
prefix=$work/root/usr

# nothing of the tree that Presa was built in
bare=(env -i "PATH=$prefix/bin:/usr/bin:/bin" "HOME=$work")
"${bare[@]}" presa new effect soft_pull
cd soft_pull
code=0
refusal=$("${bare[@]}" presa check scene/lift.xml 2>&1) || code=$?
((code == 2)) || fail "presa check took an element whose plug-in is missing"
shows "$refusal" "scene/lift.xml:16:5: error[E111]: unknown element <soft_pull>"
shows "$refusal" "PRESA_PLUGIN_PATH"

"${bare[@]}" cmake -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >cmake.log || fail "$(cat cmake.log)"
"${bare[@]}" cmake --build build -j 2
"${bare[@]}" ctest --test-dir build --output-on-failure --no-tests=error

bare+=("PRESA_PLUGIN_PATH=$PWD/build/lib/presa")
shows "$("${bare[@]}" presa explain scene/lift.xml)" "force effect <soft_pull> of body 'cube'"
shows "$("${bare[@]}" presa plugins)" "soft_pull (force effect), $PWD/build/lib/presa"
"${bare[@]}" presa run scene/lift.xml --lockstep --quiet --summary with.json
"${bare[@]}" presa run "$prefix/share/presa/config/scenes/cube.xml" --lockstep --quiet --summary without.json
[[ $(grep hash with.json) != "$(grep hash without.json)" ]] || fail "the effect changed nothing"

# in the prefix it is found without a variable
"${bare[@]}" cmake --install build --prefix "$prefix" >/dev/null
shows "$(env -i "PATH=$prefix/bin:/usr/bin:/bin" presa check scene/lift.xml)" "scene/lift.xml: good"
