#!/usr/bin/env bash
# Two machines and a cable, simulated by network namespaces: a run here, a neighbour at the other end. Prints one
# line per finding of the neighbour; tests/modules/bus_dds/loopback_test.cpp reads them. Exit status 77: no permission
# to make namespaces or set their routes.
# usage: two_hosts.sh PRESA SCENE NETWORK
set -euo pipefail
presa=$1 scene=$2 network=$3

if [[ -z ${PRESA_INSIDE:-} ]]; then
  map=()
  ((EUID == 0)) || map=(--map-root-user)
  unshare "${map[@]}" --net true 2>/dev/null || exit 77
  PRESA_INSIDE=1 exec unshare "${map[@]}" --net bash "$0" "$@"
fi

ip link set lo up
ip link add here type veth peer name there 2>/dev/null || exit 77
unshare --net sleep 120 &
other=$!
# no pause: Cyclone DDS ends with packets to itself, and the cable vanishes with the other end
trap 'kill -KILL $run $other 2>/dev/null || true' EXIT
run=$other
until [[ $(readlink /proc/$other/ns/net) != "$(readlink /proc/self/ns/net)" ]]; do sleep 0.01; done
ip link set there netns $other
ip address add 10.9.8.1/24 dev here
ip link set here up
at_other() { nsenter --target $other --net "$@"; }
at_other ip address add 10.9.8.2/24 dev there
at_other ip link set there up
# worst case: this machine accepts 127.0.0.1 from outside, and the neighbour sends there
echo 1 2>/dev/null >/proc/sys/net/ipv4/conf/here/route_localnet || exit 77
# the neighbour accepts replies from there, so that a refusal is received
at_other bash -c 'set -e; for name in all there; do echo 1 >/proc/sys/net/ipv4/conf/$name/route_localnet; echo 0 >/proc/sys/net/ipv4/conf/$name/rp_filter; done' 2>/dev/null || exit 77
at_other ip route add 127.0.0.1/32 via 10.9.8.1 dev there

"$presa" run "$scene" --lockstep --speed 0.01 --for 4 --quiet --bus "$network" &
run=$!
for ((i = 0; i < 600; ++i)); do
  ! ss -Hlun | grep -q ':7410 ' || break
  kill -0 $run
  sleep 0.05
done
ss -Hlun | awk '{print "listens " $4}'

# connected sockets learn that nobody listens at the second packet at the latest, after the reply to the first
probe() {
  at_other bash -c 'exec 3<>"/dev/udp/$1/$2"; for i in 1 2 3 4; do printf x >&3 || { echo "$1:$2 refused"; exit; }; sleep 0.1; done
    echo "$1:$2 open"' probe "$1" "$2" 2>/dev/null
}
for address in 10.9.8.1 127.0.0.1; do
  for port in 7410 7411; do probe $address $port; done
done
