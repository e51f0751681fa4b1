#!/usr/bin/env python3
"""Prints the processor times in a file of `./dev bench --json`, beside their lower bounds where there are any."""
import json
import sys


def figure(benchmark):
    # the collision thread works in bursts: of both threads only the mean says what a millisecond costs
    return benchmark["mean_us" if benchmark["name"].startswith("both_threads/") else "p50_us"]


def bound_of(name, found):
    parts = name.split("/")
    if parts[0] not in ("proxy_tick", "both_threads") or len(parts) < 3:
        return None
    bound = found.get("/".join(["bound"] + parts[1:3]))
    return bound and figure(bound) * (2 if parts[-1] == "two_fingers" else 1)


def main(file):
    with open(file, encoding="utf-8") as text:
        benchmarks = json.load(text)["benchmarks"]
    found = {b["name"]: b for b in benchmarks if "p50_us" in b and not b.get("error_occurred")}
    if not found:
        return
    width = max(map(len, found))
    print(f"{'processor time in us':{width}} {'presa':>12} {'bound':>9} {'ratio':>7}")
    for name, benchmark in found.items():
        if name.startswith("bound/"):
            continue
        bound = bound_of(name, found)
        row = f"{name:{width}} {figure(benchmark):12.2f}"
        row += f" {bound:9.2f} {figure(benchmark) / bound:7.1f}" if bound else ""
        for share in ("touching", "slipping"):
            if benchmark.get(share, 1) < 0.99:
                row += f"  ({share} in only {benchmark[share]:.0%} of the ticks)"
        print(row)


main(sys.argv[1])
