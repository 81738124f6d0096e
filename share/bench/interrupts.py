#!/usr/bin/env python3
"""How soon a run ends after Ctrl-C: every experiment that runs longer than a moment is interrupted at random moments.

    share/bench/interrupts.py HAUBERK [--times N] [--seed S] [EXPERIMENT.json ...]

Prints a line per scene with its worst answer and then the percentiles over all interrupts. Without names: all of
share/experiments and the examples of plugins. A scene that is done within the delays is run with 64 starts, which
makes it slow. A run that ends with another exit code than 130 is a failure.
"""

import argparse
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

SLOW = "--set", "/solver/starts=64"
ROOT = pathlib.Path(__file__).resolve().parents[2]


def experiments():
    found = []
    for pattern in ("share/experiments/*.json", "share/experiments/paper/*.json", "share/experiments/speed/*.json",
                    "shapes/*/example.json", "loadcases/*/example.json", "optimizers/*/example.json",
                    "tests/experiments/scenes/*.json"):
        found += sorted(ROOT.glob(pattern))
    return found


def interrupted(program, file, delay, folder, changes=()):
    """Seconds from the signal to the end of the process; None: it was done before. Raises where it ended otherwise."""
    process = subprocess.Popen([program, "run", str(file), "-o", folder, "--force", "--quiet", "--threads", "2", *changes],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        process.wait(delay)
        return None
    except subprocess.TimeoutExpired:
        pass
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)
    error = process.communicate()[1]
    seconds = time.monotonic() - begin
    if process.returncode in (0, 1) and seconds < 0.2:
        return None  # it was ending
    if process.returncode != 130:
        raise RuntimeError(f"{file}: exit code {process.returncode} after an interrupt at {delay:.2f} s: {error.decode()}")
    return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--times", type=int, default=4, help="interrupts per scene")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("files", nargs="*")
    options = parser.parse_intermixed_args()
    random.seed(options.seed)
    answers, scenes = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for file in [pathlib.Path(f) for f in options.files] or experiments():
            for changes in (), SLOW:
                delays = [random.uniform(0.1, 4.0) for _ in range(options.times)]
                seconds = [interrupted(options.program, file, delay, folder + "/out", changes) for delay in delays]
                worst = [s for s in seconds if s is not None]
                if len(worst) > options.times // 2:
                    break
            if not worst:
                continue  # too quick to be interrupted
            scenes += 1
            answers += worst
            print(f"{max(worst):8.3f} s  {len(worst)} times  {file.relative_to(ROOT) if file.is_relative_to(ROOT) else file}",
                  flush=True)
    answers.sort()
    at = lambda part: answers[min(len(answers) - 1, int(part * len(answers)))]
    print(f"{scenes} scenes, {len(answers)} interrupts: median {at(0.5):.3f} s, 90 % {at(0.9):.3f} s, 99 % {at(0.99):.3f} s, "
          f"worst {answers[-1]:.3f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
