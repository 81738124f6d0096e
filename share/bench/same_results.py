#!/usr/bin/env python3
"""Whether two programs leave the same results, bit for bit: for changes that must not change numbers.

    share/bench/same_results.py PROGRAM OTHER FOLDER [EXPERIMENT ...] [--threads N] [--set PATH=VALUE ...]

Runs the experiments (default: all of share/experiments) with both, into FOLDER/one and FOLDER/other; what is there is not
run again. Compares results.json without its provenance, number by number as they are written, and every other file byte
by byte, but for timings.json. Prints a line per experiment, with the first places that differ. Exit code 1: some do.
"""

import argparse
import concurrent.futures
import filecmp
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
APART = {"results.json", "timings.json"}


def run(program, experiment, out, threads, changes):
    done = out / "exit_code"
    if not done.exists():
        command = [program, "run", str(experiment), "-o", str(out), "--quiet", "--yes", "--force", "--threads", str(threads)]
        for change in changes:
            command += ["--set", change]
        code = subprocess.run(command, capture_output=True).returncode
        out.mkdir(parents=True, exist_ok=True)  # bad input leaves no folder
        done.write_text(str(code))
    return done.read_text()


def differences(a, b, at=""):
    """Places at which two documents differ; numbers as their text in the file, so that every digit counts."""
    if type(a) is not type(b):
        yield at
    elif isinstance(a, dict):
        for key in sorted(set(a) | set(b)):
            if key in a and key in b:
                yield from differences(a[key], b[key], f"{at}/{key}")
            else:
                yield f"{at}/{key}"
    elif isinstance(a, list):
        if len(a) != len(b):
            yield f"{at} ({len(a)} and {len(b)} entries)"
        else:
            for k, (x, y) in enumerate(zip(a, b)):
                yield from differences(x, y, f"{at}/{k}")
    elif a != b:
        yield f"{at} ({a} and {b})"


def results_of(folder):
    file = folder / "results.json"
    if not file.exists():
        return None
    document = json.loads(file.read_text(), parse_float=str, parse_int=str)
    document.pop("provenance", None)
    return document


def compare(one, other):
    found = list(differences(results_of(one), results_of(other)))
    names = {f.relative_to(folder) for folder in (one, other) for f in folder.rglob("*") if f.is_file()}
    for name in sorted(n for n in names if n.name not in APART and not any(part.startswith(".") for part in n.parts)):
        if not ((one / name).exists() and (other / name).exists() and filecmp.cmp(one / name, other / name, shallow=False)):
            found.append(str(name))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("other")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("experiments", nargs="*", type=pathlib.Path)
    parser.add_argument("--threads", type=int, default=1, help="of every run (default: %(default)s); two run at a time")
    parser.add_argument("--set", action="append", default=[], dest="changes", help="as of `hauberk run`")
    options = parser.parse_args()
    experiments = options.experiments or sorted((ROOT / "share/experiments").glob("*.json"))
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for experiment in experiments:
            folders = [options.folder / side / experiment.stem for side in ("one", "other")]
            codes = list(pool.map(lambda of: run(of[0], experiment, of[1], options.threads, options.changes),
                                  zip((options.program, options.other), folders)))
            found = compare(*folders)
            wrong += bool(found)
            print(f"{experiment.stem}: exit codes {codes[0]} and {codes[1]}, "
                  + (f"{len(found)} places differ: {', '.join(found[:3])}" if found else "the same"), flush=True)
    print(f"{len(experiments)} experiments, {wrong} not the same")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
