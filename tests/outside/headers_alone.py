#!/usr/bin/env python3
"""Each installed header compiles when it is the only one included.

usage: headers_alone.py SOURCE BUILD
The build has shown it for a header that is the first include of the .cpp file beside it; the others are compiled here. Eigen, which
takes most of the time, is parsed once: a header gets it only if its own includes lead to spatial.h, which includes Eigen.
"""
import functools
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

INCLUDE = re.compile(r'^#include "(.*)"', re.MULTILINE)
FIRST = re.compile(r"^#include .*", re.MULTILINE)
SPATIAL = "framework/core/math/spatial.h"


def main():
    source, build = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["cmake", "--install", build, "--prefix", folder], check=True, stdout=subprocess.DEVNULL)
        root = pathlib.Path(folder, "include/presa")
        eigen = subprocess.run(["pkg-config", "--cflags", "eigen3"], check=True, capture_output=True, text=True).stdout.split()
        # as a system's: a header that was parsed before has lost the pragmas by which Eigen keeps its own warnings back
        eigen = [flag.replace("-I", "-isystem", 1) for flag in eigen]
        compiler = ["g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-I", root, *eigen, "-x"]
        headers = sorted(str(path.relative_to(root)) for path in root.rglob("*.h"))
        if len(headers) <= 50:
            sys.exit(f"FAILED: only {len(headers)} headers are installed")

        def stands_first(header):
            beside = (source / header).with_suffix(".cpp")
            first = FIRST.search(beside.read_text()) if beside.is_file() else None
            return first is not None and first[0] == f'#include "{header}"'

        @functools.cache
        def reached(header):
            """It and all installed headers that it includes, directly or not."""
            found = {header}
            for name in INCLUDE.findall((root / header).read_text()):
                if (root / name).is_file():
                    found |= reached(name)
            return frozenset(found)

        parsed = pathlib.Path(folder, "parsed.h")
        parsed.write_text(f'#include "{SPATIAL}"\n')
        subprocess.run([*compiler, "c++-header", parsed, "-o", f"{parsed}.gch"], check=True)

        def compiles(header):
            given = ["-include", parsed] if header != SPATIAL and SPATIAL in reached(header) else []
            return subprocess.run([*compiler, "c++", "-fsyntax-only", *given, "-"], check=False, text=True, input=f'#include "{header}"\n').returncode == 0

        rest = [header for header in headers if not stands_first(header)]
        with ThreadPoolExecutor(2) as pool:
            bad = [header for header, good in zip(rest, pool.map(compiles, rest)) if not good]
    print(f"{len(headers)} headers: {len(rest) - len(bad)} of the {len(rest)} that stand first in no source file compile alone")
    sys.exit(" ".join(["FAILED:", *bad]) if bad else 0)


if __name__ == "__main__":
    main()
