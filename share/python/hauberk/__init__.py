"""Deformation limits of discrete interlocking materials.

    import hauberk
    results = hauberk.Experiment("share/experiments/chain.json").run()
    results.value(0, "stretch")            # 0.43333333...
    results.limits                          # a numpy array with named columns

Lengths are in the unit of the experiment, strains and curvatures as in results.json (share/doc/results.md). Numbers are
those of the command, bit for bit.
"""

import json
import os
import pathlib
import subprocess

import numpy

from . import _hauberk
from ._hauberk import ComputationError, InputError, Problem as DesignProblem

__all__ = ["ComputationError", "DesignProblem", "Experiment", "InputError", "Problem", "Results", "export",
           "forces_for_tension", "load"]

# <root>/lib/hauberk/python/hauberk: plugins and weaves are found from <root>, as the program finds its own.
_root = pathlib.Path(__file__).resolve().parents[4]


class Problem:
    """A mistake in an experiment: `line` (0: none), JSON `pointer`, `message`."""

    def __init__(self, line, pointer, message):
        self.line, self.pointer, self.message = line, pointer, message

    def __repr__(self):
        place = f"line {self.line}: " if self.line else ""
        return f"{place}{self.pointer or '/'}: {self.message}"


def _folders(plugin_path):
    """Folders as a list: one path is one folder."""
    return [os.fspath(plugin_path)] if isinstance(plugin_path, (str, os.PathLike)) else [os.fspath(one) for one in plugin_path]


class Experiment:
    """An experiment: a dict, a path, or text of a file (JSON with comments).

    `plugin_path`: a folder, or several, that are searched for plugins first. Immutable: `set` gives another experiment.
    """

    def __init__(self, what, plugin_path=()):
        if isinstance(what, dict):
            self._text, self._file = json.dumps(what), "experiment"
        elif isinstance(what, os.PathLike) or "{" not in what:
            self._file = os.fspath(what)
            try:
                self._text = pathlib.Path(self._file).read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError) as error:
                raise InputError(f"cannot read '{self._file}': {error}") from None
        else:
            self._text, self._file = what, "experiment"
        self._overrides = []
        self._folders = _folders(plugin_path)

    def set(self, pointer, value):
        """The same experiment with `value` (anything JSON has) at a JSON pointer, as `hauberk run --set` puts it."""
        other = Experiment.__new__(Experiment)
        other._text, other._file, other._folders = self._text, self._file, self._folders
        other._overrides = [*self._overrides, f"{pointer}={json.dumps(value)}"]
        return other

    def _source(self):
        return _hauberk.Source(self._text, self._file, self._overrides, self._folders, str(_root))

    def check(self):
        """Every mistake in it, as a list of `Problem`; empty if there is none."""
        return [Problem(*problem) for problem in _hauberk.problems(self._source())]

    def plan(self):
        """What will be modelled, as the dict that results hold. Raises InputError where `check` finds problems."""
        return json.loads(_hauberk.plan(self._source())[1])

    def run(self, threads=None, output=None, force=False, progress=False, optimizer=None):
        """Computes it and returns `Results`.

        `output`: a folder that gets the files of `hauberk run`; `force` replaces results in it. `progress`: shown on
        standard error. Ctrl-C raises KeyboardInterrupt, whose `results` are what was found; other Python threads run on
        meanwhile. One run at a time in a process. Raises InputError and ComputationError with the program's texts;
        limits without an answer do not raise: see `Results.failed`.

        `optimizer`: a function that a design is searched with instead of the plugin that it names. It is called with a
        `DesignProblem` and returns the best point, or None for the best that it accepted; what it raises ends the run. Results name
        it `caller`.
        """
        threads = len(os.sched_getaffinity(0)) if threads is None else int(threads)
        if not 1 <= threads <= 4096:
            raise InputError(f"threads: expected a number from 1 to 4096, found {threads}")
        folder = "" if output is None else os.fspath(output)
        if optimizer is not None and not callable(optimizer):
            raise InputError("optimizer: expected a function of one argument, the problem")
        outcome = _hauberk.run(self._source(), threads, folder, force, progress, optimizer)
        results = Results(json.loads(outcome.results), outcome.results, outcome.failed, outcome.summary, self._folders)
        if outcome.interrupted:
            stop = KeyboardInterrupt("interrupted; .results holds what was found")
            stop.results = results
            raise stop
        return results


def _number(value):
    return numpy.nan if value is None else float(value)


class Results:
    """A results.json. `raw` is all of it; `failed` whether something asked for has no answer."""

    def __init__(self, raw, text=None, failed=None, summary="", plugin_path=()):
        self.raw, self.failed, self.summary = raw, failed, summary
        self._text = json.dumps(raw) if text is None else text
        self._folders = _folders(plugin_path)

    @property
    def limits(self):
        """A structured array: direction_deg, sense, value, error_estimate, min_gap, status, confidence. NaN for null."""
        kinds = [("direction_deg", float), ("sense", "U12"), ("value", float), ("error_estimate", float),
                 ("min_gap", float), ("status", "U16"), ("confidence", "U16")]
        rows = [(_number(limit.get("direction_deg")), limit["sense"], _number(limit["value"]),
                 _number(limit["error_estimate"]), _number(limit["min_gap"]), limit["status"],
                 (limit.get("confidence") or {}).get("word", "")) for limit in self.raw["limits"]]
        return numpy.array(rows, dtype=kinds)

    @property
    def rows(self):
        """A structured array of a sweep: a column per quantity that is varied, one per measure (NaN where there is none), status.

        Raises InputError where the results are no sweep's."""
        sweep = self._sweep()
        varied, measured = ([entry["name"] for entry in sweep[key]] for key in ("axes", "measures"))
        # A quantity may be varied and measured under one name.
        names = varied + [name if name not in varied else f"measured {name}" for name in measured]
        kinds = [(name, float) for name in names] + [("status", "U16")]
        rows = [(*(_number(row["values"][name]) for name in varied),
                 *(_number((row["measured"] or {}).get(name)) for name in measured), row["status"]) for row in sweep["rows"]]
        return numpy.array(rows, dtype=kinds)

    def row(self, number):
        """Results of one row of a sweep, as a run of it alone would have given them. Raises InputError where it has none."""
        rows = self._sweep()["rows"]
        if not 0 <= number < len(rows):
            raise InputError(f"row {number}: the sweep has {len(rows)} rows, 0 to {len(rows) - 1}")
        if rows[number]["result"] is None:
            raise InputError(f"row {number}: it has no result ({rows[number]['status']}: {rows[number]['message']})")
        return Results(rows[number]["result"], plugin_path=self._folders)

    def _sweep(self):
        if not self.raw.get("sweep"):
            raise InputError("these are no results of a sweep")
        return self.raw["sweep"]

    def to_pandas(self):
        """`limits`, of a sweep `rows`, as a DataFrame. Raises ImportError where pandas is not installed."""
        try:
            import pandas  # pylint: disable=import-outside-toplevel
        except ModuleNotFoundError:
            raise ImportError("to_pandas() needs pandas (Debian's python3-pandas); `limits` and `rows` are numpy arrays") from None
        return pandas.DataFrame(self.rows if self.raw.get("sweep") else self.limits)

    def _limit(self, direction_deg, sense):
        for limit in self.raw["limits"]:
            if limit["sense"] == sense and limit.get("direction_deg") == direction_deg:
                return limit
        known = ", ".join(f"{limit['sense']} at {limit.get('direction_deg')}" for limit in self.raw["limits"])
        there = f"there are {known}" if known else "there is none"
        if not known and self.raw.get("sweep"):
            there = "limits of a sweep are those of its rows: row(0)"
        raise KeyError(f"no limit {sense} at {direction_deg}; {there}")

    def value(self, direction_deg, sense):
        """The value of a limit; NaN where it has none."""
        return _number(self._limit(direction_deg, sense)["value"])

    def poses(self, limit=None):
        """n x 7: position, then quaternion w x y z, of every element; of limit number `limit`, None: at rest."""
        if limit is None:
            poses = [element["rest"] for element in self.raw["scene"]["elements"]]
        else:
            poses = self.raw["limits"][limit]["poses"]
        return numpy.array([[*pose["position"], *pose["quaternion"]] for pose in poses], dtype=float).reshape(-1, 7)

    def contacts(self, limit):
        """A structured array of the contacts of limit number `limit`: elements, image, points, normal, gap, force."""
        kinds = [("elements", int, 2), ("image", int, 3), ("points", float, (2, 3)), ("normal", float, 3),
                 ("gap", float), ("force", float)]
        rows = []
        for contact in self.raw["limits"][limit]["contacts"]:
            points = (contact["points"] * 2)[:2] if contact["points"] else [[numpy.nan] * 3] * 2
            rows.append((contact["elements"], (*contact["image"], 0)[:3], points, contact["normal"],
                         _number(contact["gap"]), contact["force"]))
        return numpy.array(rows, dtype=kinds)

    def profile(self):
        """A structured array: direction_deg, e_s, e_c, eta."""
        kinds = [(name, float) for name in ("direction_deg", "e_s", "e_c", "eta")]
        return numpy.array([tuple(_number(row[name]) for name, _ in kinds) for row in self.raw["profiles"]], dtype=kinds)

    def verify(self):
        """(passed, text): the independent check, as `hauberk verify` makes it; passed: nothing failed.

        Lines of the text that begin with NONE had nothing to check, as those of scenes whose plugins are not there."""
        source = _hauberk.Source("", "", [], self._folders, str(_root))
        return _hauberk.verify(self._text, "results", source)

    def save(self, path):
        """Writes results.json; refuses a file that is there."""
        with open(path, "x", encoding="utf-8") as file:
            file.write(self._text)


def load(path, plugin_path=()):
    """Results from a results.json, or from a folder with one. `plugin_path`: where `verify` looks for plugins first."""
    path = pathlib.Path(path)
    if path.is_dir():
        path /= "results.json"
    try:
        text = path.read_text(encoding="utf-8")
        raw = json.loads(text)
    except (OSError, ValueError) as error:
        raise InputError(f"cannot read '{path}': {error}") from None
    if not str(raw.get("format", "")).startswith("hauberk-results/"):
        raise InputError(f"'{path}' is no results.json of Hauberk")
    return Results(raw, text, plugin_path=plugin_path)


def export(source, target, state=None, repeat=None, outline=None, chord=None, require_gap=None, force=False,
           separate=False, row=None, plugin_path=()):
    """Writes a fabric as `hauberk export` does: the ending of `target` says in which format. Returns what it says of gaps
    and volume.

    `source`: a file of an experiment or of results, or a folder of results. `repeat`: copies along the cell's vectors.
    `separate`: of .3mf, an object for each kind of element and an item for each copy instead of one object. `row`: of a
    sweep. Runs the command beside the package. Raises InputError, and ComputationError where a gap is smaller than required.
    """
    words = [str(_root / "bin" / "hauberk"), "export", os.fspath(source), "-o", os.fspath(target)]
    repeated = None if repeat is None else ",".join(str(n) for n in repeat)
    for name, value in (("state", state), ("repeat", repeated), ("outline", outline), ("chord", chord),
                        ("require-gap", require_gap), ("row", row)):
        if value is not None:
            words += [f"--{name}", str(value)]
    for folder in _folders(plugin_path):
        words += ["--plugin-path", folder]
    words += [word for word, given in (("--force", force), ("--separate", separate)) if given]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return done.stdout
    raise (InputError if done.returncode == 2 else ComputationError)(done.stderr.strip())


def forces_for_tension(results, limit, tension):
    """Contact forces in newtons of an in-plane limit under a tension along its direction.

    The program's load has no unit: contact forces balance a unit load on the reported value e, so that their virtual work
    is sum f_k dg_k = de. A cell of area A under the tension T (N/m) does the work T A de: forces are T A times as large.
    `tension` in N/m, positive also for compression; lengths in the experiment's unit.
    """
    unit = {"m": 1.0, "mm": 1e-3, "um": 1e-6}[results.raw["experiment"]["length_unit"]]
    vectors = results.raw["scene"]["cell_vectors"]
    if len(vectors) != 2:
        raise InputError("forces for a tension are those of a sheet, whose cell has two vectors")
    (ax, ay), (bx, by) = vectors
    area = abs(ax * by - ay * bx) * unit**2
    # de has no unit and dg the experiment's: per metre of gap, forces are 1/unit as large.
    return results.contacts(limit)["force"] * tension * area / unit
