#!/usr/bin/env python3
"""Draws the floors of the house: which folder includes headers of which others. Fails on an arrow that is not
in the plan below, and on one of the plan that nothing needs.

    tests/floors.py ROOT
"""

import pathlib
import re
import sys

# A folder may include itself and what is listed for it ("kernel": any folder of the kernel; "plugins/tasks/*": of a
# task); the order is from the ground upwards, so that a list names folders of lines above only.

# What a folder of a task may include that the plan does not name.
TASK = ["kernel", "plugins/document", "plugins/experiment", "plugins/results", "plugins/pictures", "plugins/run",
        "plugins/tasks/task.hpp", "plugins/tasks/variants"]
PLAN = {
    "kernel/api": [],  # what plugins see
    "kernel/numerics": [],
    "kernel/on_demand": ["kernel/numerics"],  # what is loaded where it is used
    "kernel/geometry": ["kernel/api"],
    "kernel/interfaces": ["kernel/api", "kernel/numerics", "kernel/geometry"],
    "kernel/contact": ["kernel/api", "kernel/geometry", "kernel/numerics"],
    "kernel/model": ["kernel/api", "kernel/numerics", "kernel/geometry"],
    "kernel/motion": ["kernel/api", "kernel/numerics", "kernel/geometry", "kernel/contact", "kernel/model"],
    "kernel/equilibrium": ["kernel/api", "kernel/numerics", "kernel/geometry", "kernel/contact", "kernel/model",
                           "kernel/motion"],
    "kernel/limits": ["kernel/api", "kernel/numerics", "kernel/geometry", "kernel/model", "kernel/motion",
                      "kernel/equilibrium"],
    "kernel/design": ["kernel/api", "kernel/numerics", "kernel/geometry", "kernel/model", "kernel/motion",
                      "kernel/equilibrium", "kernel/limits"],
    "shapes": ["kernel/api"],
    "loadcases": ["kernel/api"],
    "optimizers": ["kernel/api", "kernel/numerics"],
    "plugins/host": ["kernel/api"],
    "plugins/document": ["kernel/api"],
    "plugins/experiment": ["kernel", "plugins/host", "plugins/document"],
    "plugins/results": ["kernel", "plugins/document"],
    "plugins/pictures": ["kernel", "plugins/document"],
    "plugins/archive": ["kernel/api", "kernel/numerics"],
    "plugins/export": ["kernel", "plugins/archive", "plugins/document", "plugins/results"],
    "plugins/inspect": ["kernel", "shapes", "plugins/archive"],
    "plugins/report": ["kernel", "plugins/document", "plugins/results", "plugins/pictures"],
    "plugins/verify": ["kernel/api"],  # independent: it reads results by itself; the interface of primitives alone
    "plugins/conformance": ["kernel", "plugins/host", "plugins/document"],
    "plugins/parts": ["kernel", "plugins/document"],
    "plugins/run": ["kernel", "plugins/host", "plugins/document", "plugins/experiment", "plugins/results",
                    "plugins/pictures"],
    "plugins/tasks/task.hpp": ["kernel", "plugins/run"],
    "plugins/tasks/variants": ["kernel", "plugins/document", "plugins/experiment", "plugins/run"],
    "plugins/tasks/limits": ["kernel", "plugins/document", "plugins/results", "plugins/pictures", "plugins/experiment",
                             "plugins/run", "plugins/tasks/task.hpp"],
    "plugins/tasks/design": ["kernel", "plugins/document", "plugins/experiment", "plugins/results", "plugins/run",
                             "plugins/parts", "plugins/tasks/task.hpp", "plugins/tasks/limits"],
    "plugins/tasks/stability": TASK + ["plugins/verify"],
    # The table of all tasks, and what check, plan and run begin from.
    "plugins/tasks": ["kernel", "plugins/document", "plugins/experiment", "plugins/results", "plugins/run",
                      "plugins/tasks/*"],
    "plugins/maker": ["kernel", "plugins/host", "plugins/document", "plugins/experiment", "plugins/run", "plugins/tasks"],
    "plugins/command": ["kernel", "plugins/host", "plugins/document", "plugins/experiment", "plugins/results",
                        "plugins/report", "plugins/export", "plugins/inspect", "plugins/maker", "plugins/verify", "plugins/conformance", "plugins/run",
                        "plugins/parts", "plugins/tasks"],
}


def folder_of(root, path):
    parts = path.relative_to(root).parts
    if parts[:2] == ("plugins", "tasks") and (len(parts) > 3 or parts[2] == "task.hpp"):
        return "/".join(parts[:3])
    return "/".join(parts[:2]) if parts[0] in ("plugins", "kernel") else parts[0]


def allows(listed, owner):
    return listed == owner or (listed == "kernel" and owner.startswith("kernel/")) or (
        listed == "plugins/tasks/*" and owner.startswith("plugins/tasks/"))


def allowed_for(own):
    return PLAN.get(own, TASK if own.startswith("plugins/tasks/") else [])


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    tops = ["kernel", "shapes", "loadcases", "optimizers", "plugins"]
    files = [f for top in tops for f in (root / top).rglob("*.?pp")]
    files = [f for f in files if "template" not in f.parts and "test" not in f.relative_to(root).parts]
    # What an include means: the folder of the header that its text ends.
    homes = {}
    for f in files:
        if f.suffix != ".hpp":
            continue
        relative = f.relative_to(root).parts
        for k in range(1, len(relative)):
            homes.setdefault("/".join(relative[k:]), set()).add(folder_of(root, f))
    found = {}
    for f in files:
        own = folder_of(root, f)
        for line, text in enumerate(f.read_text().splitlines(), 1):
            match = re.match(r'\s*#include\s+["<]([^">]+)[">]', text)
            owners = homes.get(match.group(1), set()) if match else set()
            if not owners or own in owners:
                continue
            for owner in owners:
                found.setdefault((own, owner), f"{f.relative_to(root)}:{line}")
    wrong = 0
    for (own, owner), place in sorted(found.items()):
        if not any(allows(listed, owner) for listed in allowed_for(own)):
            print(f"{place}: {own} includes {owner}, which the plan (tests/floors.py) does not allow")
            wrong += 1
    names = list(PLAN)
    for own, allowed in PLAN.items():
        for owner in allowed:
            if owner not in ("kernel", "plugins/tasks/*") and names.index(owner) >= names.index(own):
                print(f"the plan is no house: {own} stands below {owner}")
                wrong += 1
            if not any(own == of and allows(owner, what) for of, what in found):
                print(f"nothing needs {own} to include {owner}: take it out of the plan (tests/floors.py)")
                wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
