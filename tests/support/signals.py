#!/usr/bin/env python3
"""How soon each command of presa answers Ctrl-C or SIGTERM, and ends:  python3 tests/support/signals.py [WORD]

Every command is started anew for each moment of the list; after that time it gets SIGTERM. `answer` is the first byte of
output after the signal, or the end of the process. A busy machine adds to both: run it on an idle one."""
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PRESA = str(ROOT / "build/bin/presa")
SCENES = ROOT / "config/scenes"
EXPERIMENTS = ROOT / "experiments"
MOMENTS = (0.15, 0.6, 1.5, 2.5)  # [s]
BOUND = 0.1  # [s]
PATIENCE = 10  # [s]

# each for longer than the last moment; {new} is a name that nothing has yet, {recording} a recording of ten minutes
COMMANDS = {
    "run, virtual time": f"run {SCENES}/tea_tray.xml --lockstep --for 1000",
    "run, real time": f"run {SCENES}/cube.xml --realtime --view none",
    "run, recorded": f"run {SCENES}/pinch_and_lift.xml --lockstep --for 1000 --record {{new}}.h5",
    "run, video": f"run {SCENES}/cube.xml --lockstep --video {{new}}.mp4",
    "run, 256 boxes in one place": "run {boxes} --lockstep --for 100",
    "run, report": f"run {SCENES}/cube.xml --lockstep --for 1000 --report {{new}}.html",
    "replay": "replay {recording} --verify",
    "replay, video": "replay {recording} --video {new}.mp4",
    "cost": f"cost {SCENES}/cube.xml --out {{new}}",
    "stability": "stability --out {new}",
    "lectures": "lectures jitter --out {new}",
    "printed": f"printed {SCENES}/percro_2006.xml --out {{new}}",
    "experiment simulate": f"experiment simulate {EXPERIMENTS}/slip_reaction/experiment.xml --subjects 200 --out {{new}}",
    "temple": "temple --auto --lockstep --size facade",
    "temple trials": "temple trials --size facade --seeds 8 --out {new}",
    "device faults": "device faults --out {new}",
    f"device periods {SCENES}/cube.xml {SCENES}/cube.xml": f"device periods {SCENES}/cube.xml {SCENES}/cube.xml",
    "bus": "bus list --wait 20",
    "view, joined": "view --join nobody --wait 20",
}


def boxes(file):
    """Two hundred and fifty-six boxes in the same place: one step of their dynamics takes long."""
    body = ('<body name="b{}" material="wood" pos="0 0 0.1"><haptic><box size="0.05 0.05 0.05"/></haptic>'
            '<physics mass="0.1"><box size="0.05 0.05 0.05"/></physics></body>')
    file.write_text(f'<scene version="1.0" name="boxes" rig="{ROOT}/config/rigs/hover.xml"><world gravity="0 0 -9.81"/>'
                    '<materials><material name="wood" stiffness="1000"/></materials>'
                    + "".join(body.format(i) for i in range(256))
                    + '<devices><device role="thumb"/><device role="index"/></devices></scene>')


def tried(arguments, moment, folder):
    """Answer and end [s] after the signal, or None where the command ended before."""
    process = subprocess.Popen([PRESA, *arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT)
    os.set_blocking(process.stdout.fileno(), False)
    time.sleep(moment)
    said = process.stdout.read() or b""
    if process.poll() is not None:
        return None, said.decode(errors="replace").strip().splitlines()[-1:]
    begin, answer = time.monotonic(), None
    process.send_signal(signal.SIGTERM)
    while process.poll() is None and time.monotonic() - begin < PATIENCE:
        if answer is None and select.select([process.stdout], [], [], 0.001)[0] and process.stdout.read():
            answer = time.monotonic() - begin
        elif answer is not None:
            process.stdout.read()
            time.sleep(0.001)
    end = time.monotonic() - begin
    process.kill()
    return (min(answer or end, end), end), [f"status {process.wait()}"]


def main():
    word = sys.argv[1] if len(sys.argv) > 1 else ""
    folder = Path(tempfile.mkdtemp(prefix="presa_signals_"))
    boxes(folder / "boxes.xml")
    recording = folder / "long.h5"
    subprocess.run([PRESA, "run", str(SCENES / "cube.xml"), "--lockstep", "--quiet", "--for", "600", "--record", str(recording)],
                   check=True, stdout=subprocess.DEVNULL)
    late, number = [], 0
    print(f"{'command':30} {'answer':>8} {'end':>8}   [ms], longest of {len(MOMENTS)}")
    for name, text in COMMANDS.items():
        if word not in name:
            continue
        answers, ends, notes = [], [], []
        for moment in MOMENTS:
            number += 1
            places = {"new": folder / f"n{number}", "recording": recording, "boxes": folder / "boxes.xml"}
            times, note = tried(text.format(**places).split(), moment, folder)
            if times is None:
                notes.append(f"ended by itself before {moment} s: {' '.join(note)[:90]}")
                break
            answers.append(1e3 * times[0])
            ends.append(1e3 * times[1])
            if note != ["status 130"]:
                notes.append(f"{note[0]} at {moment} s")
        if answers:
            print(f"{name:30} {max(answers):8.0f} {max(ends):8.0f}   {'; '.join(notes)}", flush=True)
        else:
            print(f"{name:30} {'-':>8} {'-':>8}   {'; '.join(notes)}", flush=True)
        if not answers or max(answers) > 1e3 * BOUND:
            late.append(name)
    shutil.rmtree(folder)
    if late:
        sys.exit(f"not within {1e3 * BOUND:.0f} ms: {', '.join(late)}")


main()
