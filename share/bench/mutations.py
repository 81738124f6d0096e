#!/usr/bin/env python3
"""What the program makes of damaged files: experiments, results, logs of unfinished runs and meshes, mutated at random.

    share/bench/mutations.py HAUBERK [--experiments N] [--results N] [--logs N] [--meshes N] [--seed S] [--jobs J]

Build the program with sanitizers first (presets asan-ubsan or fuzz), else only crashes are seen. Each mutated file is
given to `check`, every fifth to `run` (with a budget of few evaluations), `verify` and `report`, `run --resume`, or `inspect`. It must hold:

  - the exit code is 0, 1 or 2 (130 where the file asked for so much that it was interrupted), no sanitizer says a word;
  - an exit code that is not 0 comes with words; 2 names the file, or the option that would allow it;
  - exit code 2 of `run` leaves no folder behind;
  - a run that goes on from a damaged log ends with the bytes that it would have ended with, or is refused.

Prints a table of exit codes per kind, and every finding with the command that shows it; its file is kept. The same
seed makes the same files. Exit code 1: there are findings.
"""

import argparse
import collections
import concurrent.futures
import copy
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUDGET = "--budget", "3e3", "--budget-bytes", "1e9"
PATIENCE = 30  # seconds until what runs is interrupted
ALARMS = re.compile(r"AddressSanitizer|LeakSanitizer|runtime error:|UndefinedBehavior|terminate called|Assertion")
OPTION = re.compile(r"--budget|--yes")
NUMBERS = [0, -0.0, 1, -1, 2, 1e-9, -1e-9, 1e-300, 1e300, -1e300, 5e-324, 1e9, 2**31, 2**53, 2**63, 2**64, 0.5, 1.0000000001]
TEXTS = ["", " ", "x", "NaN", "$", "$x/0", "=1", "../..", "/", "ring", "\u202e", "\x1b[31m", "a" * 3000, "%s%n", "1e999"]
WHAT_ELSE = [None, True, False, [], {}, [[]], [0, 0, 0], {"": 0}]


# --- mutations --------------------------------------------------------------------------------------------------------


def places_of(tree, found=None):
    """(container, key) of every value of a JSON tree."""
    found = [] if found is None else found
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in list(items):
        found.append((tree, key))
        places_of(value, found)
    return found


def mutate_tree(chance, tree, others):
    """One structural change: a value replaced, exchanged, moved in from another file, removed, renamed or repeated."""
    places = places_of(tree)
    if not places:
        return {}
    holder, key = chance.choice(places)
    value = holder[key]
    kind = chance.randrange(9)
    if kind == 0 or (kind in (1, 2) and not isinstance(value, (int, float))):
        holder[key] = copy.deepcopy(chance.choice(NUMBERS + TEXTS + WHAT_ELSE))
    elif kind == 1:
        holder[key] = chance.choice(NUMBERS)
    elif kind == 2:
        holder[key] = value * chance.choice([-1, 0.5, 1.001, 2, 10, 1e3, 1e-3])
    elif kind == 3:
        other, place = chance.choice(places_of(chance.choice(others)) or [({0: 0}, 0)])
        holder[key] = copy.deepcopy(other[place])
    elif kind == 4:
        other, place = chance.choice(places)
        holder[key], other[place] = copy.deepcopy(other[place]), copy.deepcopy(value)
    elif kind == 5:
        del holder[key]
    elif kind == 6 and isinstance(holder, dict):
        name = chance.choice(TEXTS + [chance.choice(places)[1], str(key) + "_", str(key)[:-1]])
        holder[str(name)] = holder.pop(key)
    elif kind == 7 and isinstance(value, list) and value:
        value.extend(copy.deepcopy(value) * chance.choice([1, 2, 40]))
    else:
        holder[key] = [copy.deepcopy(value)]
    return tree


def mutate_bytes(chance, data):
    """One change of bytes: some flipped, cut out, repeated, put in, or the rest of the file lost."""
    data = bytearray(data)
    if not data:
        return bytes([chance.randrange(256)])
    at = chance.randrange(len(data))
    span = min(len(data) - at, chance.choice([1, 1, 2, 8, 64, 1000]))
    kind = chance.randrange(6)
    if kind == 0:
        data[at] ^= 1 << chance.randrange(8)
    elif kind == 1:
        data[at] = chance.randrange(256)
    elif kind == 2:
        del data[at:at + span]
    elif kind == 3:
        data[at:at] = data[at:at + span] * chance.choice([1, 1, 30])
    elif kind == 4:
        data[at:at] = chance.choice([b"\0", b"\xff\xfe", b"\"", b"}", b"[" * 4000, b"-", b"1e999", b"nan", b"\n", b"9" * 40])
    else:
        del data[at:]
    return bytes(data)


def mutated_json(chance, text, others):
    if chance.random() < 0.3:
        for _ in range(chance.choice([1, 1, 2, 5])):
            text = mutate_bytes(chance, text)
        return text
    tree = copy.deepcopy(json.loads(text))
    for _ in range(chance.choice([1, 1, 1, 2, 4])):
        tree = mutate_tree(chance, tree, others)
    return json.dumps(tree).encode("utf-8", "surrogatepass")


# --- what is done with a file ------------------------------------------------------------------------------------------


class Finding(Exception):
    pass


def call(command, file, allowed=(0, 1, 2)):
    """(exit code, standard error); raises a Finding where the rules of every command are broken."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
    interrupted = False
    try:
        out, error = process.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        interrupted = True
        process.send_signal(signal.SIGINT)
        try:
            out, error = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Finding(f"did not end within {PATIENCE} s of an interrupt")
    error = error.decode("utf-8", "replace")
    said = error + out.decode("utf-8", "replace")
    code = process.returncode
    if ALARMS.search(said):
        raise Finding(said[:3000])
    if code not in allowed and not (interrupted and code in (130, -signal.SIGINT)):
        raise Finding(f"exit code {code}: {said[:2000]}")
    if code == 1 and not said.strip():
        raise Finding("exit code 1, and not a word")
    if code == 2 and file.name not in said and not OPTION.search(said):
        raise Finding(f"exit code {code} without a place: {said[:2000]}")
    return code, error


def try_experiment(program, file, folder, run):
    if not run:
        return call([program, "check", str(file)], file)[0]
    code, _ = call([program, "run", str(file), "-o", str(folder / "out"), "--quiet", "--threads", "1", *BUDGET],
                   file)
    if code == 2 and (folder / "out").exists():
        raise Finding("exit code 2, and the folder was written")
    return code


def try_results(program, file, folder):
    code, _ = call([program, "verify", str(file)], file)
    report, _ = call([program, "report", str(file), "-o", str(folder / "report")], file)
    return code, report


def try_mesh(program, file, folder):
    return call([program, "inspect", str(file), "--gap", "0.1"], file)[0]


def try_log(program, file, folder, experiment, finished):
    """`file` is the damaged log, in the folder of a run that ended before its results were written."""
    code, _ = call([program, "run", str(experiment), "-o", str(file.parent), "--resume", "--quiet", "--threads", "1"],
                   experiment)
    if code == 2:
        return code
    results = file.parent / "results.json"
    if code != 130 and (not results.exists() or results.read_bytes() != finished):
        raise Finding(f"exit code {code}, and the results differ from those of the undamaged run")
    return code


# --- sources ----------------------------------------------------------------------------------------------------------


def plain_json(text):
    """Without comments and commas before closing brackets, which experiments may have."""
    text = re.sub(rb'("(?:[^"\\\\]|\\\\.)*")|//[^\n]*|/\*.*?\*/', lambda m: m[1] or b"", text, flags=re.S)
    return re.sub(rb'("(?:[^"\\\\]|\\\\.)*")|,(?=\s*[\]}])', lambda m: m[1] or b"", text)


def read_experiments():
    """Those that are computed within a second."""
    files = []
    for pattern in ("shapes/*/example.json", "loadcases/*/example.json", "optimizers/*/example.json"):
        files += sorted(ROOT.glob(pattern))
    for name in ("chain", "chain_elliptical", "necklace", "cubes", "cage", "hook_and_eye", "tetrahedra", "oval_links", "roll",
                 "brunnian", "bent_links", "figure2", "threefold_round", "trefoils", "borromean", "stability", "chart_exact"):
        files.append(ROOT / f"share/experiments/{name}.json")
    return [plain_json(file.read_bytes()) for file in files]


#: Small experiments whose results, and the logs of whose unfinished runs, are mutated.
FINISHED = (("share/experiments/chain.json", ()),
            ("share/experiments/threefold_round.json", ()),
            ("share/experiments/hook_and_eye.json", ()),
            ("share/experiments/figure2.json", ()),
            ("loadcases/cylinder_roll/example.json", ()),
            ("optimizers/sqp/example.json", ()),
            ("tests/experiments/slurm/rows.json", ("--set", "/sweep/vary/0/range/count=3")))


def finished_runs(program, folder):
    """(experiment, changes, folder of the finished run) of the experiments above that this build runs."""
    runs = []
    for number, (name, changes) in enumerate(FINISHED):
        out = folder / f"finished{number}"
        command = [program, "run", str(ROOT / name), "-o", str(out), "--quiet", "--threads", "2", "--yes", *changes]
        done = subprocess.run(command, capture_output=True)
        if done.returncode == 0:
            runs.append((ROOT / name, changes, out))
        else:
            print(f"left out: {name}: {done.stderr.decode()[:300]}", file=sys.stderr)
    return runs


def unfinished_runs(program, folder, runs):
    """(experiment that stands alone, folder of an interrupted run, bytes of the finished results)."""
    found = []
    for number, (experiment, changes, out) in enumerate(runs):
        alone = folder / f"alone{number}.json"
        alone.write_text(json.dumps(json.loads((out / "results.json").read_bytes())["experiment"]))
        finished = folder / f"whole{number}"
        subprocess.run([program, "run", str(alone), "-o", str(finished), "--quiet", "--threads", "1", "--yes"],
                       check=True, capture_output=True)
        for attempt in range(40):
            part = folder / f"part{number}_{attempt}"
            process = subprocess.Popen([program, "run", str(alone), "-o", str(part), "--quiet", "--threads", "1", "--yes"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(0.02 * 1.2**attempt)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGINT)
                process.wait()
            logs = [f for f in part.glob(".hauberk-*") if f.name not in (".hauberk-lock", ".hauberk-digest")
                    and f.is_file() and f.stat().st_size > 2000] if part.is_dir() else []
            if process.returncode == 130 and logs:
                found += [(alone, part, log.name, (finished / "results.json").read_bytes()) for log in logs]
                break
    return found


# --- all of it --------------------------------------------------------------------------------------------------------


def work(kind, number, seed, program, sources, keep):
    """Makes file `number` of a kind, and tries it. (kind, exit code or codes, finding or None)."""
    chance = random.Random(f"{seed} {kind} {number}")
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        try:
            if kind == "experiments":
                file = folder / f"experiment_{number}.json"
                file.write_bytes(mutated_json(chance, chance.choice(sources["texts"]), sources["trees"]))
                return kind, try_experiment(program, file, folder, number % 5 == 0), None
            if kind == "results":
                file = folder / f"results_{number}.json"
                file.write_bytes(mutated_json(chance, chance.choice(sources["results"]), sources["result_trees"]))
                return kind, try_results(program, file, folder), None
            if kind == "meshes":
                source = chance.choice(sources["meshes"])
                file = folder / f"mesh_{number}{source.suffix}"
                data = source.read_bytes()
                for _ in range(chance.choice([1, 1, 2, 8])):
                    data = mutate_bytes(chance, data)
                file.write_bytes(data)
                return kind, try_mesh(program, file, folder), None
            experiment, part, log, finished = chance.choice(sources["unfinished"])
            shutil.copytree(part, folder / "out", symlinks=True)
            file = folder / "out" / log
            data = file.read_bytes()
            for _ in range(chance.choice([1, 1, 2, 8])):
                data = mutate_bytes(chance, data)
            file.write_bytes(data)
            return kind, try_log(program, file, folder, experiment, finished), None
        except Finding as finding:
            kept = keep / f"{kind}_{number}"
            if kind == "logs":
                shutil.copytree(file.parent, kept, symlinks=True)
            else:
                kept = kept.with_suffix(file.suffix)
                shutil.copy(file, kept)
            return kind, "finding", f"{kept}: {finding}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    for kind, number in ("experiments", 10000), ("results", 2000), ("logs", 1000), ("meshes", 500):
        parser.add_argument(f"--{kind}", type=int, default=number)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("mutations"), help="folder for findings")
    options = parser.parse_args()
    os.environ.setdefault("ASAN_OPTIONS", "allocator_may_return_null=1:detect_leaks=1")
    os.environ.setdefault("UBSAN_OPTIONS", "print_stacktrace=1:halt_on_error=1")
    options.keep.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        sources = {"texts": read_experiments()}
        sources["trees"] = [json.loads(text) for text in sources["texts"]]
        runs = finished_runs(options.program, folder) if options.results or options.logs else []
        sources["results"] = [(out / "results.json").read_bytes() for _, _, out in runs]
        sources["result_trees"] = [json.loads(text) for text in sources["results"]]
        sources["unfinished"] = unfinished_runs(options.program, folder, runs) if options.logs else []
        if options.meshes:
            for form in "stl", "obj", "3mf":
                subprocess.run([options.program, "export", str(ROOT / "share/experiments/chain.json"), "-o",
                                str(folder / f"chain.{form}")], check=True, capture_output=True)
        sources["meshes"] = sorted(folder.glob("chain.*"))
        print(f"{len(sources['texts'])} experiments, {len(sources['results'])} results, {len(sources['unfinished'])} logs, "
              f"{len(sources['meshes'])} meshes to begin from", flush=True)
        counts, findings = collections.Counter(), 0
        with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
            tasks = [pool.submit(work, kind, number, options.seed, options.program, sources, options.keep)
                     for kind in ("meshes", "logs", "results", "experiments") for number in range(getattr(options, kind))
                     if kind != "logs" or sources["unfinished"]]
            for done, task in enumerate(concurrent.futures.as_completed(tasks), 1):
                kind, code, finding = task.result()
                counts[kind, str(code)] += 1
                if finding:
                    findings += 1
                    print(finding, flush=True)
                if done % 500 == 0:
                    print(f"{done} of {len(tasks)}, {findings} findings", flush=True)
        for (kind, code), count in sorted(counts.items()):
            print(f"{kind:12} exit code {code:8} {count:6}")
        print(f"{findings} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
