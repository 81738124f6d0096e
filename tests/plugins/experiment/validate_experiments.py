"""Validates experiment files against the checked-in schema with a validator that is not ours.

usage: validate_experiments.py SCHEMA FILE_OR_FOLDER...
"""

import copy
import json
import pathlib
import re
import sys

import jsonschema

STRING = r'"(?:\\.|[^"\\])*"'


def read_jsonc(path):
    """JSON with comments and trailing commas; strings are left alone."""
    text = path.read_text(encoding="utf-8")
    keep_strings = lambda match: match.group(0) if match.group(0).startswith('"') else " "
    text = re.sub(STRING + r"|//[^\n]*|/\*.*?\*/", keep_strings, text, flags=re.S)
    text = re.sub(STRING + r"|,(?=\s*[}\]])", keep_strings, text)
    return json.loads(text)


def mistakes(document):
    """Damaged copies of a correct experiment, with what is wrong in each."""

    def damaged(what, change):
        result = copy.deepcopy(document)
        change(result)
        return what, result

    yield damaged("unknown key", lambda d: d.update(unknown=1))
    yield damaged("no name", lambda d: d.pop("name"))
    yield damaged("wrong preset", lambda d: d.setdefault("solver", {}).update(preset="fats"))
    yield damaged("negative clearance", lambda d: d.setdefault("solver", {}).update(clearance=-1))
    yield damaged("no starts", lambda d: d.setdefault("solver", {}).update(starts=0))
    yield damaged("vector of four", lambda d: d["cell"].update(vectors=[[1, 0, 0, 0], [0, 1]]))
    yield damaged("nothing placed", lambda d: d["cell"].update(place=[]))
    yield damaged("unknown key of the load case", lambda d: d["load_case"].update(mesure="tensor"))
    if "elements" in document:  # a weave may bring them
        yield damaged("unknown key of a shape", lambda d: next(iter(d["elements"].values())).update(tory=[]))


def main():
    schema = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    files = []
    for argument in map(pathlib.Path, sys.argv[2:]):
        files += [argument] if argument.is_file() else sorted(argument.rglob("*.json"))
    failures = 0
    for path in files:
        document = read_jsonc(path)
        for error in validator.iter_errors(document):
            failures += 1
            print(f"{path}: /{'/'.join(map(str, error.absolute_path))}: {error.message}")
        for what, wrong in mistakes(document):
            if validator.is_valid(wrong):
                failures += 1
                print(f"{path}: the schema accepts a copy with a mistake: {what}")
    # What a file that extends another leaves out, the schema cannot know.
    part = {"extends": "other.json", "name": "part", "load_case": {"hold": []}, "solver": None}
    for what, document, right in (("a part", part, True), ("a part without a name", {"extends": "other.json"}, False),
                                  ("a part of a number", {**part, "extends": 5}, False)):
        if validator.is_valid(document) != right:
            failures += 1
            print(f"{what}: the schema {'refuses' if right else 'accepts'} it")
    if not files:
        print("no experiment files found")
        failures += 1
    print(f"{len(files)} files, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
