"""A scene as an environment for learning, in the shape of Gymnasium's: reset, step, spaces.

Gymnasium is not needed. Where it is installed, the spaces are its own.
"""

from __future__ import annotations

import functools
from typing import Any, Callable, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from presa.simulation import Path, Point, Simulation

Array = NDArray[np.float64]


class Box:
    """Numbers between bounds, as gymnasium.spaces.Box."""

    def __init__(self, low: Any, high: Any, shape: tuple[int, ...]) -> None:
        self.shape, self.dtype = shape, np.dtype(np.float64)
        self.low: Array = np.broadcast_to(np.asarray(low, float), shape)
        self.high: Array = np.broadcast_to(np.asarray(high, float), shape)
        self._random = np.random.default_rng()

    def seed(self, seed: Optional[int] = None) -> None:
        self._random = np.random.default_rng(seed)

    def sample(self) -> Array:
        return self._random.uniform(self.low, self.high)

    def contains(self, x: Any) -> bool:
        x = np.asarray(x)
        return x.shape == self.shape and bool(np.all(x >= self.low) and np.all(x <= self.high))


def _box(low: Any, high: Any, shape: tuple[int, ...]) -> Any:
    try:
        from gymnasium import spaces  # type: ignore[import]
    except ImportError:
        return Box(low, high, shape)
    return spaces.Box(np.broadcast_to(low, shape), np.broadcast_to(high, shape), dtype=np.float64)


def observe(simulation: Simulation) -> Array:
    """Poses of all bodies, then positions and forces of all fingers."""
    bodies, fingers = simulation.bodies, simulation.fingers
    parts = (bodies.position, bodies.orientation, fingers.position, fingers.force)
    return np.concatenate([part.ravel() for part in parts])


class Environment:
    """Fingers that an agent moves: an action is how far each goes in one step [m], (n, 3) or flat.

    scene, set, ...   as Simulation
    fingers           start positions by role
    reward            of a simulation, after each step
    done              of a simulation: the episode has reached its end
    observation       of a simulation: a flat array; default: poses of bodies, positions and forces of fingers
    ticks             haptic ticks in a step
    reach             how far a finger may go in a step [m]
    limit             steps in an episode, after which it is truncated
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(
        self,
        scene: Path = "scene",
        *,
        fingers: Mapping[str, Point],
        reward: Callable[[Simulation], float],
        done: Callable[[Simulation], bool] = lambda simulation: False,
        observation: Callable[[Simulation], Array] = observe,
        text: str = "",
        set: Mapping[str, object] = {},
        ticks: int = 10,
        reach: float = 0.002,
        limit: int = 500,
    ) -> None:
        self._start = functools.partial(Simulation, scene, text=text, set=set, fingers=fingers)
        self._reward, self._done, self._observation = reward, done, observation
        self._ticks, self._reach, self._limit = ticks, reach, limit
        self._simulation: Optional[Simulation] = None
        self._steps, self._seed = 0, 1
        size = self.reset()[0].size
        self.action_space = _box(-reach, reach, (len(fingers), 3))
        self.observation_space = _box(-np.inf, np.inf, (size,))

    @property
    def simulation(self) -> Simulation:
        assert self._simulation is not None
        return self._simulation

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
    ) -> tuple[Array, dict[str, Any]]:
        """A new run of the scene. Of equal seeds and actions, episodes are equal to the bit."""
        self.close()
        self._seed = self._seed if seed is None else seed
        self._simulation = self._start(seed=self._seed)
        self._simulation.step()
        self._steps = 0
        return self._observation(self._simulation), {}

    def step(self, action: Sequence[float] | Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Observation, reward, whether the episode is over, whether it was cut off, and what is worth a look."""
        simulation = self.simulation
        simulation.targets += np.clip(np.reshape(action, simulation.targets.shape), -self._reach, self._reach)
        simulation.step(self._ticks)
        self._steps += 1
        info = {"time": simulation.time, "status": simulation.status}
        truncated = self._steps >= self._limit
        return self._observation(simulation), float(self._reward(simulation)), self._done(simulation), truncated, info

    def close(self) -> None:
        if self._simulation is not None:
            self._simulation.close()
            self._simulation = None
