#!/usr/bin/env python3
"""Makes the gallery, share/doc/gallery.md with its pictures: the weaves and the published materials at rest and
locked.

    share/gallery.py [HAUBERK]        default build/release/bin/hauberk; some minutes
"""

import json
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[1]
hauberk = sys.argv[1] if len(sys.argv) > 1 else root / "build/release/bin/hauberk"
pages = root / "share/doc"

# Name, title, repeat, directions in degrees.
WEAVES = [("chain", "Chain", (4, 1), [0]), ("european_4in1", "European 4-in-1", (4, 7), [0, 90]),
          ("european_6in1", "European 6-in-1", (4, 7), [0, 90]), ("japanese_4in1", "Japanese 4-in-1", (3, 3), [0, 45]),
          ("japanese_6in1", "Japanese 6-in-1", (3, 2), [0, 90]), ("threefold", "Threefold", (4, 4), [0, 90]),
          ("fourfold", "Fourfold", (4, 4), [0, 45]), ("dragonscale", "Dragonscale", (3, 3), [0, 90]),
          ("box", "Box chain", (5, 1), [0]), ("byzantine", "Byzantine", (2, 1), [0]),
          ("half_persian_3in1", "Half Persian 3-in-1", (6, 1), [0]), ("half_persian_4in1", "Half Persian 4-in-1", (7, 1), [0]),
          ("full_persian_6in1", "Full Persian 6-in-1", (5, 1), [0])]


def run(*words):
    subprocess.run([str(hauberk), *map(str, words)], check=True, capture_output=True)


def experiment(name, directions):
    return {"name": name, "task": "limits", "length_unit": "mm", "cell": {"weave": {"name": name}},
            "load_case": {"plugin": "in_plane_periodic", "directions_deg": directions,
                          "out_of_plane": 0 if len(directions) > 1 else "free"}}


def picture(source, state, name, repeat):
    run("export", source, "-o", pages / "gallery" / name, "--state", state, "--repeat", f"{repeat[0]},{repeat[1]}",
        "--view", "20,50", "--size", "300,225", "--chord", "0.05", "--force")


def section(folder, name, title, repeat, directions):
    file = folder / f"{name}.json"
    file.write_text(json.dumps(experiment(name, directions)))
    out = folder / name
    run("run", file, "-o", out, "--quiet")
    limits = json.loads((out / "results.json").read_text())["limits"]
    picture(out, "rest", f"{name}.png", repeat)
    heads, pictures = ["at rest"], [f"![{title} at rest](gallery/{name}.png)"]
    for k, limit in enumerate(limits):
        if limit["status"] != "locked":
            continue
        sense = "stretched" if limit["sense"] == "stretch" else "compressed"
        heads.append(f"{sense} along {limit['direction_deg']:g}°: {100 * limit['value']:+.1f} %")
        picture(out, f"limit:{k}", f"{name}_{k}.png", repeat)
        pictures.append(f"![{title} {sense} along {limit['direction_deg']:g} degrees](gallery/{name}_{k}.png)")
    rows = []
    for k in range(0, len(heads), 3):
        rows += ["| " + " | ".join(heads[k:k + 3]) + " |", "|" + " --- |" * len(heads[k:k + 3]),
                 "| " + " | ".join(pictures[k:k + 3]) + " |", ""]
    return f"## {title}\n\n" + "\n".join(rows)


def main():
    (pages / "gallery").mkdir(exist_ok=True)
    text = ("# Gallery\n\nThe weaves that the program brings along, with the sizes of their files, as `share/gallery.py` "
            "computes and draws them:\nat rest and where contact locks them. Strains are those of the load's direction "
            "with the shear held, against the\narrangement at rest; every picture is one of `hauberk export`.\n\n")
    with tempfile.TemporaryDirectory() as folder:
        text += "\n".join(section(pathlib.Path(folder), *weave) for weave in WEAVES)
    (pages / "gallery.md").write_text(text.rstrip() + "\n")


if __name__ == "__main__":
    main()
