"""Runs and studies as the command line has them, with their figures as Python data."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Iterable, Mapping, Union

PathLike = Union[str, "os.PathLike[str]"]


def program() -> str:
    """The program `presa`: PRESA_PROGRAM, else that of the build folder of this package, else the one on the PATH."""
    beside = Path(__file__).absolute().parents[2] / "bin" / "presa"  # the folder has links to the sources
    found = os.environ.get("PRESA_PROGRAM") or (str(beside) if beside.exists() else shutil.which("presa"))
    if found is None:
        raise FileNotFoundError("the program presa is not on the PATH; PRESA_PROGRAM may name it")
    return found


def _call(words: Iterable[str], allowed: tuple[int, ...] = (0,)) -> str:
    """Its standard output. Raises RuntimeError with what it says if it ends with another status."""
    done = subprocess.run([program(), *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode not in allowed:
        raise RuntimeError(done.stderr.strip() or f"presa ended with status {done.returncode}")
    return done.stdout


def _sets(set: Mapping[str, object]) -> list[str]:
    return [word for path, value in set.items() for word in ("--set", f"{path}={value}")]


def _out(out: PathLike | None) -> Path:
    return Path(tempfile.mkdtemp(prefix="presa-") if out is None else out)


def run(scene: PathLike, *options: str, set: Mapping[str, object] = {}) -> dict[str, Any]:
    """`presa run SCENE --lockstep` with further options: its summary. A fault of the run is in it, no exception."""
    with tempfile.TemporaryDirectory(prefix="presa-") as folder:
        summary = Path(folder) / "summary.json"
        words = ["run", os.fspath(scene), "--lockstep", "--quiet", "--summary", str(summary), *options, *_sets(set)]
        _call(words, allowed=(0, 1))
        return dict(json.loads(summary.read_text()))


def cost(scene: PathLike, *options: str, set: Mapping[str, object] = {}, out: PathLike | None = None) -> dict[str, Any]:
    """`presa cost SCENE`: what accuracy costs in time. `settings` has a row for each, `metrics` what the errors mean."""
    folder = _out(out)
    _call(["cost", os.fspath(scene), "--out", str(folder), *options, *_sets(set)])
    return dict(json.loads((folder / "cost.json").read_text()))


def stability(*cases: str, options: Iterable[str] = ()) -> list[dict[str, Any]]:
    """`presa stability`, of these cases or of all: one row for each case and method."""
    named = [word for case in cases for word in ("--case", case)]
    text = _call(["stability", "--format", "json", *named, *options], allowed=(0, 1))
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


def experiment(definition: PathLike, subject: str, data: PathLike, *options: str) -> list[dict[str, str]]:
    """`presa experiment run`: the session of one subject, in lockstep. Returns the rows of trials.csv."""
    words = ["experiment", "run", os.fspath(definition), "--subject", subject, "--data", os.fspath(data), "--lockstep"]
    _call([*words, *options])
    trials: list[dict[str, str]] = []
    for file in sorted((Path(data) / f"sub-{subject}").glob("ses-*/trials.csv")):
        with open(file, newline="", encoding="utf-8") as table:
            trials += csv.DictReader(table)
    return trials
