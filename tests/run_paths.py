#!/usr/bin/env python3
"""Checks where the loader looks for the libraries of a program, of libraries and of plugins: nowhere but in folders
with an absolute path or one relative to the file itself. An empty path is the current directory, whoever put a library
there.

    tests/run_paths.py FILE...
"""

import re
import subprocess
import sys


def folders(file):
    text = subprocess.run(["readelf", "--dynamic", "--wide", file], check=True, capture_output=True, text=True).stdout
    if "(NEEDED)" not in text:
        sys.exit(f"{file}: needs no library, which this was to check")
    return [folder for path in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", text) for folder in path.split(":")]


def main(files):
    wrong = [(file, folder) for file in files for folder in folders(file) if not re.match(r"/|\$ORIGIN(/|$)", folder)]
    for file, folder in wrong:
        print(f"{file}: the loader looks in '{folder}'" + (", the current directory" if not folder else ""))
    return 1 if wrong or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
