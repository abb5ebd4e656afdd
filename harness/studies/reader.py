"""Reads a study file into a Study. Every fault has its file and line; one reading reports them all."""

import math
import re
from pathlib import Path
from typing import cast

from harness import resources
from harness.errors import InputError, did_you_mean, shorten
from harness.mission.overrides import Override
from harness.studies.kinds import KINDS
from harness.studies.model import (
    SAMPLED,
    SI,
    Design,
    DesignKind,
    Distribution,
    Factor,
    Level,
    Output,
    Scale,
    Steps,
    Study,
    column_name,
)
from harness.units import UnitError, parse
from harness.xml_source import Element, Source, children

SCHEMA = "study.xsd"
WALL_LIMIT = 600.0  # s of the clock on the wall for one case, where the study says nothing
MOST_VALUES = 1000  # in a list: more are a range
LARGEST_SEED = 2**63 - 1
TAKEN = ("case", "key", "seed", "status", "reason")
"""The columns that every table has."""

_QUANTITY = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)[ \t]*(.*)", re.ASCII)
_QUALIFIERS = ("", "CAS", "TAS", "true", "magnetic")
_SPREADS = ("values", "range", "normal", "lognormal", "triangular")


def read_study(path: str | Path) -> Study:
    """Read a study file.

    Raises InputErrors: what is wrong in the file by itself. Whether its factors lead somewhere in the mission is
    for `harness.studies.cases`.
    """
    source = Source(Path(path), SCHEMA, "study")
    source.validate()
    study = _Reader(source).study()
    source.finish()
    return study


class _Reader:
    """Turns the elements of one study into its model; faults are noted in the source."""

    def __init__(self, source: Source) -> None:
        self.source = source

    def study(self) -> Study:
        """The study; parts with faults are not to be used, so the caller must look at the faults."""
        root, source = self.source.root, self.source
        description = source.one(root, "description", needed=False)
        kind = root.get("kind", "flight")
        if kind not in KINDS:
            source.fault(f'kind="{shorten(kind)}" is not known', root, "kind", did_you_mean(kind, KINDS))
        source.distinct(children(root, "factor"), "path")
        source.distinct(children(root, "output"), "name")
        design = self._design(source.one(root, "design", needed=False))
        return Study(
            name=root.get("name", ""),
            description=" ".join((description.text or "").split()) if description is not None else "",
            kind=kind,
            mission_path=self._mission(root),
            wall_limit=self._wall_limit(root),
            fixed=tuple(
                Override(line.get("path", ""), line.get("value", ""), *source.place(line))
                for line in children(root, "set")
            ),
            factors=self._factors(design),
            design=design,
            outputs=self._outputs(root),
            source_path=source.path,
        )

    def _mission(self, root: Element) -> Path:
        of = root.get("of", "")
        beside = self.source.path.with_name(f"{of}.xml")
        try:
            own = beside.is_file() and not beside.samefile(self.source.path)
            return beside if own else resources.find_mission(of)
        except InputError as error:
            self.source.fault(f'of="{shorten(of)}": {error.what}', root, "of", error.remedy)
        return beside

    def _wall_limit(self, root: Element) -> float:
        limit = self.source.quantity(root, "wall-limit", "time", WALL_LIMIT)
        if limit <= 0:
            self.source.fault(
                "the wall-limit is more than zero", root, "wall-limit", 'e.g. wall-limit="2 min"'
            )
        return limit

    def _design(self, element: Element | None) -> Design:
        if element is None:
            return Design("grid")
        kind = cast(DesignKind, element.get("kind", "grid"))
        n = self._whole(element, "n", 2**31)
        seed = self._whole(element, "seed", LARGEST_SEED)
        if kind in SAMPLED and self.source.needed(element, "n", "64") and n < 1:
            self.source.fault("n is at least 1", element, "n")
        if kind not in SAMPLED and element.get("n") is not None:
            what = f"a {kind} design has as many cases as its factors have levels"
            self.source.fault(what, element, "n", "delete the n")
        if kind == "sobol" and n & (n - 1):
            low = 1 << (n.bit_length() - 1)
            what = f"n={n} is not a power of 2, which a Sobol sequence needs to be balanced"
            self.source.fault(what, element, "n", f"write {low} or {2 * low}")
        return Design(kind, n, seed)

    def _whole(self, element: Element, attribute: str, largest: int) -> int:
        text = element.get(attribute, "0")
        if re.fullmatch(r"[0-9]{1,19}", text, re.ASCII) and int(text) <= largest:
            return int(text)
        what = f'{attribute}="{shorten(text)}" is not a whole number from 0 to {largest}'
        self.source.fault(what, element, attribute, f'e.g. {attribute}="64"')
        return 0

    def _factors(self, design: Design) -> tuple[Factor, ...]:
        elements = list(children(self.source.root, "factor"))
        if not elements and design.kind != "monte-carlo":
            remedy = 'add <factor path="loading/fuel"><values list="8 t, 12 t"/></factor>'
            self.source.fault("the study varies nothing", self.source.root, remedy=remedy)
        factors = [factor for element in elements if (factor := self._factor(element, design))]
        seen = set(TAKEN)
        for element, factor in zip(elements, factors, strict=False):
            if factor.column in seen:
                what = f'the column "{factor.column}" would be there twice'
                self.source.fault(what, element, "name", "give the factor a name of its own")
            seen.add(factor.column)
        return tuple(factors)

    def _factor(self, element: Element, design: Design) -> Factor | None:
        found = [spread for tag in _SPREADS for spread in children(element, tag)]
        if len(found) != 1:
            what = f"the factor has {len(found)} spreads, not one"
            self.source.fault(what, element, remedy=f"give it one of {', '.join(f'<{s}>' for s in _SPREADS)}")
            return None
        try:
            spread = self._spread(found[0], sampled=design.kind in SAMPLED)
        except UnitError as error:
            what, _, remedy = str(error).partition("; ")
            self.source.fault(what, found[0], remedy=remedy)
            return None
        if isinstance(spread, Distribution) and design.kind not in SAMPLED:
            self.source.fault(
                f"a {design.kind} design needs levels, and <{found[0].tag}> has none",
                found[0],
                remedy='give the range a step="...", or a list of values, or choose a sampled design',
            )
            return None
        unit = SI[_scale_of(spread).unit][0]
        path = element.get("path", "")
        column = column_name(element.get("name", path), unit)
        return Factor(path, column, unit, spread, *self.source.place(element))

    def _spread(self, element: Element, *, sampled: bool) -> tuple[Level, ...] | Steps | Distribution:
        """The spread of a factor. Raises UnitError."""
        if element.tag == "values":
            return _values(element.get("list", ""))
        names = [name for name in element.attrib if name != "sigma"]
        first = next(name for name in ("mean", "median", "from") if name in names)
        scale = _number(element.get(first, ""), None, first)[1]
        numbers = {str(name): _number(element.get(name, ""), scale, str(name))[0] for name in names}
        if element.tag == "range":
            return _range(numbers, scale, sampled=sampled)
        if element.tag == "triangular":
            low, mode, high = numbers["from"], numbers["mode"], numbers["to"]
            if not low <= mode <= high or low == high:
                raise UnitError("the triangle is empty; from, mode and to must follow one another")
            return Distribution(scale, "triang", ((mode - low) / (high - low),), low, high - low)
        if element.tag == "lognormal":
            sigma = parse(element.get("sigma", ""), "ratio")
            if sigma <= 0 or numbers["median"] <= 0:
                raise UnitError("the median and the sigma (of the logarithm) must be more than zero")
            return Distribution(scale, "lognorm", (sigma,), 0.0, numbers["median"])
        return _normal(numbers, scale)

    def _outputs(self, root: Element) -> tuple[Output, ...]:
        elements = list(children(root, "output"))
        if not elements:
            self.source.fault("the study keeps nothing", root, remedy='add <output name="fuel_burned_kg"/>')
        outputs = [
            Output(e.get("name", ""), e.get("column", e.get("name", "")), self.source.place(e)[1])
            for e in elements
        ]
        seen = set(TAKEN)
        for element, output in zip(elements, outputs, strict=True):
            if output.column in seen:
                what = f'the column "{shorten(output.column)}" would be there twice'
                self.source.fault(what, element, remedy='give the output a column="..." of its own')
            seen.add(output.column)
        return tuple(outputs)


def _scale_of(spread: tuple[Level, ...] | Steps | Distribution) -> Scale:
    if isinstance(spread, Distribution | Steps):
        return spread.scale
    return Scale() if isinstance(spread[0].value, str) else _number(spread[0].text, None, "")[1]


def _number(text: str, like: Scale | None, name: str) -> tuple[float, Scale]:
    """A number and its scale; with `like`, the number in that scale. Raises UnitError."""
    found = _QUANTITY.fullmatch(text.strip())
    if not found:
        raise UnitError(
            f'{name}="{shorten(text)}" is not a number; a number with its unit is wanted, e.g. 89 t'
        )
    unit, _, qualifier = found[2].strip().partition(" ")
    if unit not in SI or qualifier.strip() not in _QUALIFIERS:
        known = ", ".join(filter(None, SI))
        raise UnitError(f'{name}="{shorten(text)}": the unit "{unit}" is not known; known are {known}')
    number, scale = float(found[1]), Scale(unit, qualifier.strip())
    if like is not None:
        if SI[unit][0] != SI[like.unit][0]:
            wanted = f"a unit like {like.unit}" if like.unit else "a number without unit"
            raise UnitError(f'{name}="{shorten(text)}" does not fit the other numbers; {wanted} is wanted')
        if unit != like.unit:
            number *= SI[unit][1] / SI[like.unit][1]
    if not math.isfinite(number * SI[unit][1]):
        raise UnitError(f'{name}="{shorten(text)}" is not a finite number')
    return number, scale


def _values(text: str) -> tuple[Level, ...]:
    """The levels of a list; equal ones are there once."""
    texts = [part.strip() for part in text.split(",")]
    if not all(texts):
        raise UnitError('the list is empty or has an empty place; write e.g. list="8 t, 12 t"')
    if len(texts) > MOST_VALUES:
        raise UnitError(f"the list has more than {MOST_VALUES} values; use a <range> with a step")
    try:
        read = [_number(part, None, "list") for part in texts]
        alike = len({(SI[scale.unit][0], scale.qualifier) for _, scale in read}) == 1
    except UnitError:
        alike = False
    if not alike:  # words, such as FL230 or landing
        return tuple(Level(part, part) for part in dict.fromkeys(texts))
    levels = [Level(part, n * SI[scale.unit][1]) for part, (n, scale) in zip(texts, read, strict=True)]
    return tuple({level.value: level for level in reversed(levels)}.values())[::-1]


def _range(numbers: dict[str, float], scale: Scale, *, sampled: bool) -> Steps | Distribution:
    low, high, step = numbers["from"], numbers["to"], numbers.get("step")
    if step is None:
        if not low < high:
            raise UnitError("the range is empty; from must be less than to")
        return Distribution(scale, "uniform", (), low, high - low)
    if sampled and step == 0:
        raise UnitError("the step is zero; leave it out for a continuous range")
    if step == 0 or (high - low) / step < 0:
        raise UnitError("the range is empty; the step must lead from one end to the other")
    return Steps(scale, low, step, math.floor((high - low) / step + 1e-9) + 1)


def _normal(numbers: dict[str, float], scale: Scale) -> Distribution:
    mean, sigma = numbers["mean"], numbers["standard-deviation"]
    low, high = numbers.get("from", -math.inf), numbers.get("to", math.inf)
    if sigma <= 0:
        raise UnitError("the standard deviation must be more than zero")
    if not low < high:
        raise UnitError("the normal distribution is cut to nothing; from must be less than to")
    if math.isinf(low) and math.isinf(high):
        return Distribution(scale, "norm", (), mean, sigma)
    return Distribution(scale, "truncnorm", ((low - mean) / sigma, (high - mean) / sigma), mean, sigma)
