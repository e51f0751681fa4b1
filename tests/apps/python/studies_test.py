"""presa.run, cost, stability, experiment: the programs' figures as Python data."""

import tempfile
import unittest

import presa

CUBE = "config/scenes/cube.xml"


class Studies(unittest.TestCase):
    def test_a_run_gives_its_summary(self):
        summary = presa.run(CUBE, "--for", "1", set={"body/cube/physics/mass": 0.05})
        self.assertEqual(summary["seed"], 1)
        self.assertIn("state_hash", summary)

    def test_a_mistake_raises_what_the_program_says(self):
        with self.assertRaisesRegex(RuntimeError, r"error\[E202\]"):
            presa.run(CUBE, set={"body/cub/physics/mass": 0.05})

    def test_costs_have_a_row_for_each_setting(self):
        study = presa.cost(CUBE, "--quick", "--for", "0.5", "--knob", "dynamics_rate=100,500")
        self.assertGreaterEqual(len(study["settings"]), 2)
        self.assertTrue(all(row["cpu_per_simulated_s"]["median"] > 0 for row in study["settings"]))

    def test_stability_has_a_row_for_each_method(self):
        rows = presa.stability("turned_disc")
        self.assertGreater(len({row["method"] for row in rows}), 1)
        self.assertEqual({row["case"] for row in rows}, {"turned_disc"})

    def test_an_experiment_gives_its_trials(self):
        with tempfile.TemporaryDirectory(prefix="presa-") as data:
            trials = presa.experiment("experiments/slip_reaction/experiment.xml", "S01", data, "--simulated", "L0",
                                      "--no-recording")
        self.assertGreater(len(trials), 5)
        self.assertIn("trial", trials[0])


if __name__ == "__main__":
    unittest.main()
