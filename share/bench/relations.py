#!/usr/bin/env python3
"""Exact relations between the rows of a sweep: a row that contains another one is no nearer.

    share/bench/relations.py HAUBERK FOLDER [--threads N]

A sheet of thin 4-in-1 chainmail, compressed at 45 degrees with the shear held: clearances of 0, 0.05, 0.1, 0.15 and 0.2
mm, z fixed, within 0.5 mm and free, cells of 1 x 1, 2 x 1 and 2 x 2: 45 rows. A row contains another one whose clearance
is no smaller, whose z has no more room and whose cell divides its own. Of all such pairs, those are violated whose
contained row is further by more than a millionth. Single searches (`solver.lessons: false`) are held beside the default.
Prints the pairs and the violated ones by what differs, every violated one of the default, and processor time. Runs that
FOLDER holds are gone on with.
"""

import argparse
import collections
import itertools
import json
import pathlib
import shutil
import subprocess

from furthest import processor_seconds

VIOLATED = 1e-6
CLEARANCES, ROOMS, REPEATS = [0, 0.05, 0.1, 0.15, 0.2], [0, 0.5, "free"], [[1, 1], [2, 1], [2, 2]]


def ring(x, y, degrees):
    return {"element": "ring", "position": [x, y, 0], "rotation": {"axis": [1, 0, 0], "degrees": degrees}}


def sweep(lessons):
    vary = [("clearance", "/solver/clearance", CLEARANCES), ("z", "/load_case/out_of_plane", ROOMS),
            ("cell", "/cell/repeat", REPEATS)]
    return {
        "name": "thin_4in1", "task": "sweep", "length_unit": "mm", "seed": 1,
        "elements": {"ring": {"shape": "torus_union", "tori": [{"name": "ring"}],
                              "parameters": {"ring.R": 4.9, "ring.r0": 0.7, "ring.r1": 0.7}}},
        "cell": {"vectors": [[12.2, 0], [0, 6.0]], "repeat": [1, 1], "place": [ring(0, 0, -36.5), ring(6.1, 3.0, 36.5)]},
        "load_case": {"plugin": "in_plane_periodic", "directions_deg": [45], "senses": ["compress"], "hold": ["shear"],
                      "out_of_plane": 0},
        "solver": {"clearance": 0, "lessons": lessons},
        "sweep": {"vary": [{"name": name, "pointers": [pointer], "values": values} for name, pointer, values in vary]},
    }


def contains(row, other):
    """Whether the states of the other row are this one's, too."""
    return (CLEARANCES.index(row[0]) <= CLEARANCES.index(other[0]) and ROOMS.index(row[1]) >= ROOMS.index(other[1])
            and all(n % m == 0 for n, m in zip(row[2], other[2])))


def run(program, folder, name, lessons, options):
    """How far every row is compressed, in the order of the sweep (None: not locked), and seconds of processor time."""
    file, out, took = folder / f"{name}.json", folder / name, folder / f"{name}.processor_seconds"
    file.write_text(json.dumps(sweep(lessons)))
    begin = processor_seconds()
    done = subprocess.run([program, "run", str(file), "-o", str(out), "--quiet", "--yes", "--resume", *options],
                          capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise RuntimeError(f"{file}: exit code {done.returncode}: {done.stderr}")
    if not took.exists():
        took.write_text(str(processor_seconds() - begin))
    rows = json.loads((out / "results.json").read_text())["sweep"]["rows"]
    limits = [row["result"]["limits"][0] for row in rows]
    return [-limit["value"] if limit["status"] == "locked" else None for limit in limits], float(took.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--threads", help="of every run (default: the program's)")
    given = parser.parse_args()
    if not shutil.which(given.program):
        parser.error(f"there is no program {given.program}")
    given.folder.mkdir(parents=True, exist_ok=True)
    rows = list(itertools.product(CLEARANCES, ROOMS, REPEATS))
    print("| searches | what differs | pairs | violated |\n| --- | --- | --- | --- |")
    for name, lessons in (("single", False), ("default", True)):
        values, seconds = run(given.program, given.folder, name, lessons,
                              ["--threads", given.threads] if given.threads else [])
        print("".join(f"not locked, and left out: {row}\n" for row, value in zip(rows, values) if value is None), end="")
        pairs, violated = collections.Counter(), collections.Counter()
        for (row, value), (other, within) in itertools.permutations(zip(rows, values), 2):
            if value is None or within is None or not contains(row, other):
                continue
            differs = [what for what, a, b in zip(("clearance", "z", "cell"), row, other) if a != b]
            kind = differs[0] if len(differs) == 1 else "several"
            pairs[kind] += 1
            if within - value > VIOLATED * within:
                violated[kind] += 1
                if lessons:
                    print(f"violated: {row}: {value:.8g}, but {within:.8g} of {other}")
        for kind, count in pairs.items():
            print(f"| {name} | {kind} | {count} | {violated[kind]} |")
        print(f"| {name} | all | {sum(pairs.values())} | {sum(violated.values())}, {seconds:.1f} s |", flush=True)


if __name__ == "__main__":
    main()
