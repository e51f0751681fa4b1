"""What a step from Python costs beside a run in C++: python -m presa.overhead [SCENE]

Processor time of the same ticks in one call and in calls of ten, in turn, so that a busy machine slows both.
"""

import statistics
import sys
import time

from presa.simulation import Simulation


def _seconds(scene: str, ticks: int, total: int) -> float:
    with Simulation(scene, duration=1e6) as simulation:
        simulation.step(1)  # starts the run
        begin = time.process_time()
        for _ in range(total // ticks):
            simulation.step(ticks)
        return time.process_time() - begin


def main() -> None:
    scene = sys.argv[1] if len(sys.argv) > 1 else "config/scenes/cube.xml"
    total, ratios = 5000, []
    for _ in range(9):
        whole, parts = _seconds(scene, total, total), _seconds(scene, 10, total)
        ratios.append(parts / whole)
    print(f"{scene}: ten ticks a call take {statistics.median(ratios):.3f} of the time of one call "
          f"({min(ratios):.3f} to {max(ratios):.3f}, {len(ratios)} pairs of {total} ticks)")


if __name__ == "__main__":
    main()
