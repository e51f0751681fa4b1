"""presa.Recording reads what was recorded, without Presa's library."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import presa
from presa import studies


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="presa-")
        cls.file = os.path.join(cls.folder.name, "run.h5")
        cls.states = []
        with presa.Simulation("config/scenes/cube.xml", duration=2.5, record=cls.file) as simulation:
            while simulation.step(1):
                cls.states.append((simulation.bodies["cube"].position.copy(), simulation.fingers.force.copy()))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_hold_every_tick_as_the_views_had_it(self):
        recording = presa.Recording(self.file)
        self.assertTrue(recording.complete)
        self.assertEqual(len(recording.time), 2500)
        positions = np.array([position for position, _ in self.states])
        forces = np.array([force for _, force in self.states])
        # the state after the first dynamics step is the first that the views and the recording share
        np.testing.assert_array_equal(recording.bodies["cube"]["p_WB"][5:-1], positions[5:])
        for finger, role in enumerate(("thumb", "index")):
            np.testing.assert_array_equal(recording.fingers[role]["f_command_W"][:-1], forces[:, finger])

    def test_are_complete_where_no_tick_was_run(self):
        file = os.path.join(self.folder.name, "empty.h5")
        simulation = presa.Simulation("config/scenes/cube.xml", record=file)
        simulation.close()
        recording = presa.Recording(file)
        self.assertTrue(recording.complete)
        self.assertEqual(len(recording.time), 0)

    def test_name_columns_units_and_phases(self):
        thumb = presa.Recording(self.file).fingers["thumb"]
        self.assertEqual(thumb.units["depth"], "m")
        self.assertEqual(thumb.phases[:3], ["reach", "squeeze", "lift"])
        with self.assertRaisesRegex(KeyError, "depth"):
            thumb["dept"]

    def test_need_no_library(self):
        code = (
            "import sys, presa\n"
            f"recording = presa.Recording({self.file!r})\n"
            "assert len(recording.time) == 2500 and '<scene' in recording.scene_xml\n"
            "assert 'presa._presa' not in sys.modules\n"
        )
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_replay_to_the_bit(self):
        done = subprocess.run([studies.program(), "replay", self.file, "--verify"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
