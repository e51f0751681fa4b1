#!/usr/bin/env python3
"""Follows a page of the guide word for word, in an empty folder, with `presa` on the PATH.

usage: page.py PAGE BUILD [--installed PREFIX]
PAGE is a Markdown file of docs/, BUILD the build folder; with --installed the program below PREFIX counts, as ~/.local, and blocks that
build are followed, too. One shell runs all commands: `cd` and `export` stay. Every fenced block must say what it is:

  ```sh                 these commands run, and succeed; `sh exits=2`: the last one ends with status 2
  ```output             these lines stand in what the last `sh` printed, in this order; … is any text
  ```xml FILE           the reader saves this as FILE (any language)
  ```diff FILE          the reader changes FILE: lines with - go, lines with + come, the others are already there
  ```text               read only: a formula, a drawing, a sketch of a form

A comment `<!-- not run: REASON -->` on the line above an `sh` block leaves it out; REASONS lists what may stand there.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass

REASONS = {
    "installs packages",  # tests/outside and a bare Debian do that
    "builds from source",
    "needs the source tree",
    "needs a screen",
    "needs a device",
    "needs a second machine",
    "takes minutes",
}
FENCE = re.compile(r"^( *)(```+)(.*)$")
NOT_RUN = re.compile(r"^\s*<!-- not run: (.*) -->$")
SECONDS = 120  # of one block


class Wrong(Exception):
    """What the reader would trip over."""


@dataclass
class Block:
    line: int
    info: list
    text: str
    not_run: str = ""


def blocks(page):
    """The fenced blocks of a page, in order."""
    lines = page.splitlines()
    found, opened = [], None
    for number, line in enumerate(lines, 1):
        fence = FENCE.match(line)
        if opened is None:
            if fence:
                skipped = NOT_RUN.match(lines[number - 2]) if number > 1 else None
                opened = (number, fence[1], fence[2], fence[3].split(), skipped[1] if skipped else "", [])
        elif fence and fence[2] == opened[2] and not fence[3].strip():
            begin, _, _, info, skipped, text = opened
            found.append(Block(begin, info, "".join(f"{t}\n" for t in text), skipped))
            opened = None
        else:
            opened[5].append(line.removeprefix(opened[1]))
    if opened:
        raise Wrong(f"line {opened[0]}: the block has no end")
    return found


def matches(shown, printed):
    """The first line of `shown` that is missing from `printed`, in order; None: all are there."""
    rest = iter([" ".join(line.split()) for line in printed.splitlines()])
    for line in shown.splitlines():
        words = " ".join(line.split())
        if not words or words == "…":
            continue
        form = re.compile(".*".join(re.escape(part) for part in words.split("…")) + "$")
        if not any(form.match(candidate) for candidate in rest):
            return line
    return None


def changed(text, diff):
    """`text` after the change that a diff shows; the lines that it keeps or removes must stand together, once."""
    old, new = [], []
    for line in diff.splitlines():
        mark, rest = line[:1], line[1:]
        if mark not in ("-", "+", " ", ""):
            raise Wrong(f"a line of a diff begins with -, + or a space, not: {line}")
        if mark != "+":
            old.append(rest)
        if mark != "-":
            new.append(rest)
    before = "".join(f"{line}\n" for line in old)
    if text.count(before) != 1:
        raise Wrong(f"these lines stand {text.count(before)} times in the file, not once:\n{before}")
    return text.replace(before, "".join(f"{line}\n" for line in new))


class Reader:
    def __init__(self, folder, build, installed=None):
        self.folder = pathlib.Path(folder, "page")
        self.shell = pathlib.Path(folder, "shell")  # where the shell is, and its variables
        self.printed = None
        self.left_out = []
        self.followed = {"builds from source"} if installed else set()
        self.environment = {
            **os.environ,
            "PATH": f"{installed or build}/bin:/usr/bin:{os.environ['PATH']}",
            "PYTHONPATH": f"{build}/python",
            "HOME": f"{folder}/home",
            "MPLBACKEND": "Agg",
            "NO_COLOR": "1",
        }
        self.folder.mkdir()
        pathlib.Path(folder, "home").mkdir()
        if installed:
            pathlib.Path(folder, "home/.local").symlink_to(installed)
        self.shell.write_text(f"cd {self.folder}\n", encoding="utf-8")

    def follow(self, block):
        if not block.info:
            raise Wrong("the block does not say what it is")
        kind, *rest = block.info
        if kind == "sh":
            self.run(block, rest)
        elif kind == "output":
            self.compare(block)
        elif kind == "diff":
            self.change(block, rest)
        elif kind != "text":
            self.save(block, rest)

    def run(self, block, rest):
        if block.not_run and block.not_run not in self.followed:
            if block.not_run not in REASONS:
                raise Wrong(f"'{block.not_run}' is no reason to leave a block out; there are: {', '.join(sorted(REASONS))}")
            self.left_out.append(f"line {block.line}: {block.not_run}")
            self.printed = None
            return
        expected = int(rest[0].removeprefix("exits=")) if rest else 0
        script = f"source {self.shell}\n{block.text}\n{{ export -p; printf 'cd %q\\n' \"$PWD\"; }} >{self.shell}"
        done = subprocess.run(["bash", "-eo", "pipefail", "-c", script], env=self.environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS,
                              check=False)
        self.printed = done.stdout
        if done.returncode != expected:
            raise Wrong(f"status {done.returncode}, not {expected}:\n{block.text}{done.stdout}")

    def compare(self, block):
        if self.printed is None:
            raise Wrong("output of nothing that ran")
        missing = matches(block.text, self.printed)
        if missing is not None:
            raise Wrong(f"not printed, or not in this order: {missing}\nprinted:\n{self.printed}")

    def save(self, block, rest):
        if len(rest) != 1:
            raise Wrong(f"a block of {block.info[0]} names the file that the reader saves, for example ```xml scene.xml")
        file = self.folder / rest[0]
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text, encoding="utf-8")

    def change(self, block, rest):
        if len(rest) != 1 or not (self.folder / rest[0]).exists():
            raise Wrong("a block of diff names a file that the reader has")
        file = self.folder / rest[0]
        file.write_text(changed(file.read_text(encoding="utf-8"), block.text), encoding="utf-8")


def main():
    page, build = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    installed = pathlib.Path(sys.argv[4]).resolve() if sys.argv[3:4] == ["--installed"] else None
    with tempfile.TemporaryDirectory(prefix=f"presa_page_{os.getpid()}_") as folder:
        reader = Reader(folder, build, installed)
        found = []
        try:
            found = blocks(page.read_text(encoding="utf-8"))
            for block in found:
                try:
                    reader.follow(block)
                except (Wrong, subprocess.TimeoutExpired) as wrong:
                    raise Wrong(f"line {block.line}: {wrong}") from None
        except Wrong as wrong:
            print(f"{page}: {wrong}")
            return 1
    print(f"{page}: {len(found)} blocks, {len(reader.left_out)} left out")
    for line in reader.left_out:
        print(f"  {line}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
