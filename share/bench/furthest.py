#!/usr/bin/env python3
"""How often limits that are found with default settings are short of the furthest state that is known.

    share/bench/furthest.py HAUBERK FOLDER [--only NAME,NAME] [--senses stretch,compress] [--defaults | --stronger KIND,KIND]
                            [--variants NAME,NAME] [--directions DEGREES,DEGREES] [--threads N] [--known FILE]

Families of periodic cells (weaves at several ratios of ring to wire, sheets of other elements), z fixed, z fixed with a
clearance of 0.1 mm, and z free; axial limits at five directions, all of them in one run and each alone. The furthest
known state is that of these, of stronger searches (64 starts, 4 tilted loads with 8 starts, limits every 15 degrees),
of scenes that a scene contains (that with a clearance in that without, z fixed in z free, a cell in its multiples) and of
all runs whose values the file of known ones has (furthest.json beside this script), where what is further is entered.
--defaults leaves the stronger searches out, --stronger all but those named. A limit is short where it misses the
furthest by more than a thousandth. Prints a line per limit that is short, one per family with the seconds of processor
time of every kind of run, and the tables. Runs that FOLDER holds are not repeated.

Limits with default settings are held against each other, too: one is further than another's whose states it has (that
with a clearance of 0.1 mm in that without, z fixed in z free, a cell in its multiples), fans against fans and lone ones
against lone ones. A pair is violated where what is contained is further by more than a millionth.
"""

import argparse
import json
import pathlib
import resource
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
DIRECTIONS = [0, 20, 45, 75, 90]
RATIOS = {"european_4in1": (3.3, 5.5, 6.667, 10.0), "european_6in1": (5.5, 8.0), "japanese_4in1": (4.0, 7.0),
          "japanese_6in1": (5.0, 8.0)}
SHEETS = ["share/experiments/octahedra_sheet.json", "share/experiments/threefold_round.json",
          "share/experiments/chainmail_limits.json", "tests/experiments/scenes/square_frames.json"]
CELLS = {"european_4in1": (2, 3), "european_6in1": (2,), "japanese_4in1": (2,), "japanese_6in1": (2,), "fourfold": (2, 3),
         "threefold": (2, 3)}
VARIANTS = {"0.1 mm": ({}, {"clearance": 0.1}), "z fixed": ({}, {}), "z free": ({"out_of_plane": "free"}, {})}
# None: the directions that are asked for.
STRONGER = {"64 starts": (None, {"starts": 64}), "tilts": (None, {"starts": 8, "tilts": 4}),
            "every 15": (sorted({*range(0, 180, 15), *DIRECTIONS}), {})}
SHORT = 1e-3
VIOLATED = 1e-6
CONTAINS = {"z fixed": "0.1 mm", "z free": "z fixed"}  # a variant, and the one whose states are its too


def families():
    def weave(name, parameters):
        return {"name": name, "task": "limits", "length_unit": "mm", "cell": {"weave": {"name": name, **parameters}}}

    found = {}
    for name, ratios in RATIOS.items():
        for ratio in ratios:
            found[f"{name} {ratio}"] = weave(name, {"parameters": {"inner_diameter": 8, "wire_diameter": 8 / ratio}})
    for name in ("fourfold", "threefold", *RATIOS):
        found[name] = weave(name, {})
    for name, repeats in CELLS.items():
        for n in repeats:
            found[f"{name} {n}x{n}"] = weave(name, {})
            found[f"{name} {n}x{n}"]["cell"]["repeat"] = [n, n]
    for path in SHEETS:
        stem = pathlib.Path(path).stem
        found[stem] = {"name": stem, "extends": str(ROOT / path), "expect": []}
    return found


def one_cell(name):
    """The family of whose cell this one's is a multiple, if it is."""
    return name[:-4] if name.endswith(("2x2", "3x3")) else None


def processor_seconds():
    """Of all programs that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Study:
    def __init__(self, program, folder, senses, stronger, variants, directions, threads, known):
        self.program, self.folder, self.senses, self.stronger = program, pathlib.Path(folder), senses, stronger
        self.variants, self.directions = variants, directions
        self.options = [] if threads is None else ["--threads", str(threads)]
        self.folder.mkdir(parents=True, exist_ok=True)
        self.file = known
        self.known = json.loads(known.read_text()) if known.exists() else {}
        self.default = {}  # values by family and variant, kind of run and limit
        self.relations = {}  # pairs and violated ones by relation and kind of run

    def remember(self, where, limit, value, by):
        """The furthest that any run came to in this limit, and by which kind of run."""
        at = f"{float(limit[0]):g} {limit[1]}"
        known = self.known.setdefault(where, {})
        if at not in known or value > known[at][0] + 1e-9:
            known[at] = [value, by]
        return tuple(known[at])

    def keep(self):
        lines = (f"{json.dumps(k)}: {json.dumps(v, sort_keys=True)}" for k, v in sorted(self.known.items()))
        self.file.write_text("{\n" + ",\n".join(lines) + "\n}\n")

    def run(self, name, experiment, load, solver, directions):
        """Values towards their sense and words by direction and sense; and seconds of processor time."""
        name = name.replace(" ", "_")
        out, took = self.folder / name, self.folder / f"{name}.processor_seconds"
        if not took.exists():
            shutil.rmtree(out, ignore_errors=True)
            load = {"plugin": "in_plane_periodic", "senses": self.senses, **load, "directions_deg": directions}
            file = self.folder / f"{name}.json"
            file.write_text(json.dumps({**experiment, "load_case": load, "solver": solver}))
            begin = processor_seconds()
            done = subprocess.run([self.program, "run", str(file), "-o", str(out), "--quiet", "--yes", *self.options],
                                  capture_output=True, text=True)
            if done.returncode not in (0, 1):
                raise RuntimeError(f"{file}: exit code {done.returncode}: {done.stderr}")
            took.write_text(str(processor_seconds() - begin))
        limits = json.loads((out / "results.json").read_text())["limits"]
        return {(l["direction_deg"], l["sense"]): (l["value"] * (1 if l["sense"] == "stretch" else -1), l["confidence"]["word"])
                for l in limits if l["status"] == "locked"}, float(took.read_text())

    def relate(self, name, variant, found):
        """Compares default values with those of scenes that this one contains."""
        self.default[name, variant] = found
        within = [("z or clearance", name, CONTAINS.get(variant)), ("cell", one_cell(name), variant)]
        for relation, *scene in within:
            for kind, values in self.default.get(tuple(scene), {}).items():
                for limit, (value, _) in values.items():
                    count = self.relations.setdefault((relation, limit[1], kind), [0, 0])
                    count[0] += 1
                    own = found[kind].get(limit, (float("-inf"), "none"))[0]
                    if value - own > VIOLATED * abs(value):
                        count[1] += 1
                        print(f"violated: {name}, {variant}, {limit[0]} degrees, {limit[1]}, {kind}: {own:.6g}, but {value:.6g} of "
                              f"{', '.join(scene)}", flush=True)

    def family(self, name, experiment, table):
        contained = {}  # the furthest of the variant before, whose states are this one's too
        for variant, (load, solver) in self.variants.items():
            where = f"{name}, {variant}"
            for at, (value, _) in self.known.get(f"{one_cell(name)}, {variant}", {}).items():
                limit = (float(at.split()[0]), at.split()[1])
                contained[limit] = max(value, contained.get(limit, float("-inf")))
            found, seconds = {}, {}
            found["fan"], seconds["fan"] = self.run(f"{where} fan", experiment, load, solver, self.directions)
            found["alone"], seconds["alone"] = {}, 0.0
            for degrees in self.directions:
                values, took = self.run(f"{where} {degrees}", experiment, load, solver, [degrees])
                found["alone"].update(values)
                seconds["alone"] += took
            self.relate(name, variant, {kind: found[kind] for kind in ("fan", "alone")})
            for kind, (directions, settings) in self.stronger.items():
                found[kind], seconds[kind] = self.run(f"{where} {kind}", experiment, load, {**solver, **settings},
                                                     directions or self.directions)
            for limit in sorted(found["fan"] | found["alone"]):
                furthest, by = max((values[limit][0], kind) for kind, values in found.items() if limit in values)
                furthest, by = max((furthest, by), (contained.get(limit, float("-inf")), "a scene within"))
                furthest, by = self.remember(where, limit, furthest, by)
                contained[limit] = furthest
                for kind in ("fan", "alone"):
                    count = table.setdefault((limit[1], kind), [0, 0])
                    count[0] += 1
                    value, word = found[kind].get(limit, (float("-inf"), "none"))
                    if furthest - value > SHORT * abs(furthest):
                        count[1] += 1
                        print(f"short: {where}, {limit[0]} degrees, {limit[1]}, {kind}: {value:.6g} ({word}) for {furthest:.6g}"
                              f" ({by})", flush=True)
            self.keep()
            print(f"{where}: " + ", ".join(f"{kind} {s:.1f} s" for kind, s in seconds.items()), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--only", default="", help="families whose names contain one of these")
    parser.add_argument("--senses", default="stretch,compress")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--defaults", action="store_true", help="no stronger searches")
    which.add_argument("--stronger", default=",".join(STRONGER), help="which stronger searches (default: %(default)s)")
    parser.add_argument("--variants", default=",".join(VARIANTS), help="of every family (default: %(default)s)")
    parser.add_argument("--directions", default=",".join(map(str, DIRECTIONS)), help="of the five (default: %(default)s)")
    parser.add_argument("--threads", type=int, help="of every run (default: the program's)")
    parser.add_argument("--known", type=pathlib.Path, default=pathlib.Path(__file__).with_suffix(".json"))
    options = parser.parse_args()
    if not shutil.which(options.program):
        parser.error(f"there is no program {options.program}")

    def chosen(option, given, known):
        names = [name for name in given.split(",") if name]
        if unknown := set(names) - set(known):
            parser.error(f"{option}: there is no {', '.join(sorted(unknown))}; there are {', '.join(known)}")
        return {name: known[name] for name in known if name in names}

    study = Study(options.program, options.folder, options.senses.split(","),
                  chosen("--stronger", "" if options.defaults else options.stronger, STRONGER),
                  chosen("--variants", options.variants, VARIANTS),
                  list(chosen("--directions", options.directions, {str(d): d for d in DIRECTIONS}).values()),
                  options.threads, options.known)
    table = {}
    for name, experiment in families().items():
        if any(part in name for part in options.only.split(",")):
            study.family(name, experiment, table)
    print("| | limits | short by more than 0.1 % |\n| --- | --- | --- |")
    for (sense, kind), (limits, short) in sorted(table.items()):
        print(f"| {sense}, {kind} | {limits} | {short} |")
    print("\n| contained | pairs | violated |\n| --- | --- | --- |")
    for (relation, sense, kind), (pairs, violated) in sorted(study.relations.items()):
        print(f"| {relation}, {sense}, {kind} | {pairs} | {violated} |")


if __name__ == "__main__":
    main()
