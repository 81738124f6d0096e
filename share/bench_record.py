#!/usr/bin/env python3
"""Makes one run, as share/bench.sh stores it, out of Google Benchmark's files, one for each repetition.

    share/bench_record.py --out bench.json [--commit NAME] [--filter REGEX] REPETITION.json...

Writes the run and prints it as a table. Only what is named here is taken over: no host names, paths or dates. Exit
code 1: a benchmark failed, or its counts differ between repetitions (nothing is written); 2: bad input.
"""
import argparse
import json
import os
import statistics
import sys

from bench_compare import FORMAT, BadInput, duration

# Counters that are no work but what was computed, and the fixed loop's time (tests/bench/measure.hpp).
RESULTS = ("value", "error")
CALIBRATION = "calibration"
# What Google Benchmark puts beside the counters.
NO_COUNTERS = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
               "repetition_index", "threads", "iterations", "real_time", "cpu_time", "time_unit", "label"}
SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


class Failed(Exception):
    """What was measured is no result."""


def without_duplicates(pairs):
    """A counter that is named like something of Google Benchmark's would replace it."""
    if len({key for key, _ in pairs}) != len(pairs):
        raise ValueError(f"a key is there twice: {[key for key, _ in pairs]}")
    return dict(pairs)


def read_repetition(path):
    try:
        with open(path, encoding="utf-8") as file:
            raw = json.load(file, object_pairs_hook=without_duplicates)
        return raw["context"], raw["benchmarks"]
    except OSError as error:
        raise BadInput(f"cannot read '{path}': {error.strerror}") from error
    except (ValueError, TypeError, KeyError) as error:
        raise BadInput(f"{path}: not a file of Google Benchmark: {error}") from error


def spread(values):
    """Interquartile range over median; None for fewer than three values."""
    if len(values) < 3:
        return None
    quartiles = statistics.quantiles(values, n=4, method="inclusive")
    return (quartiles[2] - quartiles[0]) / statistics.median(values)


def rounded(value, digits=4):
    return None if value is None else float(f"{value:.{digits}g}")


def summary(name, repetitions):
    """One benchmark out of its repetitions."""
    for r in repetitions:
        if r.get("error_occurred"):
            raise Failed(f"{name}: {r.get('error_message', 'failed')}")
    counters = [{k: v for k, v in r.items() if k not in NO_COUNTERS} for r in repetitions]
    calibration = [c.pop(CALIBRATION, 0.0) for c in counters]
    if not all(loop > 0.0 for loop in calibration):
        raise BadInput(f"{name}: it was measured without the fixed loop (counter {CALIBRATION})")
    for c in counters[1:]:
        if c != counters[0]:
            raise Failed(f"{name}: counts differ between repetitions: {counters[0]}, {c}")
    wall, cpu = ([r[clock] * SECONDS[r["time_unit"]] for r in repetitions] for clock in ("real_time", "cpu_time"))
    relative = [seconds / loop for seconds, loop in zip(cpu, calibration)]
    entry = {"name": name}
    if repetitions[0].get("label"):
        entry["run"] = repetitions[0]["label"]
    entry["seconds"] = rounded(statistics.median(wall))
    entry["cpu_seconds"] = rounded(statistics.median(cpu))
    entry["relative"] = rounded(statistics.median(relative))
    entry["spread"] = rounded(spread(relative), 2)
    entry["work"] = {k: int(v) for k, v in counters[0].items() if k not in RESULTS}
    entry["results"] = {k: v for k, v in counters[0].items() if k in RESULTS}
    return entry, calibration


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                key, _, value = line.partition(":")
                if key.strip() == "model name":
                    return value.strip()
    except OSError:
        pass
    return "unknown"


def record(files, commit, regex):
    """The run as stored."""
    raws = [read_repetition(path) for path in files]
    by_name = {}
    for _, benchmarks in raws:
        for b in benchmarks:
            by_name.setdefault(b["name"], []).append(b)
    for name, repetitions in by_name.items():
        if len(repetitions) != len(files):
            raise BadInput(f"{name}: in {len(repetitions)} of {len(files)} files")
    if not by_name:
        raise BadInput("there is no benchmark in these files")
    entries, loops = [], []
    for name, repetitions in by_name.items():
        entry, calibration = summary(name, repetitions)
        entries.append(entry)
        loops += calibration
    context = raws[0][0]
    return {
        "format": FORMAT,
        "commit": commit,
        "machine": {
            "processor": processor(),
            "processors": context.get("num_cpus"),
            # At the beginning of each repetition.
            "load_average": [round(c["load_avg"][0], 2) for c, _ in raws if c.get("load_avg")],
        },
        "build": {
            "version": context.get("version"),
            "compiler": context.get("compiler"),
            "type": context.get("build_type"),
            "flags": context.get("flags"),
        },
        "repetitions": len(files),
        "filter": regex or None,
        "calibration": {"seconds": rounded(statistics.median(loops)), "spread": rounded(spread(loops), 2)},
        "benchmarks": entries,
    }


def text(run):
    """JSON with a line for each benchmark."""
    head = json.dumps({k: v for k, v in run.items() if k != "benchmarks"}, indent=1)
    entries = ",\n".join("  " + json.dumps(entry) for entry in run["benchmarks"])
    return head[:-2] + f',\n "benchmarks": [\n{entries}\n ]\n}}\n'


def write(path, content):
    """All or nothing."""
    partial = f"{path}.part"
    try:
        with open(partial, "w", encoding="utf-8") as file:
            file.write(content)
        os.replace(partial, path)
    except OSError as error:
        raise BadInput(f"cannot write '{path}': {error.strerror}") from error


def table(run):
    rows = [("benchmark", "time", "cpu", "spread", "counters")]
    for b in run["benchmarks"]:
        counters = [f"{k} {v}" for k, v in b["work"].items()] + [f"{k} {v:.6g}" for k, v in b["results"].items()]
        noise = "-" if b["spread"] is None else f"{100 * b['spread']:.1f} %"
        rows.append((b["name"], duration(b["seconds"]), duration(b["cpu_seconds"]), noise, ", ".join(counters)))
    widths = [max(len(row[k]) for row in rows) for k in range(4)]
    return "\n".join(
        f"{row[0]:<{widths[0]}}  {row[1]:>{widths[1]}}  {row[2]:>{widths[2]}}  {row[3]:>{widths[3]}}  {row[4]}".rstrip()
        for row in rows)


def main(arguments):
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--out", required=True)
    parser.add_argument("--commit", default="unknown")
    parser.add_argument("--filter", default="")
    parser.add_argument("files", nargs="+")
    options = parser.parse_args(arguments)
    try:
        run = record(options.files, options.commit, options.filter)
        write(options.out, text(run))
    except Failed as error:
        print(f"bench: {error}", file=sys.stderr)
        return 1
    except BadInput as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2
    print(table(run))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
