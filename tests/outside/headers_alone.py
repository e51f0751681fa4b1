#!/usr/bin/env python3
"""Each installed header compiles when it is the only one included.

usage: headers_alone.py SOURCE BUILD
The build has shown it for a header that is the first include of the .cpp file beside it; the others are compiled here. What they
include from elsewhere is parsed once, as that takes most of the time: a header gets it if it uses no names of the standard library but those in
GIVEN_BY and includes what gives them. Any other header is compiled with nothing before it. A header of the first kind is not compiled if
another one includes it before all others of Presa: it has stood alone there.
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
SYSTEM = re.compile(r"^#include <(.*)>", re.MULTILINE)
STANDARD_NAME = re.compile(r"\bstd::(\w+)")
COMMENT = re.compile(r"//.*")

# the headers of the standard library that are promised to declare a name
GIVEN_BY = {
    **{name: {name} for name in ("array", "atomic", "map", "optional", "span", "string", "string_view", "variant", "vector")},
    **{name: {"algorithm"} for name in ("clamp", "copy_n", "max", "min")},
    **{name: {"cmath"} for name in ("cos", "exp", "expm1", "hypot", "log", "log10", "pow", "sin", "sqrt")},
    **{name: {"cstdint"} for name in ("int16_t", "int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t")},
    **{name: {"memory"} for name in ("make_shared", "make_unique", "shared_ptr", "unique_ptr", "weak_ptr")},
    **{name: {"stdexcept"} for name in ("invalid_argument", "logic_error", "runtime_error")},
    **{name: {"utility"} for name in ("exchange", "move", "pair", "swap")},
    "function": {"functional"},
    "get_if": {"variant"},
    "memory_order_acq_rel": {"atomic"},
    "memory_order_acquire": {"atomic"},
    "memory_order_relaxed": {"atomic"},
    "nullopt": {"optional"},
    "numeric_limits": {"limits"},
    "pi": {"numbers"},
    "size_t": {"array", "cstddef", "cstdio", "cstdlib", "cstring", "span", "string", "string_view", "vector"},
}
PARSED = sorted({header for headers in GIVEN_BY.values() for header in headers})


def main():
    source, build = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["cmake", "--install", build, "--component", "headers", "--prefix", folder], check=True, stdout=subprocess.DEVNULL)
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

        def includes_its_names(header):
            text = COMMENT.sub("", (root / header).read_text())
            names = set(STANDARD_NAME.findall(text))
            system = {name for of in reached(header) for name in SYSTEM.findall((root / of).read_text())}
            return all(not system.isdisjoint(GIVEN_BY.get(name, ())) for name in names)

        def parse(name, lines):
            path = pathlib.Path(folder, name)
            path.write_text("".join(lines))
            subprocess.run([*compiler, "c++-header", path, "-o", f"{path}.gch"], check=True)
            return path

        standard = [f"#include <{name}>\n" for name in PARSED]
        parsed = parse("parsed.h", standard)
        parsed_with_eigen = parse("parsed_with_eigen.h", [*standard, f'#include "{SPATIAL}"\n'])

        def compiles(header):
            given = []
            if header != SPATIAL and includes_its_names(header):
                given = ["-include", parsed_with_eigen if SPATIAL in reached(header) else parsed]
            return subprocess.run([*compiler, "c++", "-fsyntax-only", *given, "-"], check=False, text=True, input=f'#include "{header}"\n').returncode == 0

        first_included = {found[1] for header in headers if (found := INCLUDE.search((root / header).read_text()))}
        rest = [h for h in headers if not stands_first(h) and not (h in first_included and includes_its_names(h))]
        with ThreadPoolExecutor(2) as pool:
            bad = [header for header, good in zip(rest, pool.map(compiles, rest)) if not good]
    print(f"{len(headers)} headers: {len(rest) - len(bad)} of the {len(rest)} that stand first nowhere compile alone")
    sys.exit(" ".join(["FAILED:", *bad]) if bad else 0)


if __name__ == "__main__":
    main()
