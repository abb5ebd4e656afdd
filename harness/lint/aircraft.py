"""Finds in an aircraft's files what JSBSim would abort on, or silently fly with.

Looked at are: files that are missing or outside the folders of the aircraft; elements JSBSim does not know; properties
that are read but that neither JSBSim nor the aircraft makes; tables that do not rise; tanks fuller than they are large;
masses and inertias that no body has; inputs and outputs, which open sockets and write files.
"""

import itertools
import re
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import cast

from harness.errors import InputError, InputErrors, did_you_mean, shorten
from harness.lint.words import COMPONENTS, KNOWN, OPERATIONS, OWN_PROPERTIES, SECTIONS
from harness.xml_source import Element, children, read_document

NAME = re.compile(r"-?[A-Za-z_][\w.+-]*(?:\[\d+\])?(?:/[\w.+-]+(?:\[\d+\])?)+")
INDEX = re.compile(r"\[\d+\]")
READERS = ("property", "p", "independentVar", "input", "min", "max", "test", "condition")
COMPOUND = OPERATIONS - {"table", "t", "switch", "min", "max"}
"""Operations that hold operations only; <min> and <max> are limits of a <clipto> as well."""
FORCE_PARTS = ("magnitude", "x", "y", "z", "location-x-in", "location-y-in", "location-z-in")
MOST_ELEMENTS = 20_000  # in one file
KILOGRAMS = {"KG": 1.0, "LBS": 0.45359237}
INERTIAS = ("ixx", "iyy", "izz")

File = tuple[Path, Element]


def check(root: Path, aircraft: str) -> None:
    """Raise InputErrors with file, line and remedy for every fault of an aircraft; remembered while its files stay."""
    main = root / "aircraft" / aircraft / f"{aircraft}.xml"
    if not re.fullmatch(r"[\w-]+", aircraft) or not main.is_file():
        known = [
            path.parent.name for path in (root / "aircraft").glob("*/*.xml") if path.stem == path.parent.name
        ]
        raise InputError(f'there is no aircraft "{shorten(aircraft)}"', remedy=did_you_mean(aircraft, known))
    folders = (root / "aircraft" / aircraft, root / "engine", root / "systems")
    stamps = tuple(
        (str(path), path.stat().st_mtime_ns, path.stat().st_size)
        for folder in folders
        for path in sorted(folder.rglob("*.xml"))
    )
    _check(root, aircraft, stamps)


@lru_cache(maxsize=8)
def _check(root: Path, aircraft: str, _stamps: tuple[tuple[str, int, int], ...]) -> None:
    files, faults = _files(root, aircraft)
    if faults:  # a missing file explains everything else that is not found
        raise InputErrors(faults)
    told = set()
    known = OWN_PROPERTIES | {name for _, tree in files for name in _made(tree)}
    for path, tree in files:
        for element, what, remedy in itertools.chain(
            _strange(tree), _unknown(tree, known), _tables(tree), _tanks(tree), _masses(tree)
        ):
            if what not in told:  # once, at its first place
                told.add(what)
                faults.append(InputError(what, file=path, line=_line(element), remedy=remedy))
    if faults:
        raise InputErrors(faults)


def _line(element: Element) -> int:
    return cast(int | None, element.sourceline) or 1


def _files(root: Path, aircraft: str) -> tuple[list[File], list[InputError]]:
    """The files an aircraft is made of, parsed, and what is wrong with the names of those that cannot be found."""
    home = root / "aircraft" / aircraft
    found: dict[Path, Element] = {}
    faults: list[InputError] = []
    waiting = [home / f"{aircraft}.xml"]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found[path] = tree = read_document(path, most_elements=MOST_ELEMENTS)
        for element in tree.iter("*"):
            name = element.get("file")
            if name is None:
                continue
            places = _places(root, home, element.tag)
            candidates = [place / (name if name.endswith(".xml") else f"{name}.xml") for place in places]
            if Path(name).is_absolute() or ".." in Path(name).parts or "\\" in name:
                what = f'the file "{shorten(name)}" leaves the folders of the aircraft'
                faults.append(
                    InputError(
                        what, file=path, line=_line(element), remedy="give a file name, without a folder"
                    )
                )
            elif existing := next((place for place in candidates if place.is_file()), None):
                waiting.append(existing)
            else:
                near = [other.stem for place in places for other in place.glob("*.xml")]
                what = f'there is no file "{shorten(name)}" for <{element.tag}>'
                remedy = did_you_mean(Path(name).stem, near) or f"it would be {candidates[0]}"
                faults.append(InputError(what, file=path, line=_line(element), remedy=remedy))
    return list(found.items()), faults


def _places(root: Path, home: Path, tag: str) -> list[Path]:
    """Where JSBSim looks for the file of an element."""
    if tag in ("engine", "thruster"):
        return [home / "Engines", home, root / "engine"]
    return [home / "Systems", home, root / "systems"] if tag == "system" else [home]


def _made(tree: Element) -> Iterator[str]:
    """The properties a file makes: declarations, functions, components, their outputs; without indices."""
    for element in tree.iter("property", "output"):
        text = INDEX.sub("", (element.text or "").strip())
        if element.tag == "property":
            if element.get("value") is not None:
                yield text
        elif (parent := element.getparent()) is not None and parent.tag in COMPONENTS:
            yield text.lstrip("-")
    for channel in tree.iter("channel"):
        for component in children(channel):
            plain = INDEX.sub("", " ".join((component.get("name") or "").split()))
            yield plain if "/" in plain else f"fcs/{plain.lower().replace(' ', '-')}"
    for element in tree.iter("function", "table", "force", "moment"):
        name = INDEX.sub("", " ".join((element.get("name") or "").split()))
        if element.tag in ("function", "table"):
            yield name
        else:
            yield from (f"external_reactions/{name}/{part}" for part in FORCE_PARTS)


def _read(tree: Element) -> Iterator[tuple[Element, str]]:
    """The properties a file reads, as written."""
    for element in tree.iter(*READERS):
        if element.tag != "property" or element.get("value") is None:
            for name in NAME.findall(element.text or ""):
                yield element, name
    for element in tree.iter("test", "default", "channel"):
        for attribute in ("value", "execute"):
            text = element.get(attribute, "").strip()
            if NAME.fullmatch(text):
                yield element, text


def _unknown(tree: Element, known: frozenset[str] | set[str]) -> Iterator[tuple[Element, str, str]]:
    for element, written in _read(tree):
        name = written.lstrip("-")
        if INDEX.sub("", name) not in known:
            remedy = did_you_mean(INDEX.sub("", name), known) or "declare it with <property value=...>"
            yield element, f'nothing makes the property "{shorten(name)}"', remedy


def _strange(tree: Element) -> Iterator[tuple[Element, str, str]]:
    """Elements JSBSim does not know, or not there."""
    for element in tree.iter("*"):
        parent = element.getparent()
        inside = "" if parent is None else parent.tag
        if inside == "fdm_config" and element.tag in ("input", "output"):
            yield element, f"<{element.tag}> of an aircraft opens sockets or writes files", "delete it"
        elif inside == "fdm_config" and element.tag not in SECTIONS:
            yield (
                element,
                f"<{shorten(element.tag)}> is no part of an aircraft",
                did_you_mean(element.tag, SECTIONS, "<{}>"),
            )
        elif inside == "channel" and element.tag not in COMPONENTS:
            yield (
                element,
                f"<{shorten(element.tag)}> is no component",
                did_you_mean(element.tag, COMPONENTS, "<{}>"),
            )
        elif inside in COMPOUND and element.tag not in OPERATIONS:
            yield (
                element,
                f"<{shorten(element.tag)}> is no operation",
                did_you_mean(element.tag, OPERATIONS, "<{}>"),
            )
        elif element.tag not in KNOWN and "documentation" not in (inside, element.tag):
            yield (
                element,
                f"JSBSim knows no <{shorten(element.tag)}>",
                did_you_mean(element.tag, KNOWN, "<{}>"),
            )


def _tables(tree: Element) -> Iterator[tuple[Element, str, str]]:
    """Tables whose arguments do not rise, or whose rows differ in length."""
    for data in tree.iter("tableData"):
        first = _line(data)
        rows: list[list[float]] = []
        for offset, line in enumerate((data.text or "").split("\n")):
            if not line.strip():
                continue
            place = f"line {first + offset}"
            try:
                row = [float(word) for word in line.split()]
            except ValueError:
                yield (
                    data,
                    f'{place}: "{shorten(line)}" is not a row of numbers',
                    "numbers, separated by blanks",
                )
                rows = []
                break
            if len(rows) > 1 and len(row) != len(rows[-1]):
                yield (
                    data,
                    f"{place}: {len(row)} numbers, where the row before has {len(rows[-1])}",
                    "one for each column",
                )
            rows.append(row)
        two = len(rows) > 1 and len(rows[0]) == len(rows[1]) - 1
        if two and not _rising(rows[0]):
            yield data, "the columns of the table do not rise", "order them"
        body = rows[1:] if two else rows
        if not _rising([row[0] for row in body]):
            wrong = next(b[0] for a, b in itertools.pairwise(body) if not a[0] < b[0])
            yield (
                data,
                f"the rows of the table do not rise at {wrong:g}",
                "order them",
            )


def _rising(values: list[float]) -> bool:
    return all(a < b for a, b in itertools.pairwise(values))


def _tanks(tree: Element) -> Iterator[tuple[Element, str, str]]:
    for tank in tree.iter("tank"):
        sizes = {}
        for tag in ("capacity", "contents"):
            found = tank.find(tag)
            if found is not None:
                sizes[tag] = _number(found) * KILOGRAMS.get(found.get("unit", "LBS"), float("nan"))
        if not sizes.get("capacity", 0.0) > 0:
            yield tank, "the tank has no capacity above zero", 'give <capacity unit="KG">'
        elif not 0.0 <= sizes.get("contents", 0.0) <= sizes["capacity"]:
            yield (
                tank,
                f"{sizes['contents']:.1f} kg do not fit into a tank of {sizes['capacity']:.1f} kg",
                "lower its <contents>",
            )


def _masses(tree: Element) -> Iterator[tuple[Element, str, str]]:
    for balance in tree.iter("mass_balance"):
        values = {tag: balance.find(tag) for tag in ("emptywt", *INERTIAS)}
        numbers = {tag: _number(found) for tag, found in values.items() if found is not None}
        for tag, number in numbers.items():
            if not 0.0 < number < float("inf"):
                found = values[tag]
                assert found is not None
                yield found, f"<{tag}> is {number:g}: no body has that", "a number above zero"
        if all(tag in numbers for tag in INERTIAS):
            largest = max(numbers[tag] for tag in INERTIAS)
            if 2 * largest > sum(numbers[tag] for tag in INERTIAS) * (1 + 1e-9):
                yield (
                    balance,
                    "one moment of inertia is more than the two others together",
                    "no rigid body has that",
                )
        for weight in balance.iter("weight"):
            if not 0.0 <= _number(weight) < float("inf"):
                yield weight, f"a point mass of {_number(weight):g}", "zero or more"


def _number(element: Element) -> float:
    try:
        return float(element.text or "")
    except ValueError:
        return float("nan")
