#!/usr/bin/env python3
"""Sees to it that the interface revision rises when what plugins are compiled against changes: every revision is
recorded with a fingerprint of the declarations in kernel/api, comments and blanks aside.

    tests/interface_revision.py ROOT
"""

import hashlib
import pathlib
import re
import sys


def declarations(header):
    text = header.read_text()
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    text = re.sub(r"interface_revision = \d+", "interface_revision", text)
    return " ".join(text.split())


def main():
    root = pathlib.Path(sys.argv[1])
    api = root / "kernel/api"
    headers = sorted((api / "hauberk").glob("*.hpp"))
    text = "\n".join(f"{h.name}: {declarations(h)}" for h in headers)
    found = hashlib.sha256(text.encode()).hexdigest()
    revision = re.search(r"interface_revision = (\d+)", (api / "hauberk/plugin.hpp").read_text()).group(1)
    recorded = dict(line.split() for line in (api / "revisions.txt").read_text().splitlines() if line)
    if recorded.get(revision) == found:
        return 0
    last = max(map(int, recorded), default=0)
    if revision in recorded:
        print(f"the declarations in kernel/api are not those of interface revision {revision}: raise it in "
              f"kernel/api/hauberk/plugin.hpp, and add this line to kernel/api/revisions.txt:\n{last + 1} {found}")
    else:
        print(f"interface revision {revision} is not recorded: add this line to kernel/api/revisions.txt:\n"
              f"{revision} {found}")
    return 1


if __name__ == "__main__":
    sys.exit(main())
