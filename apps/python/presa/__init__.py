"""Presa from Python: step a simulation, read its states as numpy arrays, run studies, read recordings.

    import presa

    with presa.Simulation("config/scenes/cube.xml") as simulation:
        while simulation.step(10):                  # ten haptic ticks, 10 ms
            print(simulation.time, simulation.bodies["cube"].position, simulation.fingers["thumb"].force)

SI units, the world frame, vectors x y z, quaternions w x y z.
"""

import importlib

__all__ = ["Environment", "InputError", "Recording", "Simulation", "cost", "experiment", "run", "stability"]

# Each part is loaded when it is used: a recording is read without the library, a simulation without HDF5.
_HOME = {
    "Environment": "environment",
    "InputError": "simulation",
    "Recording": "recordings",
    "Simulation": "simulation",
    "cost": "studies",
    "experiment": "studies",
    "run": "studies",
    "stability": "studies",
}


def __getattr__(name):
    if name in _HOME:
        return getattr(importlib.import_module("presa." + _HOME[name]), name)
    raise AttributeError("module 'presa' has no attribute " + repr(name))


def __dir__():
    return __all__
