#!/usr/bin/env python3
"""The code in share/doc/plugins.md is that of the template, which is compiled and run: doc_test.py DOC TEMPLATE_FOLDER."""

import pathlib
import re
import sys

PROJECTS = {"shape": ("figure_eight", "FigureEight"), "load_case": ("isotropic", "Isotropic"),
            "optimizer": ("spectral", "Spectral")}


def lines(text):
    """Lines without indentation, and without empty ones: code in prose may be cut out of a class."""
    return [line.strip() for line in text.splitlines() if line.strip()]


def template(folder):
    files = {}
    for kind, (name, class_name) in PROJECTS.items():
        for file in sorted([*(folder / "common").iterdir(), *(folder / kind).iterdir()]):
            text = file.read_text()
            for mark, value in (("plugin_name", name), ("PluginName", class_name), ("plugin_kind", kind)):
                text = text.replace(mark, value)
            files[f"{kind}/{file.name}"] = lines(text)
    return files


def found(block, files):
    return any(block == text[at:at + len(block)] for text in files.values() for at in range(len(text)))


def main():
    doc, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    blocks = re.findall(r"```(cpp|cmake|jsonc)\n(.*?)```", doc.read_text(), re.DOTALL)
    files = template(folder)
    strange = [text for _, text in blocks if not found(lines(text), files)]
    for text in strange:
        print(f"{doc}: this is not in the template:\n{text}")
    if len(blocks) < 8:
        print(f"{doc}: only {len(blocks)} blocks of code found")
    return 1 if strange or len(blocks) < 8 else 0


sys.exit(main())
