#!/usr/bin/env python3
"""Puts faults into a copy of the tree, one at a time, and says which of them the tests see. Run as `./dev mutate`."""
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
from operators import CORE, SAFETY, TESTS

ROOT = Path(__file__).resolve().parents[2]
SCRATCH = ROOT / "build-mutate"
NEEDED = {"safety": 0.95, "core": 0.90}
PATIENCE = 600  # [s] for one test program; a fault that makes it hang is seen


def stop(message):
    sys.exit(f"error: {message}")


class Mutant:
    def __init__(self, kind, operator):
        self.kind = kind
        self.file, self.old, self.new = operator

    def count(self):
        file = ROOT / self.file
        return file.read_text().count(self.old) if file.exists() else 0

    def line(self):
        text = (ROOT / self.file).read_text()
        return text[: text.find(self.old)].count("\n") + 1

    def __str__(self):
        def flat(text):
            return " ".join(text.split()) or "(nothing)"

        return f"{self.kind:6} {self.file}:{self.line()}: {flat(self.old)}  ->  {flat(self.new)}"

    def programs(self):
        for beginning, names in TESTS.items():
            if self.file.startswith(beginning):
                return names
        stop(f"tests/mutate/operators.py names no tests for {self.file}")


def chosen(words):
    mutants = [Mutant("safety", m) for m in SAFETY] + [Mutant("core", m) for m in CORE]
    stale = [f"{mutant.file} has this {mutant.count()} times:  {mutant.old}" for mutant in mutants if mutant.count() != 1]
    if stale:  # also where only some are asked for, so that the list stays true
        stop("tests/mutate/operators.py: a fragment is to be in its file once, and\n  " + "\n  ".join(stale))
    for mutant in mutants:
        mutant.programs()
    return [m for m in mutants if not words or any(word in str(m) for word in words)]


# ---- the copy ------------------------------------------------------------------------------------------------------

def may_bind():
    """Whether a folder can be shown at another place: then the copy of the build folder fits, and nothing is built anew."""
    probe = ["unshare", *user(), "--mount", "true"]
    return shutil.which("unshare") is not None and subprocess.run(probe, stderr=subprocess.DEVNULL).returncode == 0


def user():
    return [] if os.geteuid() == 0 else ["--map-root-user"]


def inside(command, **more):
    """Runs a command in the copy; where possible, the copy stands where the tree does."""
    if BIND:
        show = 'mount --bind "$1" "$2" && cd "$2" && shift 2 && exec "$@"'
        command = ["unshare", *user(), "--mount", "sh", "-c", show, "sh", str(SCRATCH), str(ROOT), *command]
    return subprocess.run(command, cwd=SCRATCH, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", **more)


def make_copy():
    SCRATCH.mkdir(exist_ok=True)
    files = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           stdout=subprocess.PIPE).stdout.decode().split("\0")
    for name in filter(None, files):
        source, copy = ROOT / name, SCRATCH / name
        if not source.is_file():
            continue
        if not copy.is_file():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, copy)  # as old as it is, so that the build folder that comes with it fits
        elif copy.read_bytes() != source.read_bytes():
            shutil.copyfile(source, copy)  # of now: also what a run that was killed left harmed is built again
    build = SCRATCH / "build"
    if not (build / "build.ninja").exists():
        if BIND and (ROOT / "build" / "build.ninja").exists():
            subprocess.run(["cp", "-a", "--reflink=auto", str(ROOT / "build"), str(SCRATCH)], check=True)
        elif (made := inside(["cmake", "--preset", "release"])).returncode != 0:
            stop("cannot configure the copy:\n" + made.stdout)


# ---- one mutant ----------------------------------------------------------------------------------------------------

def build(programs):
    targets = [f"test_{name}" for name in programs]  # CMake knows which plug-ins they load
    return inside(["ninja", "-C", "build", "-j", os.environ.get("PRESA_JOBS", str(os.cpu_count())), *targets])


def sees(name):
    """The first test that fails, or how the program ended; None: it saw nothing."""
    environment = dict(os.environ, PRESA_WATCH_TRANSPORT="1")
    try:
        ran = inside([f"build/bin/test_{name}", "--gtest_fail_fast", "--gtest_brief=1"], timeout=PATIENCE, env=environment)
    except subprocess.TimeoutExpired:
        return f"{name}: hangs"
    if ran.returncode == 0:
        return None
    failed = [line.split()[3] if len(line.split()) > 3 else line for line in ran.stdout.splitlines() if "[  FAILED  ]" in line]
    return f"{name}: {failed[0].rstrip(',')}" if failed else f"{name}: ended with {ran.returncode}"


class DoesNotBuild(Exception):
    """The operator is wrong, not a test."""


def tried(mutant):
    """What sees it; None: nothing does."""
    path = SCRATCH / mutant.file
    text = (ROOT / mutant.file).read_text()
    path.write_text(text.replace(mutant.old, mutant.new))
    try:
        for name in mutant.programs():
            made = build([name])
            if made.returncode != 0:
                raise DoesNotBuild(made.stdout[-3000:])
            if seen := sees(name):
                return seen
        return None
    finally:
        path.write_text(text)  # of now, so that it is built again


def check_unharmed(mutants):
    """A test that is red anyway would see everything."""
    programs = list(dict.fromkeys(name for mutant in mutants for name in mutant.programs()))
    print(f"building and running the tests as they are: {', '.join(programs)}", flush=True)
    made = build(programs)
    if made.returncode != 0:
        stop("the tree does not build:\n" + made.stdout[-3000:])
    for name in programs:
        if seen := sees(name):
            stop(f"a test fails without any fault: {seen}")


def clock(seconds):
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"


def main():
    words = sys.argv[1:]
    listing = "--list" in words
    words = [word for word in words if word != "--list"]
    if any(word.startswith("-") for word in words):
        stop("usage: ./dev mutate [--list] [FILTER…]")
    mutants = chosen(words)
    if not mutants:
        stop(f"no fault matches '{' or '.join(words)}'")
    if listing:
        print(*mutants, sep="\n")
        print(f"{len(mutants)} faults")
        return 0
    make_copy()
    check_unharmed(mutants)
    begin, survivors, broken, count = time.monotonic(), [], [], {kind: [0, 0] for kind in NEEDED}
    for number, mutant in enumerate(sorted(mutants, key=lambda m: (m.kind != "safety", m.file)), 1):
        try:
            seen = tried(mutant)
        except DoesNotBuild as error:
            broken.append(mutant)
            print(f"DOES NOT BUILD  {mutant}\n{error}", flush=True)
            continue
        count[mutant.kind][1] += 1
        count[mutant.kind][0] += seen is not None
        if seen is None:
            survivors.append(mutant)
        passed = time.monotonic() - begin
        left = passed / number * (len(mutants) - number)
        print(f"[{number}/{len(mutants)}, {clock(left)} left] {'caught' if seen else 'SURVIVOR'}  {mutant}"
              + (f"\n    by {seen}" if seen else ""), flush=True)
    return summary(count, survivors, broken)


def summary(count, survivors, broken):
    short = bool(broken)
    print()
    for kind, (caught, all_of_them) in count.items():
        if all_of_them == 0:
            continue
        share = caught / all_of_them
        short = short or share < NEEDED[kind]
        print(f"{kind}: {caught} of {all_of_them} caught, {100 * share:.1f} % ({100 * NEEDED[kind]:.0f} % needed)")
    if survivors:
        print("survivors:", *survivors, sep="\n  ")
    if broken:
        print("do not build:", *broken, sep="\n  ")
    return 1 if short else 0


BIND = may_bind()
if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("stopped")
