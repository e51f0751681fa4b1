"""presa.Environment: the shape of Gymnasium's, equal to the bit for equal seeds and actions."""

import unittest

import numpy as np

import presa

START = {"thumb": (-0.05, 0, 0.025), "index": (0.05, 0, 0.025)}


def lifted(simulation):
    return simulation.bodies["cube"].position[2]


def environment(**more):
    return presa.Environment("config/scenes/cube.xml", fingers=START, reward=lifted, **more)


def squeeze_and_lift(step):
    """Towards each other until the fingers hold the cube, then up."""
    if step < 20:
        return ((0.0012, 0, 0), (-0.0012, 0, 0))
    return ((0, 0, 0.0005), (0, 0, 0.0005)) if step < 80 else np.zeros((2, 3))


def episode(agent, steps):
    made = environment(limit=steps)
    seen = [made.reset(seed=3)[0]]
    for step in range(steps):
        observation, reward, terminated, truncated, info = made.step(agent(step))
        seen.append(observation)
    made.close()
    return np.array(seen), reward, terminated, truncated, info


class Episodes(unittest.TestCase):
    def test_lift_a_cube(self):
        seen, height, terminated, truncated, info = episode(squeeze_and_lift, 100)
        self.assertGreater(height - lifted(environment().simulation), 0.02)
        self.assertTrue(truncated)
        self.assertFalse(terminated)
        self.assertAlmostEqual(info["time"], 1.001)
        self.assertTrue(np.isfinite(seen).all())

    def test_are_equal_to_the_bit_for_equal_actions(self):
        np.testing.assert_array_equal(episode(squeeze_and_lift, 30)[0], episode(squeeze_and_lift, 30)[0])

    def test_end_when_the_caller_says_so(self):
        made = environment(done=lambda simulation: simulation.time > 0.02)
        self.assertFalse(made.step(np.zeros((2, 3)))[2])
        self.assertTrue(made.step(np.zeros((2, 3)))[2])


class Spaces(unittest.TestCase):
    def test_hold_what_is_given_and_taken(self):
        made = environment(reach=0.002)
        observation = made.reset()[0]
        self.assertEqual(made.observation_space.shape, observation.shape)
        action = made.action_space.sample()
        self.assertTrue(made.action_space.contains(action))
        self.assertEqual(action.shape, (2, 3))
        self.assertFalse(made.action_space.contains(action + 1))

    def test_bound_what_an_action_does(self):
        made = environment(reach=0.002)
        made.reset()
        made.step(np.full((2, 3), 9.0))
        np.testing.assert_allclose(made.simulation.targets, np.array(list(START.values())) + 0.002)


if __name__ == "__main__":
    unittest.main()
