"""Recordings of `presa run --record`, read with h5py alone: Presa's library is not needed."""

from __future__ import annotations

import os
from typing import Any, Union

import h5py  # type: ignore[import]
import numpy as np
from numpy.typing import NDArray


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _texts(values: Any) -> list[str]:
    return [_text(value) for value in np.atleast_1d(values)]


class Table:
    """Rows of one finger, body, frame or tool, one for each haptic tick: table["depth"], table.units["depth"].

    `values` is all of it, a structured array: pandas.DataFrame(table.values).
    """

    def __init__(self, data: "h5py.Dataset") -> None:
        self.values: NDArray[Any] = data[:]
        self.columns: list[str] = list(self.values.dtype.names or ())
        self.units = dict(zip(self.columns, _texts(data.attrs["units"])))
        self.descriptions = dict(zip(self.columns, _texts(data.attrs["descriptions"])))
        self.phases = _text(data.attrs.get("phases", "")).splitlines()

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        """One column, or, by the name of a vector (p_WB of p_WB_x, p_WB_y, p_WB_z), its columns side by side."""
        if column in self.columns:
            return np.asarray(self.values[column])
        parts = [name for name in self.columns if name.rsplit("_", 1)[0] == column]
        if not parts:
            raise KeyError(f"{column!r}; there are {', '.join(self.columns)}")
        return np.stack([self.values[name] for name in parts], axis=1)

    def __len__(self) -> int:
        return len(self.values)


class Recording:
    """All tables of a recording, in memory. A file of a run that was killed holds what was written until then."""

    def __init__(self, file: Union[str, "os.PathLike[str]"]) -> None:
        with h5py.File(file, "r") as data:
            self.attributes = {name: data.attrs[name] for name in data.attrs}
            self.complete = bool(data.attrs.get("complete", 0))
            self.scene_xml = _text(data["scene_xml"][()])
            self.rig_xml = _text(data["rig_xml"][()])
            self.ticks = Table(data["haptic/ticks"])
            self.fingers = self._tables(data, "fingers")
            self.bodies = self._tables(data, "bodies")
            self.frames = self._tables(data, "frames")
            self.tools = self._tables(data, "tools")

    @property
    def time(self) -> NDArray[np.float64]:
        """Simulated time of each tick [s]."""
        return self.ticks["time"]

    @staticmethod
    def _tables(data: "h5py.File", kind: str) -> dict[str, Table]:
        group = data.get("haptic/" + kind)
        return {} if group is None else {name: Table(group[name]) for name in group}
