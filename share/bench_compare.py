#!/usr/bin/env python3
"""Compares two runs of share/bench.sh.

    share/bench_compare.py EARLIER.json NOW.json

Times are judged by processor time over that of a fixed loop just before and after, medians of the repetitions. A
benchmark is slower or faster if that changed by more than a tenth and by more than the noise, which is the sum of
both runs' spreads (interquartile range over median). Runs of another processor, compiler or build are shown but not
judged, nor are runs of fewer than three repetitions. Counted work is compared exactly, whatever the machine.

Exit code 0: nothing is slower and no count grew; 1: something is or did; 2: bad input.
"""
import json
import math
import sys

FORMAT = "hauberk-bench/1"
TOLERANCE = 0.10
# Results are real numbers: what differs by more than this is another result.
SAME_RESULT = 1e-9


class BadInput(Exception):
    """A file that is no run, and why."""


def read_run(path):
    """The run in a file, its benchmarks by name. Raises BadInput with the file and the place."""
    try:
        with open(path, encoding="utf-8") as file:
            run = json.load(file)
    except OSError as error:
        raise BadInput(f"cannot read '{path}': {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise BadInput(f"{path}: not JSON: {error}") from error
    if not isinstance(run, dict) or run.get("format") != FORMAT:
        raise BadInput(f"{path}: /format: expected \"{FORMAT}\", as share/bench.sh writes it")
    for place, kind in (("machine", dict), ("build", dict), ("benchmarks", list)):
        if not isinstance(run.get(place), kind):
            raise BadInput(f"{path}: /{place}: expected {'an object' if kind is dict else 'an array'}")
    by_name = {}
    for index, entry in enumerate(run["benchmarks"]):
        problem = entry_problem(entry)
        if problem:
            raise BadInput(f"{path}: /benchmarks/{index}{problem}")
        if entry["name"] in by_name:
            raise BadInput(f"{path}: /benchmarks/{index}/name: '{entry['name']}' is there twice")
        by_name[entry["name"]] = entry
    run["benchmarks"] = by_name
    return run


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def entry_problem(entry):
    """Place and reason why a benchmark of a file cannot be used, else empty."""
    if not isinstance(entry, dict):
        return ": expected an object"
    if not isinstance(entry.get("name"), str):
        return "/name: expected a string"
    for key in ("cpu_seconds", "relative"):
        if not is_number(entry.get(key)) or entry[key] <= 0:
            return f"/{key}: expected a number > 0"
    if entry.get("spread") is not None and (not is_number(entry["spread"]) or entry["spread"] < 0):
        return "/spread: expected a number >= 0, or null"
    for key in ("work", "results"):
        if not isinstance(entry.get(key), dict) or not all(map(is_number, entry[key].values())):
            return f"/{key}: expected an object of numbers"
    return ""


def other_machine(earlier, now):
    """What of the two runs' machines and builds makes times incomparable: sentences."""
    places = [("machine", "processor"), ("build", "compiler"), ("build", "type"), ("build", "flags")]
    out = []
    for section, key in places:
        before, after = earlier[section].get(key), now[section].get(key)
        if before != after:
            out.append(f"other {key}: {after}, earlier {before}")
    return out


def time_verdict(then, now):
    """(verdict, ratio, noise): slower, faster or same; noise is None where there are too few repetitions."""
    ratio = now["relative"] / then["relative"]
    if then.get("spread") is None or now.get("spread") is None:
        return "not judged", ratio, None
    noise = then["spread"] + now["spread"]
    least = 1.0 + max(TOLERANCE, noise)
    if ratio > least:
        return "slower", ratio, noise
    return "faster" if ratio < 1.0 / least else "same", ratio, noise


def work_changes(then, now):
    """Counts that differ, (name, then, now); a count that only one of the two has is none of the other's."""
    names = [name for name in then["work"] if name in now["work"]]
    return [(n, then["work"][n], now["work"][n]) for n in names if then["work"][n] != now["work"][n]]


def result_changes(then, now):
    def differ(a, b):
        return abs(a - b) > SAME_RESULT * max(1.0, abs(a), abs(b))

    names = [name for name in then["results"] if name in now["results"]]
    return [(n, then["results"][n], now["results"][n]) for n in names if differ(then["results"][n], now["results"][n])]


def duration(seconds):
    for unit, factor in (("s", 1.0), ("ms", 1e3), ("us", 1e6)):
        if seconds * factor >= 1.0:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def only_one(has, lacks, word, lacking_run, filtered):
    """Lines for benchmarks that one run lacks; a single one where a filter explains it."""
    names = [name for name in has if name not in lacks]
    if names and lacking_run.get("filter"):
        return [f"{len(names)} benchmarks {filtered} (filter {lacking_run['filter']})"]
    return [f"{word:<8} {name}" for name in names]


def compare(earlier, now):
    """(lines to print, whether something became worse)."""
    before, after = earlier["benchmarks"], now["benchmarks"]
    both = [name for name in after if name in before]
    if not both:
        raise BadInput("the two runs have no benchmark in common")
    other = other_machine(earlier, now)
    lines, counts, worse = [], {"slower": 0, "faster": 0, "same": 0, "not judged": 0}, False
    for sentence in other:
        lines.append(f"{sentence}: times are not judged")
    for name in both:
        verdict, ratio, noise = time_verdict(before[name], after[name])
        if other:
            verdict = "not judged"
        counts[verdict] += 1
        if verdict in ("slower", "faster"):
            worse |= verdict == "slower"
            times = f"{duration(before[name]['cpu_seconds'])} -> {duration(after[name]['cpu_seconds'])}"
            lines.append(f"{verdict:<8} {name}: {ratio:.2f} of the earlier time ({times}), noise {noise:.2f}")
        for what, old, new in work_changes(before[name], after[name]):
            worse |= new > old
            lines.append(f"{'more' if new > old else 'less':<8} {name}: {what} {old:g} -> {new:g}")
        for what, old, new in result_changes(before[name], after[name]):
            lines.append(f"{'result':<8} {name}: {what} {old:.10g} -> {new:.10g}")
    lines += only_one(after, before, "new", earlier, "of this run were not in the earlier one")
    lines += only_one(before, after, "missing", now, "of the earlier run were not run")
    lines.append(f"{len(both)} benchmarks compared: " + ", ".join(f"{n} {what}" for what, n in counts.items() if n))
    return lines, worse


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        lines, worse = compare(*map(read_run, arguments))
    except BadInput as error:
        print(f"bench: {error}", file=sys.stderr)
        return 2
    print("\n".join(lines))
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
