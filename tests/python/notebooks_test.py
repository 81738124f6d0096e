#!/usr/bin/env python3
"""Runs the cells of every notebook in order, as a kernel would; what they assert must hold.

    notebooks_test.py FOLDER
"""

import contextlib
import io
import json
import pathlib
import sys

notebooks = sorted(pathlib.Path(sys.argv[1]).glob("*.ipynb"))
assert len(notebooks) == 3, notebooks
for notebook in notebooks:
    document = json.loads(notebook.read_text(encoding="utf-8"))
    assert document["nbformat"] == 4
    names, cells = {}, 0
    for cell in document["cells"]:
        if cell["cell_type"] != "code":
            continue
        assert not cell["outputs"], f"{notebook.name}: notebooks are kept without outputs"
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile("".join(cell["source"]), f"{notebook.name}, cell {cells}", "exec"), names)  # pylint: disable=exec-used
        cells += 1
    print(f"{notebook.name}: {cells} cells")
