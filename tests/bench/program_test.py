"""That the benchmark program measures what the program itself computes, and that share/bench.sh runs it.

    program_test.py BENCH HAUBERK
"""
import json
import os
import pathlib
import shlex
import socket
import subprocess
import sys
import tempfile
import unittest

BENCH, HAUBERK = sys.argv[1:3]
ROOT = pathlib.Path(__file__).resolve().parents[2]
FAMILIES = {
    "pair": 3 * 3 * (3 * 3 + 3),
    "energy": 6,
    "limit/chain": 6,
    "limit/chainmail": 1,
    "limit/threefold": 1,
    "limit/fourfold": 1,
    "limit/bending": 1,
    "design": 2,
}
QUICK = "^(calibration|pair/.*|energy/.*|limit/(chain/[248]|threefold/.*|chainmail/accurate|bending/.*))$"


def call(*arguments, **options):
    return subprocess.run(arguments, capture_output=True, text=True, cwd=ROOT, check=False, **options)


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        out = cls.folder / "raw.json"
        done = call(BENCH, f"--benchmark_filter={QUICK}", "--benchmark_min_time=0", f"--benchmark_out={out}",
                    "--benchmark_out_format=json")
        assert done.returncode == 0, done.stderr
        cls.benchmarks = json.loads(out.read_text())["benchmarks"]

    def test_lists_every_family(self):
        names = call(BENCH, "--benchmark_list_tests").stdout.split()
        self.assertEqual(len(names), len(set(names)))
        for family, count in FAMILIES.items():
            self.assertEqual(sum(name.startswith(family + "/") for name in names), count, family)
        self.assertEqual(len(names), 1 + sum(FAMILIES.values()))

    def test_runs_the_quick_ones_once(self):
        self.assertGreater(len(self.benchmarks), 115)
        for b in self.benchmarks:
            self.assertNotIn("error_message", b)
            self.assertEqual(b["iterations"], 1, b["name"])
            self.assertGreater(b["calibration"], 0.0)
            if b["name"] != "calibration":
                self.assertGreater(b["evaluations"], 0, b["name"])

    def test_limits_are_those_of_the_program(self):
        limits = [b for b in self.benchmarks if b["name"].startswith("limit/")]
        self.assertEqual(len(limits), 6)
        for k, b in enumerate(limits):
            out = self.folder / str(k)
            done = call(HAUBERK, "run", *shlex.split(b["label"]), "--set", "/expect=[]", "-o", str(out), "--quiet")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            found = json.loads((out / "results.json").read_text())["limits"]
            self.assertEqual(len(found), 1, b["name"])
            counted = (b["evaluations"], b["newton_iterations"], b["value"])
            self.assertEqual(counted, tuple(found[0][k] for k in ("evaluations", "iterations", "value")), b["name"])

    def test_chains_lock_at_their_period(self):
        errors = [b["error"] for b in self.benchmarks if b["name"].startswith("limit/chain/")]
        self.assertEqual(len(errors), 3)
        for error in errors:
            self.assertLess(error, 1e-8)

    def test_a_filter_that_matches_nothing_is_bad_input(self):
        self.assertEqual(call(BENCH, "--benchmark_filter=nothing").returncode, 2)


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def bench(self, *arguments):
        return call(str(ROOT / "share/bench.sh"), *arguments, env={**os.environ, "HAUBERK_BENCH": BENCH})

    def test_runs_stores_and_compares(self):
        options = ["--out", str(self.folder), "--filter", "^limit/chain/[24]$", "--repetitions", "3"]
        done = self.bench(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        stored = self.folder / "bench.json"
        text = stored.read_text()
        run = json.loads(text)
        self.assertEqual([b["name"] for b in run["benchmarks"]], ["limit/chain/2", "limit/chain/4"])
        for secret in (f'"{socket.gethostname()}', str(ROOT), str(self.folder)):
            self.assertNotIn(secret, text)

        for b in run["benchmarks"]:
            b["spread"] = 1000.0  # whatever this machine is doing: time decides nothing here
        run["benchmarks"][1]["work"]["evaluations"] -= 1
        stored.write_text(json.dumps(run))  # is replaced by the run that is compared with it
        done = self.bench(*options, "--compare", str(stored))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("more     limit/chain/4: evaluations", done.stdout)
        self.assertIn("2 benchmarks compared: 2 same", done.stdout)

    def test_bad_input_is_told_before_anything_runs(self):
        malformed = self.folder / "x.json"
        malformed.write_text("{}")
        out = self.folder / "out"
        for options, message in (
            (["--repetitions", "0"], "--repetitions: expected a number from 1 to 999, found '0'"),
            (["--repetitions"], "--repetitions: a value is missing"),
            (["--fast"], "unknown option '--fast'"),
            (["--filter", "nothing"], "--filter: no benchmark matches 'nothing'"),
            (["--compare", str(self.folder / "absent.json")], "absent.json': No such file"),
            (["--compare", str(malformed)], "x.json: /format: expected"),
            (["--out", str(malformed)], "--out: cannot make the folder"),
        ):
            done = self.bench("--out", str(out), *options)
            self.assertEqual(done.returncode, 2, options)
            self.assertIn(message, done.stderr)
            self.assertFalse((out / "bench.json").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
