#!/usr/bin/env python3
"""The haptic tick of `presa run` alone, beside a loop that keeps another processor busy, beside its window, beside a
window whose display server, too, keeps off the haptic thread's processor (the last: of equal ones Presa keeps that),
and beside the same window of another run. The loop touches no memory, so its ratio tells what any work costs on this
machine (a lower clock, say). The other run shares nothing with the measured one but the machine, so its ratio tells
what drawing costs there; what the own window costs beyond that is due to data that tick and window share. The order is
random, so that a machine whose speed swings favours none.
beside_window.py [TURNS] [SECONDS], by default 30 turns of 5 s. It needs Xvfb, two processors and a built Presa."""
import contextlib
import json
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
VIEWS = {"alone": "none", "loop": "none", "window": "window", "window, server apart": "window",
         "another's window, server apart": "none"}
RUN = [ROOT / "build/bin/presa", "run", ROOT / "config/scenes/cube.xml", "--realtime", "--quiet"]
SILENT = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


def tick(view, seconds, folder):
    """Execution time [us] of the haptic tick at the median of one run in real time."""
    summary = pathlib.Path(folder, "summary.json")
    subprocess.run([*RUN, "--view", view, "--for", str(seconds), "--summary", summary], check=True, **SILENT)
    return json.loads(summary.read_text(encoding="utf-8"))["rates"]["haptic"]["execution_us"]["p50"]


def shift(alone, beside):
    """Ratio of the two by Hodges and Lehmann: the median over all pairs. Slow minutes of the machine move it little."""
    return math.exp(statistics.median(math.log(b / a) for a in alone for b in beside))


def interval(alone, beside, draws=1000):
    """95 % interval of that ratio, by bootstrap."""
    chance = random.Random(1)
    found = sorted(shift(chance.choices(alone, k=len(alone)), chance.choices(beside, k=len(beside)))
                   for _ in range(draws))
    return found[draws // 40], found[-1 - draws // 40]


@contextlib.contextmanager
def busy(command):
    """Keeps the first processor busy with this command while the block runs."""
    with subprocess.Popen(command, preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}),
                          **SILENT) as process:
        try:
            yield
        finally:
            process.terminate()


BESIDE = {"loop": ["sh", "-c", "while :; do :; done"],
          "another's window, server apart": [*RUN, "--view", "window", "--for", "3600"]}


def keep_apart(process, apart):
    """Whether all threads of this process keep off the last processor, which Presa keeps for its haptic thread."""
    every = os.sched_getaffinity(0)
    for thread in os.listdir(f"/proc/{process.pid}/task"):
        os.sched_setaffinity(int(thread), every - {max(every)} if apart else every)


def main(turns=30, seconds=5):
    read, write = os.pipe()
    with subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x720x24"], pass_fds=[write],
                          stderr=subprocess.DEVNULL) as server, tempfile.TemporaryDirectory() as folder:
        try:
            os.environ["DISPLAY"] = ":" + os.read(read, 16).decode().strip()
            times = {name: [] for name in VIEWS}
            for turn in range(turns):
                for name in random.sample(list(VIEWS), len(VIEWS)):
                    keep_apart(server, name.endswith("apart"))
                    with busy(BESIDE[name]) if name in BESIDE else contextlib.nullcontext():
                        times[name].append(tick(VIEWS[name], seconds, folder))
                print(f"turn {turn + 1} of {turns}:", ", ".join(f"{name} {found[-1]:.2f} us"
                                                               for name, found in times.items()), flush=True)
        finally:
            server.terminate()
    for name, found in times.items():
        ratios = (f"x {shift(times[other], found):.3f} {other} (95 % interval {low:.3f} to {high:.3f})"
                  for other in ("alone", "loop") for low, high in [interval(times[other], found)])
        print(f"{name}: median {statistics.median(found):.2f} us, min {min(found):.2f} us,", ", ".join(ratios))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
