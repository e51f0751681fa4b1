"""A simulation in lockstep that its caller steps."""

from __future__ import annotations

import os
from types import TracebackType
from typing import Any, Iterator, Mapping, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from presa import _presa
from presa._presa import InputError as InputError

Path = Union[str, "os.PathLike[str]"]
Point = Sequence[float]


class _Row:
    """One body or finger: each attribute is its row in the arrays of all of them."""

    def __init__(self, arrays: Mapping[str, NDArray[Any]], index: int) -> None:
        self._arrays = arrays
        self.index = index

    def __getattr__(self, name: str) -> Any:
        try:
            return self._arrays[name][self.index]
        except KeyError:
            raise AttributeError(f"no attribute {name!r}; there are {', '.join(self._arrays)}") from None

    def __dir__(self) -> list[str]:
        return ["index", *self._arrays]


class _Table:
    """All bodies or all fingers: arrays as attributes, one of them by its name or number."""

    def __init__(self, names: Sequence[str], arrays: Mapping[str, NDArray[Any]]) -> None:
        self.names = tuple(names)
        self._arrays = arrays

    def __getattr__(self, name: str) -> NDArray[Any]:
        try:
            return self._arrays[name]
        except KeyError:
            raise AttributeError(f"no attribute {name!r}; there are {', '.join(self._arrays)}") from None

    def __getitem__(self, which: Union[str, int]) -> _Row:
        if isinstance(which, str):
            if which not in self.names:
                raise KeyError(f"{which!r}; there are {', '.join(self.names)}")
            which = self.names.index(which)
        return _Row(self._arrays, range(len(self.names))[which])

    def __len__(self) -> int:
        return len(self.names)

    def __iter__(self) -> Iterator[_Row]:
        return (self[i] for i in range(len(self)))

    def __dir__(self) -> list[str]:
        return ["names", *self._arrays]


class Simulation:
    """A run of a scene, to the bit that of `presa run SCENE --lockstep`.

    scene     file, or a name for messages if `text` is given
    text      the scene as XML; files that it names are relative to the working directory
    rig       file of the devices; default: the rig that the scene names
    set       {"body/cube/physics/mass": 0.1, ...}, as `--set`
    fingers   {"thumb": (x, y, z), ...}: your program moves the fingers (`targets`), which start there
    duration  simulated seconds; default: to the end of the rig's motion, without end if your program moves the fingers
    record    HDF5 file for `presa replay` and presa.Recording

    `bodies` and `fingers` hold arrays that every step changes in place; copy what you want to keep:
      bodies.position (n, 3), orientation (n, 4), velocity, angular_velocity, asleep
      fingers.position, velocity, proxy, force (sent to the device), rendered_force (before its limits), depth,
      normal_force, mode (0 free, 1 stick, 2 slip), body (index, -1: none)
    Raises InputError with every mistake in scene and rig. Other threads run while it steps; Ctrl-C stops a step.
    """

    def __init__(
        self,
        scene: Path = "scene",
        *,
        text: str = "",
        rig: Path = "",
        set: Mapping[str, object] = {},
        fingers: Mapping[str, Point] = {},
        seed: int = 1,
        duration: float = 0,
        record: Path = "",
        overwrite: bool = False,
    ) -> None:
        sets = [f"{path}={str(value).lower() if isinstance(value, bool) else value}" for path, value in set.items()]
        starts = {role: (float(p[0]), float(p[1]), float(p[2])) for role, p in fingers.items()}
        self._run = _presa.Simulation(
            os.fspath(scene), text, os.fspath(rig), sets, starts, seed, duration, os.fspath(record), overwrite
        )
        self.bodies = _Table(self._run.body_names, self._run.bodies())
        self.fingers = _Table(self._run.roles, self._run.fingers())
        #: Where the fingers are to be after the next step, (n, 3); empty if the rig moves them. Write into it.
        self.targets: NDArray[np.float64] = self._run.targets()

    def step(self, ticks: int = 1) -> bool:
        """Runs so many haptic ticks. False: the run has come to its end. RuntimeError while another thread steps it."""
        return self._run.step(ticks)

    def run(self) -> "Simulation":
        """Runs to the end."""
        while self._run.step(1000):
            pass
        return self

    def press(self, finger: str, *buttons: int) -> None:
        """Buttons of a finger that your program moves; those not named are released."""
        self._run.press(self.fingers.names.index(finger), sum(1 << button for button in buttons))

    def close(self) -> None:
        """Ends the run and closes its recording. RuntimeError while it is being stepped."""
        self._run.close()

    def figures(self) -> dict[str, Any]:
        """What the run was like so far: objects grasped, dropped and lifted [m]; seconds in stick and slip of fingers."""
        return self._run.figures()

    @property
    def contacts(self) -> NDArray[Any]:
        """Contacts of the last tick: finger, body, mode, depth, point, normal (into the finger), force (on it)."""
        return self._run.contacts()

    @property
    def time(self) -> float:
        """Simulated time reached [s]."""
        return self._run.time

    @property
    def tick(self) -> float:
        """Duration of a haptic tick [s]."""
        return self._run.tick

    @property
    def done(self) -> bool:
        return self._run.done

    @property
    def status(self) -> list[str]:
        """What the output stage kept from the devices in the last tick: "force limit", "over-speed", ..."""
        return self._run.status

    @property
    def notes(self) -> list[str]:
        """Warnings and notes of the load."""
        return self._run.notes

    @property
    def state_hash(self) -> int:
        """Hash of all states so far, equal for runs that are equal to the bit."""
        return self._run.state_hash

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
