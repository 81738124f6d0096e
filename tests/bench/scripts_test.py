"""share/bench_record.py and share/bench_compare.py on made-up runs."""
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SHARE = pathlib.Path(__file__).resolve().parents[2] / "share"


def benchmark(name, relative=1.0, spread=0.02, work=None, results=None):
    return {"name": name, "seconds": 1e-3 * relative, "cpu_seconds": 1e-3 * relative, "relative": relative,
            "spread": spread, "work": work or {"evaluations": 100}, "results": results or {}}


def run_of(*benchmarks, **changes):
    run = {"format": "hauberk-bench/1", "commit": "abc", "filter": None, "repetitions": 5,
           "machine": {"processor": "P", "processors": 2, "load_average": [0.5]},
           "build": {"compiler": "C", "type": "T", "flags": "-O3"}, "benchmarks": list(benchmarks)}
    run.update(changes)
    return run


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return str(path)

    def call(self, script, *arguments):
        done = subprocess.run([sys.executable, "-B", str(SHARE / script), *arguments], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr


class Compare(Scripts):
    def compare(self, earlier, now):
        return self.call("bench_compare.py", self.write("earlier.json", earlier), self.write("now.json", now))

    def expect(self, earlier, now, code, *lines):
        found, out, _ = self.compare(earlier, now)
        self.assertEqual((out.splitlines(), found), (list(lines), code))

    def test_slower_beyond_tenth_and_noise(self):
        self.expect(run_of(benchmark("a")), run_of(benchmark("a", 1.12)), 1,
                    "slower   a: 1.12 of the earlier time (1 ms -> 1.12 ms), noise 0.04",
                    "1 benchmarks compared: 1 slower")

    def test_a_tenth_is_not_slower_however_quiet(self):
        self.expect(run_of(benchmark("a", spread=0.0)), run_of(benchmark("a", 1.09, spread=0.0)), 0,
                    "1 benchmarks compared: 1 same")

    def test_noise_of_either_run_counts(self):
        for then, now in ((0.1, 0.12), (0.0, 0.22), (0.22, 0.0)):
            self.expect(run_of(benchmark("a", spread=then)), run_of(benchmark("a", 1.2, spread=now)), 0,
                        "1 benchmarks compared: 1 same")
        code, _, _ = self.compare(run_of(benchmark("a", spread=0.1)), run_of(benchmark("a", 1.3, spread=0.1)))
        self.assertEqual(code, 1)

    def test_faster(self):
        self.expect(run_of(benchmark("a")), run_of(benchmark("a", 0.5)), 0,
                    "faster   a: 0.50 of the earlier time (1 ms -> 500 us), noise 0.04",
                    "1 benchmarks compared: 1 faster")

    def test_a_loaded_machine_is_not_slower_code(self):
        loaded = benchmark("a")
        loaded["seconds"], loaded["cpu_seconds"] = 5e-3, 2e-3  # and the fixed loop took twice as long, too
        self.expect(run_of(benchmark("a")), run_of(loaded), 0, "1 benchmarks compared: 1 same")

    def test_counts_are_exact(self):
        def counting(n):
            return run_of(benchmark("a", work={"evaluations": n, "newton_iterations": 7}))

        self.expect(counting(10000), counting(10001), 1, "more     a: evaluations 10000 -> 10001",
                    "1 benchmarks compared: 1 same")
        self.expect(counting(10000), counting(9999), 0, "less     a: evaluations 10000 -> 9999",
                    "1 benchmarks compared: 1 same")
        self.expect(counting(10000), counting(10000), 0, "1 benchmarks compared: 1 same")

    def test_other_results_are_told(self):
        def found(value):
            return run_of(benchmark("a", results={"value": value}))

        self.expect(found(0.25), found(0.26), 0, "result   a: value 0.25 -> 0.26", "1 benchmarks compared: 1 same")
        self.expect(found(0.25), found(0.25 + 1e-12), 0, "1 benchmarks compared: 1 same")

    def test_new_and_missing(self):
        self.expect(run_of(benchmark("a"), benchmark("b")), run_of(benchmark("b"), benchmark("c")), 0,
                    "new      c", "missing  a", "1 benchmarks compared: 1 same")
        self.expect(run_of(benchmark("a"), benchmark("b")), run_of(benchmark("b"), filter="b"), 0,
                    "1 benchmarks of the earlier run were not run (filter b)", "1 benchmarks compared: 1 same")
        self.expect(run_of(benchmark("b"), filter="b"), run_of(benchmark("a"), benchmark("b")), 0,
                    "1 benchmarks of this run were not in the earlier one (filter b)", "1 benchmarks compared: 1 same")
        code, _, err = self.compare(run_of(benchmark("a")), run_of(benchmark("b")))
        self.assertEqual((code, err), (2, "bench: the two runs have no benchmark in common\n"))

    def test_times_of_other_machines_and_builds_are_not_judged_but_counts_are(self):
        earlier = run_of(benchmark("a"))
        for section, key in (("machine", "processor"), ("build", "compiler"), ("build", "type"), ("build", "flags")):
            now = run_of(benchmark("a", 3.0))
            before = now[section][key]
            now[section][key] = "X"
            self.expect(earlier, now, 0, f"other {key}: X, earlier {before}: times are not judged",
                        "1 benchmarks compared: 1 not judged")
            now["benchmarks"][0]["work"]["evaluations"] = 101
            self.assertEqual(self.compare(earlier, now)[0], 1)

    def test_few_repetitions_have_no_noise_and_no_verdict(self):
        self.expect(run_of(benchmark("a")), run_of(benchmark("a", 3.0, spread=None)), 0,
                    "1 benchmarks compared: 1 not judged")

    def test_malformed_files_are_named_with_the_place(self):
        good = run_of(benchmark("a"))

        def changed(change):
            bad = copy.deepcopy(good)
            change(bad)
            return bad

        cases = [
            ("{", "now.json: not JSON: "),
            ("[]", "now.json: /format: expected \"hauberk-bench/1\""),
            (changed(lambda r: r.update(format="other")), "now.json: /format: expected"),
            (changed(lambda r: r.pop("build")), "now.json: /build: expected an object"),
            (changed(lambda r: r.update(benchmarks=3)), "now.json: /benchmarks: expected an array"),
            (changed(lambda r: r["benchmarks"].append(1)), "now.json: /benchmarks/1: expected an object"),
            (changed(lambda r: r["benchmarks"][0].pop("name")), "/benchmarks/0/name: expected a string"),
            (changed(lambda r: r["benchmarks"].append(benchmark("a"))), "/benchmarks/1/name: 'a' is there twice"),
            (changed(lambda r: r["benchmarks"][0].update(relative=0)), "/benchmarks/0/relative: expected a number > 0"),
            (changed(lambda r: r["benchmarks"][0].update(relative=True)), "/relative: expected a number > 0"),
            (changed(lambda r: r["benchmarks"][0].update(cpu_seconds="1")), "/cpu_seconds: expected a number > 0"),
            (changed(lambda r: r["benchmarks"][0].update(spread=-1)), "/spread: expected a number >= 0, or null"),
            (changed(lambda r: r["benchmarks"][0].update(work={"evaluations": None})), "/work: expected an object"),
            (json.dumps(good).replace('"relative": 1.0', '"relative": NaN'), "/relative: expected a number > 0"),
        ]
        for content, message in cases:
            code, out, err = self.compare(good, content)
            self.assertEqual((code, out), (2, ""), message)
            self.assertIn(message, err)
        code, _, err = self.call("bench_compare.py", str(self.folder / "absent.json"), self.write("now.json", good))
        self.assertEqual(code, 2)
        self.assertIn("absent.json': No such file", err)
        self.assertEqual(self.call("bench_compare.py", "one.json")[0], 2)


class Record(Scripts):
    """Google Benchmark's files, made up."""

    @staticmethod
    def repetition(cpu, loop, **more):
        entry = {"name": "a", "run_name": "a", "run_type": "iteration", "repetitions": 1, "repetition_index": 0,
                 "threads": 1, "iterations": 10, "family_index": 0, "per_family_instance_index": 0,
                 "real_time": 3 * cpu, "cpu_time": cpu, "time_unit": "ns", "calibration": loop,
                 "evaluations": 1.2e3, "value": 0.25, **more}
        context = {"date": "2024-01-01T01:02:03", "host_name": "somewhere", "executable": "/home/me/bench",
                   "num_cpus": 2, "load_avg": [1.5, 1, 1], "compiler": "GNU 12", "build_type": "R", "flags": "-O3"}
        return {"context": context, "benchmarks": [entry]}

    def record(self, *raws):
        files = [self.write(f"{k}.json", raw) for k, raw in enumerate(raws)]
        out = str(self.folder / "bench.json")
        done = self.call("bench_record.py", "--out", out, "--commit", "abc", *files)
        return done, json.loads(pathlib.Path(out).read_text()) if os.path.exists(out) else None

    def test_medians_are_of_times_over_the_fixed_loop(self):
        # The middle repetition ran on a machine half as fast: over the loop all three are 2, 4 and 3 (thousandths).
        (code, out, err), run = self.record(
            self.repetition(2e6, 1.0), self.repetition(8e6, 2.0), self.repetition(3e6, 1.0))
        self.assertEqual((code, err), (0, ""))
        entry = run["benchmarks"][0]
        self.assertAlmostEqual(entry["relative"], 3e-3)
        self.assertAlmostEqual(entry["cpu_seconds"], 3e-3)
        self.assertAlmostEqual(entry["seconds"], 9e-3)
        self.assertAlmostEqual(entry["spread"], 0.33)  # quartiles 2.5 and 3.5
        self.assertEqual(entry["work"], {"evaluations": 1200})
        self.assertEqual(entry["results"], {"value": 0.25})
        self.assertEqual(run["machine"]["load_average"], [1.5, 1.5, 1.5])
        self.assertRegex(out, r"\na +9 ms +3 ms +33.0 % +evaluations 1200, value 0.25\n$")

    def test_hosts_paths_and_dates_are_left_out(self):
        _, run = self.record(self.repetition(1e6, 1.0))
        for secret in ("somewhere", "/home", "2024", "01:02"):
            self.assertNotIn(secret, json.dumps(run))
        self.assertIsNone(run["benchmarks"][0]["spread"])

    def test_what_is_recorded_can_be_compared(self):
        self.record(self.repetition(1e6, 1.0))
        file = str(self.folder / "bench.json")
        self.assertEqual(self.call("bench_compare.py", file, file)[0], 0)

    def test_failures_and_unsteady_counts_leave_no_run(self):
        failed = self.repetition(1e6, 1.0, error_occurred=True, error_message="the limit is stalled")
        (code, _, err), run = self.record(self.repetition(1e6, 1.0), failed)
        self.assertEqual((code, err, run), (1, "bench: a: the limit is stalled\n", None))
        (code, _, err), run = self.record(self.repetition(1e6, 1.0), self.repetition(1e6, 1.0, evaluations=1.3e3))
        self.assertEqual((code, run), (1, None))
        self.assertIn("a: counts differ between repetitions", err)

    def test_other_files_are_refused(self):
        twice = json.dumps(self.repetition(1e6, 1.0)).replace('"evaluations"', '"iterations"')
        for bad in ("{", "[]", "{}", twice):
            (code, _, err), run = self.record(bad)
            self.assertEqual((code, run), (2, None))
            self.assertIn("0.json: not a file of Google Benchmark", err)


if __name__ == "__main__":
    unittest.main()
