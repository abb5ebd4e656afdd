"""Every number of the aircraft has a source, or an estimate with its reason, where a reader finds it.

The rule. A number of an XML file below aircraft/, engine/ and systems/ is accounted for when one of these says where it
comes from: a comment on its line; the last comment before it, or before an element around it, among its siblings; or
the comment at the head of the file, if it names the number itself, its element or its property. "Says where it comes
from" means a fact ([facts NAME]), a document, `estimate`, a derivation with numbers in it, or a file of ours that
computes it. Small whole numbers, one half and conversions of units are their own source. Initial states (a <property>
of value 0 or 1) are no data.
"""

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from lxml import etree

SOURCE = re.compile(
    r"\[facts|\[paper|estimate|generated|source|EASA|TCDS|CS[- ]?25|MIL-|AIAA|NACA|NASA|ISO |WGS|McCormick|Hamilton|"
    r"Burckhardt|closed form|by definition|exact|fitted|computed|\.xml|harness\.design|thin aerofoil|"
    r"\d\s*[*/^+]\s*\(?\d|=\s*-?\d|deg/s|1/s",
    re.IGNORECASE,
)
NUMBER = re.compile(r"(?<![\w./-])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w/])")
PLAIN = {0.0, 1.0, 2.0, 3.0, 4.0, 0.5, 10.0, 100.0, 1000.0, 90.0}
CONVERSIONS = (
    *(
        0.3048,
        0.0254,
        0.45359237,
        4.4482216,
        14.593903,
        1.3558179,
        1852 / 3600,
        47.880259,
        6894.757,
        1.8,
        0.7456999,
    ),
    *(32.174049, 9.80665, 287.05287, 288.15, 101325.0, 518.67, 2116.2166, 1716.56, 1.4, 3.5, 0.2),
    *(math.pi, 2 * math.pi, math.pi / 2, math.pi / 180, math.pi / 30, 60.0, 12.0, 3600.0, 3.2808399),
)
"""Units, and the standard atmosphere (ISO 2533)."""
TEXTS = (
    "name",
    "description",
    "author",
    "feed",
    "brake_group",
    "type",
    "sense",
    "numblades",
    "retractable",
    "castered",
)
"""Elements whose content is a name, a count or a switch."""


class Offender(NamedTuple):
    file: str
    line: int
    number: str
    where: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.number} in <{self.where}> has neither source nor estimate"


def aircraft_files(repository: Path) -> list[Path]:
    folders = ("aircraft", "engine", "systems")
    found = [path for folder in folders for path in sorted((repository / folder).rglob("*.xml"))]
    return [path for path in found if path.name not in ("flight-manual.xml", "loading.xml")]


def plain(text: str) -> bool:
    value = abs(float(text))
    return value in PLAIN or any(
        math.isclose(value, c, rel_tol=2e-5) or math.isclose(value * c, 1.0, rel_tol=2e-5)
        for c in CONVERSIONS
    )


def comments_for(element: etree._Element, head: etree._Element | None) -> Iterator[str]:
    """Comments that speak of an element: beside it, before it, before those around it."""
    here: etree._Element | None = element
    while here is not None:
        for after in here.itersiblings():
            if isinstance(after, etree._Comment) and after.sourceline == last_line(here):
                yield after.text or ""
            break
        before = here.getprevious()
        while before is not None:
            if isinstance(before, etree._Comment):
                if before is not head:
                    yield before.text or ""
                break
            before = before.getprevious()
        for child in here.iterchildren(etree.Comment):
            if child is not head and child.sourceline <= element.sourceline:
                yield child.text or ""
        here = here.getparent()


def last_line(element: etree._Element) -> int:
    text = etree.tostring(element, with_tail=False, encoding="unicode")
    return int(element.sourceline) + text.count("\n")


def head_of(tree: etree._Element) -> etree._Element | None:
    before = tree.getprevious()
    while before is not None and not isinstance(before, etree._Comment):
        before = before.getprevious()
    return before


def named_in(head: str, element: etree._Element, number: str) -> bool:
    """Whether the head of the file speaks of this number: itself, its element, or the property it belongs to."""
    shown = {f"{float(number):g}", number.strip("+").lstrip("-"), f"{abs(float(number)):g}"}
    if any(re.search(rf"(?<![\w.]){re.escape(form)}(?![\w.]*\d)", head) for form in shown):
        return True
    tag = "(location|position)" if element.tag in ("x", "y", "z") else element.tag.split("_")[0][:6]
    if re.search(rf"(?<![A-Za-z]){tag}", head, re.IGNORECASE):
        return True
    here: etree._Element | None = element
    while here is not None:
        name = here.get("name") or ((here.text or "").strip() if here.tag == "property" else "")
        last = name.split("/")[-1].split("[")[0]
        if len(last) > 5 and re.search(rf"(?<![\w-]){re.escape(last)}(?![\w-])", head):
            return True
        here = here.getparent()
    return False


def numbers_of(element: etree._Element) -> list[str]:
    texts = [element.get("value", "")] if element.tag in ("property", "test", "default") else []
    if element.tag not in TEXTS and element.tag not in ("property", "independentVar", "output", "input"):
        texts.append(element.text or "")
    return [number for text in texts for number in NUMBER.findall(text)]


def offenders(path: Path, repository: Path) -> list[Offender]:
    tree = etree.parse(str(path)).getroot()
    if tree.tag == "initialize":  # where a script begins is no property of the aircraft
        return []
    head = head_of(tree)
    about = re.sub(r"(?<=\d)[, ](?=\d{3}\b)", "", (head.text or "") if head is not None else "")  # 15,000
    found = []
    for element in tree.iter(etree.Element):
        wanted = [number for number in numbers_of(element) if not plain(number)]
        if not wanted or any(SOURCE.search(comment) for comment in comments_for(element, head)):
            continue
        lost = [
            number for number in wanted if not (SOURCE.search(about) and named_in(about, element, number))
        ]
        if lost:
            place = path.relative_to(repository).as_posix()
            found.append(Offender(place, int(element.sourceline), lost[0], element.tag))
    return found


def test_every_number_has_a_source_or_an_estimate(repository: Path) -> None:
    lost = [offender for path in aircraft_files(repository) for offender in offenders(path, repository)]
    assert not lost, f"{len(lost)} numbers:\n" + "\n".join(map(str, lost))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<system><property value='7.3'> a/b </property></system>", 1),
        ("<system><!-- estimate: as others --><property value='7.3'> a/b </property></system>", 0),
        ("<system><property value='7.3'> a/b </property> <!-- [facts span] --></system>", 0),
        ("<!-- Source: a book. a/b is 7.3 --><system><property value='7.3'> a/b </property></system>", 0),
        ("<!-- Source: a book. --><system><property value='7.3'> a/b </property></system>", 1),
        ("<system><!-- how fast it turns --><property value='7.3'> a/b </property></system>", 1),
        ("<system><function><product><value>0.3048</value><value>2</value></product></function></system>", 0),
        ("<system><table><tableData>0 1\n7 8</tableData></table></system>", 1),
    ],
)
def test_the_rule_itself(tmp_path: Path, text: str, expected: int) -> None:
    path = tmp_path / "x.xml"
    path.write_text(text, encoding="utf-8")
    assert len(offenders(path, tmp_path)) == expected
