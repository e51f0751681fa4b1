#!/usr/bin/env python3
"""Runs CTest and shows a line for each test folder, the time left, what failed, and the ten slowest tests.

usage: progress.py LOG CTEST_ARGUMENT...
All that CTest prints goes to LOG. Exit status: CTest's.
"""
import json
import re
import subprocess
import sys
import time

CLEAR = "\r\x1b[K"  # a status line
# the verdict follows the last dots of the line, because a name may contain dots, too
DONE = re.compile(r"^\s*(\d+)/(\d+) Test\s+#(\d+): (\S.*?)\s*\.*\.{2}\s*(\**[A-Z][^.]*?)\s+([\d.]+) sec")


class Folder:
    def __init__(self):
        self.left = self.passed = self.failed = self.skipped = 0
        self.seconds = 0.0


def plan(arguments):
    """The tests that will run: name -> folder."""
    shown = subprocess.run(["ctest", *arguments, "--show-only=json-v1"], capture_output=True, text=True, check=False)
    tests = {}
    for test in json.loads(shown.stdout or '{"tests": []}')["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        if not properties.get("DISABLED", False):
            tests[test["name"]] = properties.get("LABELS", ["others"])[0]
    return tests


def costs(build):
    """Seconds of each test in the last run, from CTest's own notes."""
    known = {}
    try:
        with open(f"{build}/Testing/Temporary/CTestCostData.txt", encoding="utf-8") as file:
            for line in file:
                words = line.rsplit(" ", 2)
                # a test's name with a blank confuses CTest, which then notes any number
                if len(words) == 3 and float(words[2]) < 3600:
                    known[words[0]] = float(words[2])
    except (OSError, ValueError):
        pass
    return known


def main():
    log, arguments = sys.argv[1], sys.argv[2:]
    build = arguments[arguments.index("--test-dir") + 1]
    jobs = int(arguments[arguments.index("-j") + 1]) if "-j" in arguments else 1
    tests, known = plan(arguments), costs(build)
    folders = {}
    for name in tests:
        folders.setdefault(tests[name], Folder()).left += 1
    usual = sum(known.values()) / len(known) if known else 0.3
    left = {name: known.get(name, usual) for name in tests}
    terminal = sys.stdout.isatty()
    slowest, failures, begun = [], [], time.monotonic()

    def show(folder):
        counts = folders[folder]
        words = [f"{counts.passed} passed"]
        words += [f"{counts.skipped} skipped"] if counts.skipped else []
        words += [f"{counts.failed} FAILED"] if counts.failed else []
        remaining = sum(left.values()) / jobs
        until = f"   about {remaining / 60:.0f} min left" if remaining >= 60 else ""
        print(f"{CLEAR if terminal else ''}  {folder:<18} {', '.join(words):<28} {counts.seconds:7.1f} s{until}", flush=True)

    with open(log, "w", encoding="utf-8", errors="replace") as file:
        ctest = subprocess.Popen(["ctest", *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                 errors="replace")
        failing = summary = False
        for line in ctest.stdout:
            file.write(line)
            if "tests passed" in line:
                summary = True
            found = DONE.match(line)
            if not found:
                if line.lstrip().startswith("Start "):
                    continue
                if not tests or failing or summary and "sec*proc" not in line and "Label Time" not in line:
                    print(line, end="", flush=True)
                continue
            name, verdict, seconds = found[4], found[5].lstrip("*"), float(found[6])
            counts = folders.setdefault(tests.get(name, "others"), Folder())
            counts.left -= 1
            counts.seconds += seconds
            left.pop(name, None)
            slowest.append((seconds, name))
            failing = verdict not in ("Passed", "Skipped", "Not Run (Disabled)")
            counts.passed += verdict == "Passed"
            counts.skipped += verdict == "Skipped"
            counts.failed += failing
            if failing:
                failures.append(name)
                print((CLEAR if terminal else "") + line, end="", flush=True)
            if counts.left == 0:
                show(tests.get(name, "others"))
            elif terminal:
                remaining = sum(left.values()) / jobs
                print(f"{CLEAR}  {found[1]}/{found[2]} tests, about {remaining:.0f} s left", end="", flush=True)
        status = ctest.wait()
    print("Ten slowest:")
    for seconds, name in sorted(slowest, reverse=True)[:10]:
        print(f"  {seconds:7.1f} s  {name}")
    print(f"{len(slowest)} tests in {time.monotonic() - begun:.0f} s, {len(failures)} failed; all of CTest's words: {log}")
    return status


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
