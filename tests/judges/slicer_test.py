"""Exported 3MF before PrusaSlicer, which knows nothing of this project.

    slicer_test.py HAUBERK SOURCE_FOLDER

Of every shipped experiment, at rest, three cells of a chain: the slicer takes the file for one object, a closed surface of as
many parts as there are bodies, with the volume that `export` says, and repairs nothing. Of some also what is printed: the
extruded paths of every layer lie within the model where the model lies, and reach its ends, so that bodies are neither laid apart
nor on the bed one by one, as those of a file of many items are. Exit code 77: there is no slicer.
"""

import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

hauberk, source = sys.argv[1:]
slicer = shutil.which("prusa-slicer")
if slicer is None:
    print("slicer: not installed: share/setup.sh --no-build --judges")
    sys.exit(77)
experiments = sorted((pathlib.Path(source) / "share" / "experiments").glob("*.json"))
temporary = tempfile.TemporaryDirectory(prefix="hauberk-slicer-")
folder = pathlib.Path(temporary.name)
# What is sliced, with copies of the cell.
SLICED = {"chain": "3,1", "chainmail_limits": "1,1", "threefold_limits": "2,1", "tetrahedra": "1,1", "cage": "1,1"}
WIDTH = 0.45  # of an extruded path, mm
failures = []


def check(holds, scene, what):
    if not holds:
        failures.append(f"{scene}: {what}")
        print(f"FAIL {scene}: {what}")


def export(file, name, *words):
    target = folder / name
    done = subprocess.run([hauberk, "export", file, "-o", target, "--chord", "0.1", *words], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return target, done.stdout


def information(path):
    """What the slicer says of each object."""
    said = subprocess.run([slicer, "--info", path], capture_output=True, text=True, check=True).stdout
    return [dict(re.findall(r"(\w+) = +(\S+)", part)) for part in said.split(f"[{path.name}]")[1:]]


def box_of_paths(path, *words):
    """Lowest and highest coordinates of what is extruded, x y z."""
    target = path.with_suffix(".gcode")
    subprocess.run([slicer, "--export-gcode", path, "--output", target, "--skirts", "0", "--extrusion-width", str(WIDTH), *words],
                   capture_output=True, check=True)
    at, low, high = {"X": 0.0, "Y": 0.0, "Z": 0.0}, [math.inf] * 3, [-math.inf] * 3
    for line in target.read_text().splitlines():
        if not line.startswith("G1 "):
            continue
        moved = {axis: float(x) for axis, x in re.findall(r"([XYZE])(-?[\d.]+)", line)}
        begin = dict(at)
        at.update({axis: x for axis, x in moved.items() if axis != "E"})
        if moved.get("E", 0.0) > 0.0 and ("X" in moved or "Y" in moved):
            for place in (begin, at):
                low = [min(a, place[axis]) for a, axis in zip(low, "XYZ")]
                high = [max(a, place[axis]) for a, axis in zip(high, "XYZ")]
    return low, high


judged = sliced = 0
for file in experiments:
    scene = file.stem
    path, said = export(file, f"{scene}.3mf", *(["--repeat", SLICED[scene]] if scene in SLICED else []))
    elements = int(re.search(r"(\d+) elements", said)[1])
    bodies = elements * int((re.search(r"its like are of (\d+) bodies", said) or [0, 1])[1])
    volume = float(re.search(r"volume ([\d.eE+-]+)", said)[1])
    found = information(path)
    check(len(found) == 1, scene, f"{len(found)} objects")
    for one in found:
        check(one["manifold"] == "yes", scene, "no closed surface")
        check(int(one["number_of_parts"]) == bodies, scene, f"{one['number_of_parts']} parts, {bodies} bodies")
        # It sums in single precision: of 117,000 triangles the last four digits differ with their order.
        check(abs(float(one["volume"]) - volume) < 1e-3 * volume, scene, f"volume {one['volume']}, export says {volume}")
        check(not {"open_edges", "backwards_edges", "facets_reversed", "degenerate_facets"} & set(one), scene, f"repaired: {one}")
        check(abs(float(one["min_z"])) < 1e-4, scene, f"lowest z {one['min_z']}")
    judged += 1
    if scene in SLICED:
        low, high = box_of_paths(path)
        for k, axis in enumerate("xy"):
            size = float(found[0][f"size_{axis}"])
            printed = high[k] - low[k] + WIDTH
            check(abs(printed - size) < 0.8, scene, f"{printed:.3f} mm printed along {axis}, the model has {size:.3f}")
        check(abs(high[2] - float(found[0]["size_z"])) < 0.5, scene, f"{high[2]} mm high, the model {found[0]['size_z']}")
        sliced += 1

# The same chain as an item for each ring: the slicer takes them apart, which this test would see.
apart, _ = export(pathlib.Path(source) / "share" / "experiments" / "chain.json", "apart.3mf", "--repeat", "3,1", "--separate")
whole = information(folder / "chain.3mf")[0]
low, high = box_of_paths(apart)
check(len(information(apart)) == 6, "apart", f"{len(information(apart))} objects")
check(abs(high[0] - low[0] + WIDTH - float(whole["size_x"])) > 5.0, "apart", "rings of separate items lie as in one object")

print(f"{judged} scenes, {sliced} sliced: {len(failures)} failures")
sys.exit(1 if failures or judged < 20 or sliced != len(SLICED) else 0)
