#!/usr/bin/env python3
"""The code in share/doc/plugins.md is that of the template, which is compiled and run: doc_test.py DOC TEMPLATE_FOLDER."""

import pathlib
import re
import sys

# Template, kind of plugin, name, class.
PROJECTS = [("shape", "shape", "figure_eight", "FigureEight"), ("solid", "shape", "oval", "Oval"),
            ("load_case", "load_case", "isotropic", "Isotropic"), ("patch", "load_case", "frame", "Frame"),
            ("optimizer", "optimizer", "spectral", "Spectral")]


def lines(text):
    """Lines without indentation, and without empty ones: code in prose may be cut out of a class."""
    return [line.strip() for line in text.splitlines() if line.strip()]


def template(folder):
    files = {}
    for template_name, kind, name, class_name in PROJECTS:
        for file in sorted([*(folder / "common").iterdir(), *(folder / template_name).iterdir()]):
            text = file.read_text()
            for mark, value in (("plugin_name", name), ("PluginName", class_name), ("plugin_kind", kind),
                                ("plugin_template", template_name)):
                text = text.replace(mark, value)
            files[f"{template_name}/{file.name}"] = lines(text)
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
