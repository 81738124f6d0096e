#!/usr/bin/env python3
"""The package `hauberk` beside the command: the same numbers, errors with their places, Ctrl-C.

Run with PYTHONPATH, HAUBERK (the command) and HAUBERK_EXPERIMENTS (a folder) set, as ctest does.
"""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import numpy

import hauberk

COMMAND = os.environ["HAUBERK"]
EXPERIMENTS = pathlib.Path(os.environ["HAUBERK_EXPERIMENTS"])


def without_times(value):
    """A document without what no two runs have alike."""
    if isinstance(value, dict):
        return {key: without_times(v) for key, v in value.items()
                if key not in ("seconds", "threads", "peak_memory_bytes", "files")}
    return [without_times(v) for v in value] if isinstance(value, list) else value


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def command(self, *words):
        return subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True, check=False)

    def test_numbers_are_those_of_the_command(self):
        for name in ("chain", "oval_links", "hook_and_eye", "roll"):
            file = EXPERIMENTS / f"{name}.json"
            out = pathlib.Path(self.folder.name) / name
            self.assertEqual(self.command("run", file, "-o", out, "--quiet").returncode, 0)
            theirs = hauberk.load(out)
            ours = hauberk.Experiment(file).run()
            self.assertEqual(without_times(ours.raw), without_times(theirs.raw))
            self.assertFalse(ours.failed)
            passed, text = ours.verify()
            self.assertTrue(passed, text)

    def test_a_sweep_is_a_table_and_its_rows_are_results(self):
        study = {
            "name": "study", "task": "sweep", "length_unit": "mm",
            "elements": {"ring": {"shape": "torus_union", "tori": [{"name": "ring"}],
                                  "parameters": {"ring.R": 5, "ring.r0": 0.7, "ring.r1": 0.7}}},
            "cell": {"vectors": [[12, 0], [0, 100]],
                     "place": [{"element": "ring", "position": [0, 0, 0], "rotation": {"axis": [1, 0, 0], "degrees": 90}},
                               {"element": "ring", "position": [6, 0, 0]}]},
            "load_case": {"plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"]},
            "sweep": {"vary": [{"name": "R", "pointers": ["/elements/ring/parameters/ring.R"], "values": [5, 5.2, 0.1]}]}}
        results = hauberk.Experiment(study).run()
        rows = results.rows
        self.assertEqual(rows.dtype.names, ("R", "stretch 0", "status"))
        self.assertEqual(list(rows["R"]), [5, 5.2, 0.1])
        for k, radius in enumerate((5, 5.2)):  # the closed form of a chain
            self.assertAlmostEqual(rows["stretch 0"][k], (4 * radius - 2.8) / 12 - 1, delta=1e-8)
            self.assertEqual(results.row(k).value(0, "stretch"), rows["stretch 0"][k])
        self.assertTrue(numpy.isnan(rows["stretch 0"][2]))
        with self.assertRaisesRegex(hauberk.InputError, "row 2: it has no result .refused"):
            results.row(2)
        with self.assertRaisesRegex(hauberk.InputError, "row 3: the sweep has 3 rows"):
            results.row(3)
        with self.assertRaisesRegex(KeyError, "row.0."):
            results.value(0, "stretch")
        with self.assertRaisesRegex(hauberk.InputError, "no results of a sweep"):
            results.row(0).rows

    def test_plugin_path_is_one_folder_or_several(self):
        for folders in (self.folder.name, [self.folder.name], (pathlib.Path(self.folder.name),)):
            self.assertEqual(hauberk.Experiment(EXPERIMENTS / "chain.json", plugin_path=folders).check(), [])
        with self.assertRaisesRegex(hauberk.InputError, "is not a folder"):
            hauberk.Experiment(EXPERIMENTS / "chain.json", plugin_path="/no/such").plan()

    def test_a_chain_has_its_exact_value_and_poses(self):
        results = hauberk.Experiment(EXPERIMENTS / "chain.json").run(threads=1)
        self.assertAlmostEqual(results.value(0, "stretch"), 13 / 30, delta=1e-9)
        self.assertEqual(results.limits.dtype.names[:3], ("direction_deg", "sense", "value"))
        self.assertEqual(results.limits["status"][0], "locked")
        poses = results.poses(0)
        self.assertEqual(poses.shape, (2, 7))
        self.assertAlmostEqual(numpy.linalg.norm(poses[1, :3] - poses[0, :3]), 8.6, delta=1e-8)
        self.assertEqual(results.poses().shape, (2, 7))
        contacts = results.contacts(0)
        self.assertEqual(contacts["points"].shape[1:], (2, 3))
        # Two contacts a cell of 12 mm by its width carry a tension T: each ring T times the width.
        (ax, _), (_, by) = results.raw["scene"]["cell_vectors"]
        forces = hauberk.forces_for_tension(results, 0, 100.0)
        self.assertAlmostEqual(forces.max() / (100.0 * abs(by) * 1e-3), 1.0, delta=1e-4)
        self.assertEqual(ax, 12)

    def test_experiments_are_dicts_texts_or_files_with_values_set(self):
        text = (EXPERIMENTS / "chain.json").read_text() + "\n// a comment {\n"
        wider = hauberk.Experiment(text).set("/elements/link/parameters/ring.R", 5.1)
        # Centres 2 (R - r) apart for 6 at rest.
        self.assertAlmostEqual(wider.run().value(0, "stretch"), 2 * 4.4 / 6 - 1, delta=1e-9)
        resolved = wider.run().raw["experiment"]
        self.assertEqual(hauberk.Experiment(resolved).check(), [])
        self.assertEqual(wider.plan()["task"], {})

    def test_mistakes_have_their_places(self):
        experiment = hauberk.Experiment(EXPERIMENTS / "chain.json").set("/solver/preset", "quick")
        (problem,) = experiment.check()
        self.assertEqual(problem.pointer, "/solver/preset")
        self.assertIn("quick", problem.message)
        with self.assertRaisesRegex(hauberk.InputError, "/solver/preset"):
            experiment.run()
        with self.assertRaises(hauberk.InputError):
            hauberk.Experiment("no_such_file.json")
        with self.assertRaises(hauberk.InputError):
            hauberk.load(EXPERIMENTS / "chain.json")
        with self.assertRaisesRegex(hauberk.InputError, "threads"):
            hauberk.Experiment(EXPERIMENTS / "chain.json").run(threads=0)

    def test_files_are_those_of_the_command_and_are_not_replaced_unasked(self):
        out = pathlib.Path(self.folder.name) / "out"
        experiment = hauberk.Experiment(EXPERIMENTS / "chain.json")
        results = experiment.run(output=out)
        self.assertEqual({"results.json", "timings.json", "limits.csv", "profile.svg"}, {file.name for file in out.iterdir()})
        self.assertEqual(json.loads((out / "results.json").read_text()), results.raw)
        with self.assertRaisesRegex(hauberk.InputError, "force"):
            experiment.run(output=out)
        experiment.run(output=out, force=True)
        self.assertEqual(self.command("verify", out).returncode, 0)

    def test_exports_what_the_command_does(self):
        target = pathlib.Path(self.folder.name) / "chain.stl"
        said = hauberk.export(EXPERIMENTS / "chain.json", target, repeat=(2, 1), require_gap=0.5)
        self.assertIn("smallest gap 0.6 mm", said)
        self.assertGreater(target.stat().st_size, 84)
        with self.assertRaisesRegex(hauberk.InputError, "exists already; give another name with -o, or --force"):
            hauberk.export(EXPERIMENTS / "chain.json", target)
        sizes = []
        for separate in False, True:
            model = target.with_name(f"chain_{separate}.3mf")
            hauberk.export(EXPERIMENTS / "chain.json", model, repeat=(2, 1), separate=separate)
            sizes.append(model.stat().st_size)
        self.assertGreater(sizes[0], 2 * sizes[1])  # four rings written out, and one placed four times
        with self.assertRaisesRegex(hauberk.ComputationError, "0.6 mm apart"):
            hauberk.export(EXPERIMENTS / "chain.json", target.with_name("other.stl"), repeat=(2, 1), require_gap=0.7)

    def design(self):
        return hauberk.Experiment(EXPERIMENTS.parents[1] / "optimizers" / "sqp" / "example.json")

    def test_a_function_is_an_optimizer(self):
        accepted = []

        def gauss_newton(problem):
            x = problem.start
            accepted.append(x)
            for _ in range(20):
                r, jacobian = problem.residuals(x)
                step = numpy.clip(x - numpy.linalg.lstsq(jacobian, r, rcond=None)[0], problem.lower, problem.upper) - x
                x = x + problem.safe_step(x, step) * step
                if not problem.evaluate(x).ok or numpy.abs(x - accepted[-1]).max() < 1e-9:
                    break
                accepted.append(x)
                if not problem.accept(x):
                    break

        results = self.design().run(optimizer=gauss_newton)
        self.assertFalse(results.failed, results.summary)
        design = results.raw["design"]
        # Centres 4 (R - r) apart for a stretch of one half from 12.
        self.assertAlmostEqual(design["variables"][0]["final"], 5.2, delta=1e-3)
        self.assertAlmostEqual(design["targets"][0]["recomputed"], 0.5, delta=1e-3)
        self.assertEqual(design["status"], "converged")
        self.assertEqual(len(design["history"]), len(accepted))
        self.assertEqual(results.raw["experiment"]["design"]["optimizer"], {"plugin": "caller"})
        passed, text = results.verify()
        self.assertTrue(passed, text)
        # Without the function nobody knows what it was.
        (problem,) = hauberk.Experiment(results.raw["experiment"]).check()
        self.assertEqual(problem.pointer, "/design/optimizer/plugin")
        self.assertIn("caller", problem.message)

    def test_what_a_problem_answers_is_consistent(self):
        seen, starts = [], []

        def look(problem):
            x, h = problem.start, 1e-3
            at, (up, down) = problem.evaluate(x), problem.evaluate_many([x + h, x - h])
            self.assertAlmostEqual((up.value - down.value) / (2 * h), at.gradient[0], delta=1e-4 * abs(at.gradient[0]))
            r, jacobian = problem.residuals(x)
            self.assertAlmostEqual(0.5 * r @ r, at.value, delta=1e-15)
            self.assertAlmostEqual((jacobian.T @ r)[0], at.gradient[0], delta=1e-12)
            c, slope = problem.constraints(x)
            self.assertEqual(slope.shape, (len(c), 1))
            self.assertEqual(problem.equality_count, 0)
            more, _ = problem.constraints(x + h)
            numpy.testing.assert_allclose((more - c) / h, slope[:, 0], atol=1e-3)
            with self.assertRaisesRegex(ValueError, "outside its bounds"):
                problem.evaluate(problem.upper + 1)
            with self.assertRaisesRegex(ValueError, "one per variable"):
                problem.evaluate([1.0, 2.0])
            seen.append(problem)
            starts.append(x)

        results = self.design().run(optimizer=look)
        # It accepted nothing, so that the start is the result.
        self.assertEqual(results.raw["design"]["variables"][0]["final"], starts[-1][0])
        with self.assertRaisesRegex(RuntimeError, "over"):
            seen[0].evaluate([5.0])

    def test_the_point_that_is_returned_is_judged(self):
        # Every second ring is 12 from the next: at R = 5.28 they are 0.04 apart, and 0.1 are asked for.
        design = self.design().set("/expect", []).run(optimizer=lambda problem: numpy.array([5.28])).raw["design"]
        self.assertEqual(design["variables"][0]["final"], 5.28)
        self.assertEqual(design["status"], "infeasible")
        self.assertIn("violated", design["message"])

    def test_what_cannot_be_evaluated_is_no_iterate(self):
        met = []

        def collide(problem):
            with self.assertRaisesRegex(ValueError, "elements collide"):
                problem.accept([5.9])
            met.append(problem.start)

        design = self.design().set("/expect", []).run(optimizer=collide).raw["design"]
        self.assertTrue(met)
        self.assertEqual(design["variables"][0]["final"], met[-1][0])
        with self.assertRaisesRegex(ValueError, "elements collide"):
            self.design().run(optimizer=lambda problem: numpy.array([5.9]))

    def test_what_an_optimizer_raises_ends_the_run(self):
        def broken(problem):
            raise ZeroDivisionError("of mine")

        with self.assertRaisesRegex(ZeroDivisionError, "of mine"):
            self.design().run(optimizer=broken)
        with self.assertRaisesRegex(TypeError, "argument"):
            self.design().run(optimizer=lambda: None)
        with self.assertRaisesRegex(hauberk.InputError, "expected a function"):
            self.design().run(optimizer="sqp")
        with self.assertRaisesRegex(hauberk.InputError, "no design"):
            hauberk.Experiment(EXPERIMENTS / "chain.json").run(optimizer=broken)
        with self.assertRaisesRegex(hauberk.InputError, "no design"):
            self.design().set("/task", "limits").set("/load_case/directions_deg", [0]).run(optimizer=broken)

        def nested(problem):
            self.design().run()

        with self.assertRaisesRegex(hauberk.InputError, "another run"):
            self.design().run(optimizer=nested)
        self.assertFalse(hauberk.Experiment(EXPERIMENTS / "chain.json").run().failed)

    def test_questions_of_other_threads_end_with_the_function(self):
        ended = []

        def careless(problem):
            points = numpy.linspace(problem.lower, problem.upper, 400)
            asking = threading.Event()

            def ask():
                asking.set()
                with self.assertRaisesRegex(RuntimeError, "over"):
                    while True:
                        problem.evaluate_many(points)
                ended.append(True)

            thread = threading.Thread(target=ask)
            thread.start()
            asking.wait()
            time.sleep(0.02)
            with self.assertRaisesRegex(RuntimeError, "one question at a time"):
                problem.evaluate(problem.start)
            threads.append(thread)

        threads = []
        self.assertFalse(self.design().run(optimizer=careless).failed)
        for thread in threads:
            thread.join()
        self.assertEqual(ended, [True] * len(threads))

    def test_interrupts_reach_an_optimizer(self):
        def endless(problem):
            os.kill(os.getpid(), signal.SIGINT)
            while True:
                problem.evaluate(problem.start)

        with self.assertRaises(KeyboardInterrupt) as stopped:
            self.design().run(optimizer=endless)
        self.assertEqual(stopped.exception.results.raw["design"]["status"], "interrupted")

    def test_interrupts_keep_what_was_found_and_other_threads_run(self):
        slow = hauberk.Experiment(EXPERIMENTS / "paper" / "chainmail_c.json")
        ticks = []
        done = threading.Event()

        def others():
            while not done.wait(0.02):
                ticks.append(time.monotonic())
                if len(ticks) == 40:
                    os.kill(os.getpid(), signal.SIGINT)

        before = signal.getsignal(signal.SIGINT)
        other = threading.Thread(target=others)
        other.start()
        try:
            with self.assertRaises(KeyboardInterrupt) as stopped:
                slow.run()
        finally:
            done.set()
            other.join()
        self.assertGreaterEqual(len(ticks), 40, "the interpreter was held while the program computed")
        self.assertEqual(stopped.exception.results.raw["design"]["status"], "interrupted")
        self.assertIs(signal.getsignal(signal.SIGINT), before)
        # Nothing is left of it.
        self.assertFalse(hauberk.Experiment(EXPERIMENTS / "chain.json").run().failed)


if __name__ == "__main__":
    unittest.main()
