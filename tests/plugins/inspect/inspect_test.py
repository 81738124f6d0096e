#!/usr/bin/env python3
"""Asks `hauberk inspect` of models whose answers are known: made here of tubes along curves, exported by the program,
or damaged.

    inspect_test.py HAUBERK FOLDER_OF_EXPERIMENTS
"""

import io
import json
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile

hauberk, experiments = sys.argv[1], pathlib.Path(sys.argv[2])
folder = pathlib.Path(tempfile.mkdtemp())
answered = []


def run(*words):
    return subprocess.run([hauberk, *map(str, words)], capture_output=True, text=True, check=False)


def inspect(path, *options, code=0):
    """The answer as JSON; the text for people must come, too."""
    done = run("inspect", path, "--json", *options)
    assert done.returncode == code, f"{path.name}: exit {done.returncode}, expected {code}\n{done.stdout}{done.stderr}"
    text = run("inspect", path, *options)
    assert text.returncode == code
    answered.append(path.name)
    return (json.loads(done.stdout), text.stdout) if code != 2 else (None, done.stderr)


# Vectors.
def add(a, b, t=1.0):
    return tuple(x + t * y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def tube(curve, radius, along=120, around=24):
    """Points and triangles of a tube around a closed curve of a parameter from 0 to 1, outwards."""
    centre = [curve(k / along) for k in range(along)]
    tangent = [unit(add(centre[(k + 1) % along], centre[k - 1], -1.0)) for k in range(along)]
    normal = unit(cross(tangent[0], min(((1, 0, 0), (0, 1, 0), (0, 0, 1)), key=lambda e: abs(dot(e, tangent[0])))))
    frames = []
    for t in tangent:
        normal = unit(add(normal, t, -dot(normal, t)))
        frames.append((normal, cross(t, normal)))
    # What the frame misses itself by after one way round is taken back evenly.
    last = unit(add(normal, tangent[0], -dot(normal, tangent[0])))
    miss = math.atan2(dot(last, frames[0][1]), dot(last, frames[0][0]))
    points = []
    for k in range(along):
        a, b = frames[k]
        for j in range(around):
            angle = 2.0 * math.pi * j / around - miss * k / along
            points.append(add(add(centre[k], a, radius * math.cos(angle)), b, radius * math.sin(angle)))
    triangles = []
    for k in range(along):
        for j in range(around):
            corner = [(k * around + j), ((k + 1) % along * around + j), ((k + 1) % along * around + (j + 1) % around),
                      (k * around + (j + 1) % around)]
            triangles += [(corner[0], corner[2], corner[1]), (corner[0], corner[3], corner[2])]
    six = sum(dot(points[a], cross(points[b], points[c])) for a, b, c in triangles)
    return points, triangles if six > 0.0 else [(a, c, b) for a, b, c in triangles]


def ring(centre, e1, e2, R, r):
    return tube(lambda s: add(add(centre, e1, R * math.cos(2 * math.pi * s)), e2, R * math.sin(2 * math.pi * s)), r)


def ball(centre, r, n=16):
    """By longitude and latitude."""
    points = [add(centre, (0, 0, r)), add(centre, (0, 0, -r))]
    for i in range(1, n):
        for j in range(2 * n):
            a, b = math.pi * i / n, math.pi * j / n
            points.append(add(centre, (r * math.sin(a) * math.cos(b), r * math.sin(a) * math.sin(b), r * math.cos(a))))
    at = lambda i, j: 2 + (i - 1) * 2 * n + j % (2 * n)
    triangles = []
    for j in range(2 * n):
        triangles += [(0, at(1, j), at(1, j + 1)), (1, at(n - 1, j + 1), at(n - 1, j))]
        for i in range(1, n - 1):
            triangles += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return points, triangles


def write_stl(name, *bodies):
    data = [(body[0][a], body[0][b], body[0][c]) for body in bodies for a, b, c in body[1]]
    with open(folder / name, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(data)))
        for corners in data:
            file.write(struct.pack("<12fH", 0, 0, 0, *(x for corner in corners for x in corner), 0))
    return folder / name


def write_obj(name, *bodies):
    with open(folder / name, "w", encoding="utf8") as file:
        first = 1
        for points, triangles in bodies:
            file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
            file.writelines(f"f {a + first} {b + first} {c + first}\n" for a, b, c in triangles)
            first += len(points)
    return folder / name


def write_3mf(name, model):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3D/3dmodel.model", model)
    (folder / name).write_bytes(content.getvalue())
    return folder / name


def pairs(answer):
    return sorted((tuple(link["bodies"]), link["number"]) for link in answer["links"])


X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
ONE = ring((0, 0, 0), X, Y, 5.0, 0.7)
OTHER = ring((5, 0, 0), X, Z, 5.0, 0.7)
AWAY = ring((30, 0, 0), X, Y, 5.0, 0.7)

# A Hopf link, and a ring that belongs to nothing. Triangles are off the smooth rings by chords, either way.
answer, text = inspect(write_obj("hopf.obj", ONE, OTHER, AWAY))
assert pairs(answer) == [((0, 1), 1)] and answer["pieces"] == 2, text
assert [b["holes"] for b in answer["bodies"]] == [1, 1, 1] and not answer["failed"]
assert "linked with nothing: 1 body\n  body 3\n" in text, text
smooth = min(math.hypot(math.hypot(5 + 5 * math.cos(a), 0) - 5, 5 * math.sin(a))
             for a in (2 * math.pi * k / 100000 for k in range(100000))) - 1.4
chords = 2 * (5.7 * (1 - math.cos(math.pi / 120)) + 0.7 * (1 - math.cos(math.pi / 24)))
assert abs(answer["nearest"]["distance"] - smooth) < chords, (answer["nearest"], smooth, chords)
exact = 2 * math.pi**2 * 5.0 * 0.7**2
assert abs(answer["bodies"][0]["volume"] / exact - 1) < 0.02
assert abs(answer["bodies"][0]["thinnest_wall"] / 1.4 - 1) < 0.02
hopf = answer

# The same as STL, whose unit and names are lost, with the same numbers to single precision.
answer, text = inspect(write_stl("hopf.stl", ONE, OTHER, AWAY))
assert pairs(answer) == pairs(hopf) and "names no unit" in text
assert abs(answer["nearest"]["distance"] - hopf["nearest"]["distance"]) < 1e-5

# Asked for more room than there is.
answer, text = inspect(folder / "hopf.obj", "--gap", "4", code=1)
assert [p["bodies"] for p in answer["too_near"]] == [[0, 1]] and "nearer than 4" in text, text
inspect(folder / "hopf.obj", "--gap", "3.5")

# A chain of four, and rings far apart, of which the nearest pair must be found.
chain = [ring((8.0 * k, 0, 0), X, Y if k % 2 == 0 else Z, 5.0, 0.7) for k in range(4)]
answer, _ = inspect(write_stl("chain.stl", *chain))
assert pairs(answer) == [((0, 1), 1), ((1, 2), 1), ((2, 3), 1)] and answer["pieces"] == 1
answer, _ = inspect(write_obj("apart.obj", *(ring((c, 0, 0), X, Y, 1.0, 0.2) for c in (0, 20, 33, 70))))
assert answer["nearest"]["bodies"] == [1, 2] and abs(answer["nearest"]["distance"] - 10.6) < 1e-3
assert answer["pieces"] == 4 and answer["printing"]["on_bed"] == 4
# A model whose lowest point is not at 0, and its size: of four rings of radius 1.2 about z, 70 from the first to the last.
answer, text = inspect(write_obj("apart.obj", *(ring((c, 0, -7), X, Y, 1.0, 0.2) for c in (0, 20, 33, 70))))
(x0, y0, z0), (x1, y1, z1) = answer["printing"]["box"]
assert abs(x1 - x0 - 72.4) < 0.01 and abs(y1 - y0 - 2.4) < 0.01 and abs(z1 - z0 - 0.4) < 0.01 and abs(z0 + 7.2) < 0.01
assert "as it lies, 72.4 x 2.4 x 0.4: 4 of 4 bodies stand on its lowest z, -7.2, which a slicer puts on the bed" in text, text

# Linked twice: curves on a torus that go around the other way's hole twice each.
solomon = [tube(lambda s, phase=phase: ((3 + math.cos(4 * math.pi * s + phase)) * math.cos(2 * math.pi * s),
                                        (3 + math.cos(4 * math.pi * s + phase)) * math.sin(2 * math.pi * s),
                                        math.sin(4 * math.pi * s + phase)), 0.3) for phase in (0, math.pi)]
answer, text = inspect(write_obj("solomon.obj", *solomon))
assert pairs(answer) == [((0, 1), 2)] and "body 1 and body 2: 2 times" in text, text

# Borromean rings: no two are linked, which is what is said; nothing overlaps.
ellipses = [tube(lambda s, a=a, b=b: add(tuple(3 * math.cos(2 * math.pi * s) * x for x in a), b,
                                         1.5 * math.sin(2 * math.pi * s)), 0.3) for a, b in ((X, Y), (Y, Z), (Z, X))]
answer, _ = inspect(write_stl("borromean.stl", *ellipses))
assert pairs(answer) == [] and answer["pieces"] == 3 and answer["nearest"]["distance"] > 0.1

# A knot is linked with nothing, a ring around its tube with it.
knot = lambda s: ((2 + math.cos(6 * math.pi * s)) * math.cos(4 * math.pi * s),
                  (2 + math.cos(6 * math.pi * s)) * math.sin(4 * math.pi * s), math.sin(6 * math.pi * s))
around = ring(knot(0.0), X, Z, 0.6, 0.1)
answer, _ = inspect(write_obj("knot.obj", tube(knot, 0.3, along=240), around))
assert pairs(answer) == [((0, 1), 1)] and [b["holes"] for b in answer["bodies"]] == [1, 1]

# Surfaces that are none, each by its name; the others are still looked at.
holed = (ONE[0], ONE[1][1:])
answer, text = inspect(write_obj("holed.obj", holed, OTHER, AWAY), code=1)
assert answer["bodies"][0]["problem"] and not answer["bodies"][1]["problem"] and "no closed surface: 1 body" in text
turned = (ONE[0], [(a, c, b) if k == 7 else (a, b, c) for k, (a, b, c) in enumerate(ONE[1])])
answer, _ = inspect(write_obj("turned.obj", turned), code=1)
assert "sense" in answer["bodies"][0]["problem"], answer["bodies"][0]["problem"]
eight = tube(lambda s: (4 * math.sin(2 * math.pi * s), 4 * math.sin(4 * math.pi * s), 0.1 * math.cos(2 * math.pi * s)), 0.5)
answer, _ = inspect(write_obj("eight.obj", eight), code=1)
assert "meets itself" in answer["bodies"][0]["problem"], answer["bodies"][0]["problem"]

# Inside out as a whole: closed, and said.
answer, text = inspect(write_obj("inside_out.obj", (ONE[0], [(a, c, b) for a, b, c in ONE[1]])))
assert answer["bodies"][0]["inside_out"] and abs(answer["bodies"][0]["volume"] / exact - 1) < 0.02
assert abs(answer["bodies"][0]["thinnest_wall"] / 1.4 - 1) < 0.02

# Two that meet; one within another.
answer, text = inspect(write_obj("meeting.obj", ONE, ring((5, 0.9, 0), X, Z, 5.0, 0.7), ring((10.9, 0, 0), X, Y, 5.0, 0.7)),
                       code=1)
assert [0, 2] in [p["bodies"] for p in answer["too_near"]] and answer["nearest"]["distance"] == 0.0, text
answer, text = inspect(write_obj("within.obj", ball((0, 0, 0), 3.0), ball((0.5, 0, 0), 1.0)))
assert answer["within"] == [[0, 1]] and [b["holes"] for b in answer["bodies"]] == [0, 0]
assert abs(answer["nearest"]["distance"] - 1.5) < 0.1, text

# Two that touch along a face, without a common point; and a hollow, whose wall is no gap.
def box(low, high):
    points = [tuple((low, high)[k >> axis & 1][axis] for axis in range(3)) for k in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


answer, text = inspect(write_obj("touching.obj", box((0, 0, 0), (20, 20, 2)), box((7, 6, 2), (12, 11, 10))), code=1)
assert [p["bodies"] for p in answer["too_near"]] == [[0, 1]] and answer["bodies"][0]["volume"] == 800.0, text
inner = ball((0, 0, 0), 2.7)
answer, text = inspect(write_obj("hollow.obj", ball((0, 0, 0), 3.0), (inner[0], [(a, c, b) for a, b, c in inner[1]])),
                       "--gap", "0.4")
assert answer["pieces"] == 1 and answer["bodies"][1]["hollow"] and answer["nearest"] is None, text
assert "the wall of a hollow" in text and "linked with nothing" not in text, text
open_box = box((10, 10, 10), (20, 20, 20))
answer, _ = inspect(write_obj("open_box.obj", (open_box[0], open_box[1][1:])), code=1)
assert "(10, 10, 10)" in answer["bodies"][0]["problem"] or "20" in answer["bodies"][0]["problem"], answer["bodies"][0]

# Files that are no models.
cut = (folder / "hopf.stl").read_bytes()[:-20]
(folder / "cut.stl").write_bytes(cut)
assert "cut short" in inspect(folder / "cut.stl", code=2)[1]
(folder / "empty.obj").write_text("# nothing\n")
inspect(folder / "empty.obj", code=2)
(folder / "model.ply").write_text("ply\n")
assert "expected a file .stl, .obj or .3mf" in inspect(folder / "model.ply", code=2)[1]
(folder / "no.3mf").write_bytes(b"PK\3\4 nothing")
assert inspect(folder / "absent.stl", code=2)[1].endswith("absent.stl: there is no such file\n")
without_3mf = "built without libzip" in inspect(folder / "no.3mf", code=2)[1]

# What the program exports, of a cage of struts with five holes; and a whole sheet by every way.
for name, words in (("cubes", ("--chord", "0.1")), ("chainmail_limits", ("--repeat", "3,3", "--chord", "0.1"))):
    for ending in ("stl", "obj") if without_3mf else ("stl", "obj", "3mf"):
        path = folder / f"{name}.{ending}"
        done = run("export", experiments / f"{name}.json", "-o", path, *words)
        assert done.returncode == 0, done.stderr
        answer, text = inspect(path)
        said = float(done.stdout.split("smallest gap ")[1].split()[0])
        assert abs(answer["nearest"]["distance"] - said) < 0.2, (answer["nearest"], said)
        if name == "cubes":
            assert {b["holes"] for b in answer["bodies"]} == {5}, text
        else:
            # Of 3 x 3 cells of 8 rings, 6 x 12 rings in rows of alternating lean: every ring is linked with its four
            # diagonal neighbours.
            assert len(answer["bodies"]) == 72 and answer["pieces"] == 1, text
            assert answer["printing"]["objects"] == 1 and "places" not in text, text
            assert max(len(b["linked"]) for b in answer["bodies"]) == 4
            assert len(answer["links"]) == 11 * (2 * 6 - 1), len(answer["links"])
if not without_3mf:
    # Items keep the names of their bodies, and a slicer takes them apart.
    run("export", experiments / "chainmail_limits.json", "-o", folder / "items.3mf", "--repeat", "3,3", "--chord", "0.1", "--separate")
    answer, text = inspect(folder / "items.3mf")
    assert answer["unit"] == "mm" and "[2, 2]" in answer["bodies"][-1]["name"], answer["bodies"][-1]
    assert answer["printing"]["objects"] == 72 and "places 72 objects" in text, text

    # Components of components, turned, mirrored and in inches; and what would never end.
    points, triangles = ONE
    mesh = ("<mesh><vertices>" + "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in points) + "</vertices><triangles>"
            + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles) + "</triangles></mesh>")
    head = '<?xml version="1.0"?><model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
    pair = ('<object id="2"><components><component objectid="1"/>'
            '<component objectid="1" transform="1 0 0 0 0 1 0 -1 0 5 0 0"/></components></object>')
    build = '</resources><build><item objectid="2"/><item objectid="2" transform="-1 0 0 0 1 0 0 0 1 -40 0 0"/></build></model>'
    answer, _ = inspect(write_3mf("components.3mf", f'{head}<object id="1" name="link">{mesh}</object>{pair}{build}'))
    assert answer["unit"] == "in" and pairs(answer) == [((0, 1), 1), ((2, 3), 1)] and answer["pieces"] == 2
    assert not any(b["inside_out"] for b in answer["bodies"])
    assert abs(answer["nearest"]["distance"] - hopf["nearest"]["distance"]) < chords
    assert answer["printing"]["objects"] == 4 and answer["printing"]["linked_apart"]
    # Two items of one object that is linked within itself.
    both = mesh.replace("</vertices>", "".join(f'<vertex x="{x + 5}" y="{-z}" z="{y}"/>' for x, y, z in points) + "</vertices>")
    both = both.replace("</triangles>", "".join(f'<triangle v1="{a + len(points)}" v2="{b + len(points)}" v3="{c + len(points)}"/>'
                                                for a, b, c in triangles) + "</triangles>")
    twice = '</resources><build><item objectid="1"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 -40 0 0"/></build></model>'
    answer, text = inspect(write_3mf("within.3mf", f'{head}<object id="1">{both}</object>{twice}'))
    assert pairs(answer) == [((0, 1), 1), ((2, 3), 1)], pairs(answer)
    assert answer["printing"]["objects"] == 2 and not answer["printing"]["linked_apart"] and "printed apart" not in text, text
    # What an extension names like the core is not the core's.
    slices = ('<s:slicestack xmlns:s="http://schemas.microsoft.com/3dmanufacturing/slice/2015/07" id="9"><s:slice ztop="1">'
              '<s:vertices><s:vertex x="1" y="2"/></s:vertices></s:slice></s:slicestack>')
    answer, _ = inspect(write_3mf("slices.3mf", f'{head}<object id="1">{mesh}</object>{slices}'
                                                '</resources><build><item objectid="1"/></build></model>'))
    assert len(answer["bodies"]) == 1
    itself = '<object id="2"><components><component objectid="2"/></components></object>'
    assert "hold itself" in inspect(write_3mf("itself.3mf", head + itself + build), code=2)[1]
    bomb = '<?xml version="1.0"?><!DOCTYPE m [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><model>&b;</model>'
    assert "entity" in inspect(write_3mf("bomb.3mf", bomb), code=2)[1]

print(f"{len(answered)} answers right")
shutil.rmtree(folder)
