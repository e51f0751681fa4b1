#!/usr/bin/env python3
"""Prints lines and branches that tests ran, for each room. usage: coverage.py SUMMARY.json (of gcovr)"""
import json
import sys


def share(covered, total):
    return f"{100 * covered / total:5.1f} %" if total else "    –  "


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        files = json.load(file)["files"]
    rooms = {}
    for entry in files:
        room = "/".join(entry["filename"].split("/")[:2])
        for key in (room, "all"):
            counts = rooms.setdefault(key, [0, 0, 0, 0])
            for i, name in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
                counts[i] += entry[name]
    print(f"{'room':<32} {'lines':>8} {'':>14} {'branches':>8}")
    for room in sorted(rooms, key=lambda name: (name == "all", name)):
        lines, all_lines, branches, all_branches = rooms[room]
        print(f"{room:<32} {share(lines, all_lines)} of {all_lines:>7}    {share(branches, all_branches)} of {all_branches:>7}")


if __name__ == "__main__":
    main()
