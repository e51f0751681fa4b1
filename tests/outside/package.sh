#!/usr/bin/env bash
# usage: package.sh BUILD
# Makes the Debian package and unpacks it into BUILD/outside, for plug_in.sh.
set -euo pipefail
build=$1
# shellcheck source=tests/outside/support.sh
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"

cpack --config "$build/CPackConfig.cmake" -B "$work/package" >cpack.log 2>&1 || { cat cpack.log >&2; fail "no package"; }
package=$(ls package/presa_*.deb)
needs=$(dpkg-deb -f "$package" Depends)
for library in libode8 libfcl libopenscenegraph libusb-1.0 libhdf5; do shows "$needs" "$library"; done
rm -rf "$build/outside"
dpkg-deb -x "$package" "$build/outside"
prefix=$build/outside/usr
[[ -s $prefix/share/man/man1/presa-run.1 && -s $prefix/share/bash-completion/completions/presa ]] || fail "no man page, or no completion"

use_prefix "$prefix"
refused "error[E597]: there is a plug-in 'magnet' already" "${bare[@]}" presa new effect magnet
refused "error[E597]: <body> is an element of scenes already" "${bare[@]}" presa new effect body
refused "error[E597]: 'Magnet' cannot be the name of a plug-in" "${bare[@]}" presa new effect Magnet
refused "soft: error[E598]: exists already" "${bare[@]}" sh -c "mkdir soft; presa new effect soft"
# shipped scenes and studies are found
run presa check "$(run presa gallery cube --file)"
shows "$(run presa stability --case mass_ratio --quick --out study)" "none is worse than expected"
