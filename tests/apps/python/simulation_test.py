"""presa.Simulation: equal to the program to the bit, views without copies, fingers that Python moves."""

import os
import signal
import threading
import time
import unittest

import numpy as np

import presa

CUBE = "config/scenes/cube.xml"

PLATE = """<scene version="1.0" name="plate">
  <world gravity="0 0 -9.81"/>
  <materials><material name="wood" stiffness="1000"><friction static="0.5" dynamic="0.4"/></material></materials>
  <body name="table" fixed="true" material="wood" pos="0 0 -0.05">
    <haptic><box size="1 1 0.1"/></haptic>
    <physics><box size="1 1 0.1"/></physics>
  </body>
  <body name="ball" material="wood" pos="0.3 0 1">
    <haptic><sphere radius="0.02"/></haptic>
    <physics mass="0.1"><sphere radius="0.02"/></physics>
  </body>
  <devices><device role="thumb" fingertip_radius="0.008"/></devices>
</scene>"""


def pressing(height, **more):
    """A fingertip of 8 mm over the table."""
    return presa.Simulation(text=PLATE, fingers={"thumb": (0, 0, height)}, **more)


class Equal(unittest.TestCase):
    def test_to_the_program_to_the_bit_in_steps_of_any_size(self):
        program = int(presa.run(CUBE, "--for", "1.5")["state_hash"], 16)
        for ticks in (1, 7, 1500):
            with presa.Simulation(CUBE, duration=1.5) as simulation:
                while simulation.step(ticks):
                    pass
                self.assertEqual(simulation.state_hash, program, f"{ticks} ticks a call")
                self.assertAlmostEqual(simulation.time, 1.5, places=12)

    def test_to_the_program_with_changed_parameters(self):
        changed = {"body/cube/physics/mass": 0.05, "material/rubber/stiffness": 1500}
        program = int(presa.run(CUBE, "--for", "1", set=changed)["state_hash"], 16)
        self.assertEqual(presa.Simulation(CUBE, set=changed, duration=1).run().state_hash, program)
        self.assertNotEqual(presa.Simulation(CUBE, duration=1).run().state_hash, program)


class Views(unittest.TestCase):
    def test_follow_the_simulation_without_copies(self):
        simulation = presa.Simulation(CUBE)
        position, force = simulation.bodies.position, simulation.fingers.force
        place = position.__array_interface__["data"][0]
        before = position.copy()
        simulation.step(2500)
        self.assertEqual(simulation.bodies.position.__array_interface__["data"][0], place)
        self.assertTrue(np.shares_memory(position, simulation.bodies["cube"].position))
        self.assertGreater(np.abs(position - before).max(), 1e-3)
        self.assertGreater(np.abs(force).max(), 0.1)

    def test_cannot_be_written(self):
        simulation = presa.Simulation(CUBE)
        with self.assertRaises(ValueError):
            simulation.bodies.position[0, 0] = 1

    def test_outlive_the_simulation(self):
        position = presa.Simulation(CUBE).bodies.position
        self.assertTrue(np.isfinite(position).all())

    def test_hold_the_contacts_that_the_forces_come_from(self):
        simulation = presa.Simulation(CUBE)
        simulation.step(2500)
        contacts = simulation.contacts
        self.assertEqual(set(contacts["finger"]), {0, 1})
        for finger in (0, 1):
            total = contacts[contacts["finger"] == finger]["force"].sum(axis=0)
            np.testing.assert_allclose(total, simulation.fingers.rendered_force[finger], atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(contacts["normal"], axis=1), 1, atol=1e-12)

    def test_names_say_what_there_is(self):
        simulation = presa.Simulation(CUBE)
        with self.assertRaisesRegex(KeyError, "thumb"):
            simulation.fingers["thum"]
        with self.assertRaisesRegex(AttributeError, "orientation"):
            simulation.bodies.rotation


class MovedFingers(unittest.TestCase):
    def test_press_with_stiffness_times_depth(self):
        # at rest a fixed plate gives k times depth: 1000 N/m, 1 mm below the touch at 8 mm
        simulation = pressing(0.01)
        simulation.targets[0] = (0, 0, 0.007)
        simulation.step(100)
        simulation.step(500)  # the forces of a run begin softly, within half a second
        self.assertAlmostEqual(simulation.fingers["thumb"].depth, 1e-3, delta=1e-12)
        np.testing.assert_allclose(simulation.fingers["thumb"].force, (0, 0, 1), atol=1e-9)
        self.assertEqual(simulation.fingers["thumb"].body, simulation.bodies["table"].index)
        self.assertEqual(simulation.fingers["thumb"].mode, 1)

    def test_are_at_their_targets_at_the_end_of_a_step(self):
        simulation = pressing(0.1)
        simulation.targets[0] = (0.02, -0.01, 0.11)
        simulation.step(5)
        np.testing.assert_array_equal(simulation.fingers["thumb"].position, (0.02, -0.01, 0.11))
        np.testing.assert_allclose(simulation.fingers["thumb"].velocity, np.array((0.02, -0.01, 0.01)) / 5e-3, rtol=1e-9)

    def test_leave_bodies_to_gravity(self):
        # semi-implicit Euler falls g t h / 2 farther than the parabola, h = 5 ms
        simulation = pressing(0.1)
        simulation.step(301)
        t = 0.3
        fallen = 1 - simulation.bodies["ball"].position[2]
        self.assertAlmostEqual(fallen, 9.81 * t * t / 2, delta=9.81 * t * 5e-3)

    def test_too_fast_for_a_hand_are_shown_and_felt_no_more(self):
        simulation = pressing(0.1)
        simulation.targets[0] = (0, 0, 10)
        simulation.step(3)
        self.assertIn("lost", simulation.status)

    def test_need_their_places(self):
        with self.assertRaisesRegex(presa.InputError, "E150.*thumb"):
            presa.Simulation(text=PLATE, fingers={"index": (0, 0, 0)})

    def test_press_buttons(self):
        with self.assertRaises(RuntimeError):
            presa.Simulation(CUBE).press("thumb", 0)
        pressing(0.1).press("thumb", 0, 3)


class BadInput(unittest.TestCase):
    def test_raises_every_mistake_with_its_place(self):
        wrong = PLATE.replace('mass="0.1"', 'mass="-1"')
        with self.assertRaises(presa.InputError) as raised:
            presa.Simulation("plate.xml", text=wrong, fingers={"thumb": (0, 0, 1)})
        message = str(raised.exception)
        self.assertRegex(message, r"plate.xml:\d+:\d+: error\[E\d+\].*mass")
        self.assertIsInstance(raised.exception, ValueError)

    def test_of_set_names_the_path(self):
        with self.assertRaisesRegex(presa.InputError, "E202"):
            presa.Simulation(CUBE, set={"body/cub/physics/mass": 1})

    def test_a_closed_simulation_says_so(self):
        simulation = presa.Simulation(CUBE)
        simulation.close()
        simulation.close()
        with self.assertRaisesRegex(RuntimeError, "closed"):
            simulation.step()


class Threads(unittest.TestCase):
    def test_others_run_while_it_steps(self):
        simulation = presa.Simulation(CUBE, duration=60)
        thread = threading.Thread(target=simulation.step, args=(40000,))
        thread.start()
        seen = 0
        while thread.is_alive():
            seen += 1
            time.sleep(0.001)
        # the interpreter may be handed over once by each of the 40 parts of this step, not more often
        self.assertGreater(seen, 45)

    def test_ctrl_c_ends_a_step(self):
        simulation = presa.Simulation(CUBE, duration=1e5)
        simulation.step()
        threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(50_000_000)
        self.assertTrue(simulation.step())

    def test_a_signal_handler_that_closes_is_refused_and_the_step_goes_on(self):
        # closing would destroy what the step is using; a later close() is the first one
        simulation = presa.Simulation(CUBE, duration=1e5)
        refused = []

        def close(*_):
            try:
                simulation.close()
            except RuntimeError as error:
                refused.append(str(error))
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGINT, close)
        try:
            threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
            with self.assertRaises(KeyboardInterrupt):
                simulation.step(50_000_000)
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertEqual(refused, ["the simulation is being stepped"])
        self.assertTrue(simulation.step())
        simulation.close()
        with self.assertRaisesRegex(RuntimeError, "closed"):
            simulation.step()

    def test_another_thread_that_steps_or_closes_is_refused(self):
        simulation = presa.Simulation(CUBE, duration=1e5)
        refused = []

        def meddle():
            while simulation.time == 0:  # the step below has begun
                pass
            for call in (simulation.step, simulation.close):
                try:
                    call()
                except RuntimeError as error:
                    refused.append(str(error))
            os.kill(os.getpid(), signal.SIGINT)  # ends the step

        thread = threading.Thread(target=meddle)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(50_000_000)
        thread.join()
        self.assertEqual(refused, ["the simulation is being stepped"] * 2)


if __name__ == "__main__":
    unittest.main()
