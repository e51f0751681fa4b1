#!/usr/bin/env python3
"""Prints the processor times in a file of `./dev bench --json`, beside their lower bounds where there are any."""
import json
import sys


def measured(file):
    """The benchmarks in the file by name, those that report a median and had no error."""
    with open(file, encoding="utf-8") as text:
        benchmarks = json.load(text)["benchmarks"]
    return {b["name"]: b for b in benchmarks if "p50_us" in b and not b.get("error_occurred")}


def figure(benchmark):
    """Its processor time [us]: the median."""
    # the collision thread works in bursts: of both threads only the mean says what a millisecond costs
    return benchmark["mean_us" if benchmark["name"].startswith("both_threads/") else "p50_us"]


def bound_of(name, times):
    """The lower bound [us] of this benchmark among the times of the same run, or None."""
    parts = name.split("/")
    if parts[0] not in ("proxy_tick", "both_threads") or len(parts) < 3:
        return None
    bound = times.get("/".join(["bound"] + parts[1:3]))
    return bound and bound * (2 if parts[-1] == "two_fingers" else 1)


def main(file):
    found = measured(file)
    if not found:
        return
    times = {name: figure(benchmark) for name, benchmark in found.items()}
    width = max(map(len, found))
    print(f"{'processor time in us':{width}} {'presa':>12} {'bound':>9} {'ratio':>7}")
    for name, benchmark in found.items():
        if name.startswith("bound/"):
            continue
        bound = bound_of(name, times)
        row = f"{name:{width}} {times[name]:12.2f}"
        row += f" {bound:9.2f} {times[name] / bound:7.1f}" if bound else ""
        for share in ("touching", "slipping"):
            if benchmark.get(share, 1) < 0.99:
                row += f"  ({share} in only {benchmark[share]:.0%} of the ticks)"
        print(row)


if __name__ == "__main__":
    main(sys.argv[1])
