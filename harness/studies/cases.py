"""The cases of a study: each with its key, which says what went in, and its seed, which follows from the key."""

import hashlib
import json
import re
from collections.abc import Collection, Iterator
from functools import cache
from typing import Any, NamedTuple

from harness import __version__, resources
from harness.errors import InputError, InputErrors, did_you_mean
from harness.studies import design
from harness.studies.design import Point
from harness.studies.kinds import KINDS, load_kind
from harness.studies.model import Study, Subject


class Case(NamedTuple):
    """One row of the table to be: its number, its key, its seed and its point."""

    number: int
    key: str
    seed: int
    point: Point


class Identity(NamedTuple):
    """What a study's results follow from: its own definition, the aircraft's files, the code."""

    definition: str
    aircraft: str
    aircraft_files: str
    code: str


class Cases:
    """The cases of a study, made ready to run.

    Raises InputErrors for a factor or an output that leads nowhere, and for what is wrong in the mission.
    """

    def __init__(self, study: Study) -> None:
        from harness.mission.reader import read_mission  # takes half a second to load

        self.study = study
        self.count = design.count(study)
        mission = read_mission(study.mission_path)
        self.subject = Subject(study.mission_path.name, mission.text)
        self._probe()
        self.code = code_fingerprint()
        self.aircraft = mission.aircraft
        inputs = (study.kind, *self.subject, resources.fingerprint(mission.aircraft), self.code)
        fixed = [(override.path, override.value) for override in study.fixed]
        self._base = _digest([*inputs, *fixed])

    def __iter__(self) -> Iterator[Case]:
        sampled = self.study.design.n > 0
        for number, point in enumerate(design.points(self.study)):
            # Two samples may be the same point, and still are two cases: what is random in them differs.
            key = _digest([self._base, number if sampled else -1, [level and level.text for level in point]])
            yield Case(number, key, self._seed(key), point)

    def request(self, case: Case) -> dict[str, Any]:
        """All that another process needs to run a case, ready for JSON."""
        study = self.study
        varied = (
            factor.override(level)
            for factor, level in zip(study.factors, case.point, strict=True)
            if level is not None
        )
        return {
            "module": KINDS[study.kind],
            "subject": self.subject,
            "overrides": [(override.path, override.value) for override in (*study.fixed, *varied)],
            "seed": case.seed,
            "outputs": [output.path for output in study.outputs],
            "wall_limit": study.wall_limit,
            "code": self.code,
        }

    def _seed(self, key: str) -> int:
        return int(_digest([self.study.design.seed, key])[:15], 16)

    def _probe(self) -> None:
        study = self.study
        kind = load_kind(KINDS[study.kind])
        kind.probe(self.subject, study.fixed)
        faults: dict[str, InputError] = {}
        for point in design.probes(study):
            varied = [f.override(level) for f, level in zip(study.factors, point, strict=True) if level]
            try:
                kind.probe(self.subject, [*study.fixed, *varied])
            except InputError as error:
                every = error.every if isinstance(error, InputErrors) else [error]
                faults |= {str(fault): fault for fault in every}
        known = kind.outputs()
        for output in study.outputs:
            if output.path not in known:
                fault = InputError(
                    f'a {study.kind} has no output "{output.path}"',
                    file=study.source_path,
                    line=output.line,
                    remedy=_nearest(output.path, known),
                )
                faults[str(fault)] = fault
        if faults:
            raise InputErrors(faults.values())


def _nearest(path: str, known: Collection[str]) -> str:
    """A remedy for an output that is not known; one that is there in part leads to what is below or above it."""
    related = [
        each for each in known if each.startswith((f"{path}.", f"{path}[")) or each.endswith(f".{path}")
    ]
    return did_you_mean(path, related or known)


def identity(study: Study, aircraft: str) -> Identity:
    """What the results of a study follow from, without reading its mission."""
    texts = [file.read_text("utf-8", "replace") for file in (study.source_path, study.mission_path)]
    if base := re.search(r'<variant\b[^>]*\sof\s*=\s*"([^"]+)"', texts[-1]):
        texts.append(study.mission_path.with_name(f"{base[1]}.xml").read_text("utf-8", "replace"))
    return Identity(
        _digest(texts),
        aircraft,
        resources.fingerprint(aircraft),
        code_fingerprint(),
    )


@cache
def code_fingerprint() -> str:
    """SHA-256 over the harness's own files, and the libraries that make its numbers."""
    from importlib.metadata import version

    digest = hashlib.sha256(__version__.encode())
    for library in ("jsbsim", "numpy", "pyproj"):
        digest.update(f"{library} {version(library)}\n".encode())
    files = (file for file in resources.PACKAGE.rglob("*") if file.suffix in {".py", ".xsd", ".csv"})
    for name, file in sorted((file.relative_to(resources.PACKAGE).as_posix(), file) for file in files):
        if not name.startswith("data/"):  # of a wheel: aircraft and missions
            digest.update(f"{name}\n".encode() + file.read_bytes())
    return digest.hexdigest()


def _digest(value: object) -> str:
    return hashlib.sha256(json.dumps(value, ensure_ascii=False).encode()).hexdigest()[:32]
