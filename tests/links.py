#!/usr/bin/env python3
"""Relative links of the Markdown pages lead to files that are there, and their anchors to headings of these; paths
that they name in the tree of sources are there, too.

    tests/links.py ROOT
"""

import pathlib
import re
import sys

# A path of the tree between backticks; a file without its ending stands for header and source.
NAMED = re.compile(r"`((?:kernel|plugins|tests|shapes|loadcases|optimizers|share)/[\w/.-]+)`")
NOT_OF_THE_TREE = {"shapes/chain_link", "share/hauberk/weaves"}  # an example; where weaves are installed
LINK = re.compile(r"\[[^\]]*\]\(([^()\s]+)\)")


def prose(text):
    """The page without code: neither links nor headings are in it."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"^ {4}.*$", "", text, flags=re.MULTILINE)


def anchors(text):
    """As GitHub makes them: small letters, no punctuation, '-' for a space; the second of a name gets -1."""
    found = set(re.findall(r'<a name="([^"]+)"', text))
    times = {}
    for heading in re.findall(r"^#+ +(.*?)\s*$", prose(text), re.MULTILINE):
        slug = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
        count = times.get(slug, 0)
        times[slug] = count + 1
        found.add(f"{slug}-{count}" if count else slug)
    return found


def pages(root):
    """All pages, but not those of build trees, of results, of packages of node, and of folders with a dot."""
    for page in sorted(root.rglob("*.md")):
        parts = page.relative_to(root).parts
        if parts[0] not in ("build", "out") and not any(
            part.startswith(".") or part == "node_modules" for part in parts
        ):
            yield page


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    seen = wrong = 0
    for page in pages(root):
        text = page.read_text()
        for target in LINK.findall(re.sub(r"`[^`\n]*`", "", prose(text))):
            if re.match(r"[a-z]+:", target):
                continue
            seen += 1
            path, _, anchor = target.partition("#")
            file = page.parent / path if path else page
            if not file.exists():
                print(f"{page.relative_to(root)}: {target}: there is no such file")
                wrong += 1
            elif anchor and anchor not in anchors(file.read_text()):
                print(f"{page.relative_to(root)}: {target}: there is no such heading")
                wrong += 1
        if not (root / "CMakeLists.txt").exists():  # installed pages lie beside a part of the tree
            continue
        for name in NAMED.findall(text):
            file = root / name
            if name not in NOT_OF_THE_TREE and not file.exists() and not list(file.parent.glob(file.name + ".*")):
                print(f"{page.relative_to(root)}: `{name}`: there is nothing of that name")
                wrong += 1
    if seen == 0:
        print("no links found")
    return 1 if wrong or seen == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
