"""Reading XML we did not write: hardened, validated, and every fault told with file and line.

No entities, no document type, no network, no file but the one named, at most 1 MB. The shape of a document
is its XML schema's business: unknown words are found by a walk over the schema's own words (the validator of
libxml2 stops at the first), the rest by the validator, whose findings are retold in the house's words. Values
are parsed by the readers through `Source`, which collects faults so that one reading reports them all.
"""

import re
from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol, TypeVar, cast

from lxml import etree

from harness.errors import InputError, InputErrors, did_you_mean, shorten
from harness.units import UnitError, parse
from harness.xml_findings import retold

Element = etree._Element  # noqa: SLF001 -- lxml has no public name for it
Value = TypeVar("Value")

LARGEST_FILE = 1_000_000  # bytes; a mission is a few kilobytes
MOST_ATTRIBUTES = 50  # of one element; libxml2 takes time with the square of them
MOST_ELEMENTS = 2_000  # the validator takes time with the square of them
MOST_FAULTS = 100  # enough to see that this file is not what it should be
SCHEMAS = Path(__file__).parent / "schema"
NAN = float("nan")

_XS = "{http://www.w3.org/2001/XMLSchema}"


class Finding(Protocol):
    """What libxml2's validator says of one thing it found."""

    message: str
    path: str | None


class Words:
    """The words of a schema: per element tag the attributes and the children it may have."""

    def __init__(self, declarations: Iterable[Element]) -> None:
        self.attributes: dict[str, set[str]] = {}
        self.children: dict[str, set[str]] = {}
        self.open: set[str] = set()  # tags that take any attribute
        for element in declarations:
            tag = element.get("name", "")
            self.attributes[tag] = {found.get("name", "") for found in element.iter(f"{_XS}attribute")}
            self.children[tag] = {found.get("ref", "") for found in element.iterdescendants(f"{_XS}element")}
            if element.find(f".//{_XS}anyAttribute") is not None:
                self.open.add(tag)


class Source:
    """One XML document: its tree, where its values come from, and the faults found so far."""

    def __init__(self, path: Path, schema: str, *roots: str, text: str | None = None) -> None:
        """Read and parse `path`, a document of `schema` with one of these roots. Raises InputError.

        With `text`, that is the document, and `path` only names it in messages.
        """
        self.path = path
        self.schema, self.words = _schema(schema)
        self.root = read_document(path, text=text)
        self.faults: list[InputError] = []
        self.origins: dict[tuple[Element, str], tuple[str, int | None]] = {}
        if self.root.tag not in roots:
            wanted = " or ".join(f"<{tag}>" for tag in roots)
            self.fault(f"the document is a <{shorten(self.root.tag)}>, not a {wanted}", self.root)
            self.finish()

    def validate(self) -> None:
        """Check the shape against the schema. Raises InputErrors: values mean nothing in a wrong shape."""
        self._check_words(self.root)
        if not self.faults and not self.schema.validate(self.root):
            for finding in cast(Iterable[Finding], self.schema.error_log):
                self._retell(finding)
        self.finish()

    def finish(self) -> None:
        """Raise what was found, if anything."""
        if self.faults:
            raise InputErrors(self.faults)

    def fault(self, what: str, element: Element, attribute: str = "", remedy: str = "") -> None:
        """Note a fault of an element or of one of its attributes."""
        file, line = self.place(element, attribute)
        self.faults.append(InputError(what, file=file, line=line, remedy=remedy))
        if len(self.faults) >= MOST_FAULTS:
            self.finish()

    def place(self, element: Element, attribute: str = "") -> tuple[str, int | None]:
        """File and line of a value; an overridden one comes from its override."""
        here: Element | None = element
        while here is not None:
            for key in ((here, attribute), (here, "")):
                if key in self.origins:
                    return self.origins[key]
            line = cast(int | None, here.sourceline)
            if line is not None:
                return str(self.path), line
            here = here.getparent()
        return str(self.path), 1

    def read(
        self, element: Element, attribute: str, parser: Callable[[str], Value], otherwise: Value
    ) -> Value:
        """The parsed value of an attribute; `otherwise` if absent, or wrong, which is noted as a fault."""
        text = element.get(attribute)
        if text is None:
            return otherwise
        try:
            return parser(text)
        except UnitError as error:
            what, _, remedy = str(error).partition("; ")
            self.fault(f"{attribute}={what}", element, attribute, remedy)
            return otherwise

    def quantity(self, element: Element, attribute: str, kind: str, otherwise: float = NAN) -> float:
        """An attribute that is a quantity of `kind` (see units.KINDS), in SI."""
        return self.read(element, attribute, lambda text: parse(text, kind), otherwise)

    def needed(self, element: Element, attribute: str, example: str) -> bool:
        """Whether the attribute is there; a fault is noted if not."""
        present = element.get(attribute) is not None
        if not present:
            self.fault(
                f'<{element.tag}> lacks its "{attribute}"', element, remedy=f'add {attribute}="{example}"'
            )
        return present

    def one(self, parent: Element, tag: str, *, needed: bool = True) -> Element | None:
        """The only child of that tag; missing (if needed) and doubled ones are faults."""
        found = list(children(parent, tag))
        if not found and needed:
            self.fault(f"<{parent.tag}> has no <{tag}>", parent, remedy=f"add one <{tag} .../>")
        for extra in found[1:]:
            self._doubled(f"<{tag}>", found[0], extra, "")
        return found[0] if found else None

    def distinct(self, elements: Iterable[Element], attribute: str) -> None:
        """Elements that share the value of the attribute they are known by are faults."""
        seen: dict[str, Element] = {}
        for element in elements:
            value = element.get(attribute)
            if value is not None and (first := seen.setdefault(value, element)) is not element:
                self._doubled(f'<{element.tag} {attribute}="{shorten(value)}">', first, element, attribute)

    def _doubled(self, what: str, first: Element, extra: Element, attribute: str) -> None:
        line = self.place(first, attribute)[1]
        self.fault(f"{what} is here twice; the first is in line {line}", extra, attribute, "keep one of them")

    def _check_words(self, element: Element) -> None:
        known = self.words.attributes[element.tag]
        for name in element.attrib:
            if name not in known and element.tag not in self.words.open:
                remedy = did_you_mean(str(name), known)
                self.fault(f'<{element.tag}> has no attribute "{shorten(name)}"', element, str(name), remedy)
        for child in children(element):
            if child.tag in self.words.children[element.tag]:
                self._check_words(child)
                continue
            remedy = did_you_mean(child.tag, self.words.children[element.tag], "<{}>")
            what = f"<{shorten(child.tag)}> does not belong into <{element.tag}>"
            self.fault(what, child, remedy=remedy or f"<{element.tag}> has no elements inside")

    def _retell(self, finding: Finding) -> None:
        found = self.root.getroottree().xpath(finding.path) if finding.path else []
        element = cast(Element, found[0]) if isinstance(found, list) and found else self.root
        told = retold(finding.message)
        if told is not None:
            what, remedy, attribute = told
            self.fault(what, element, attribute, remedy)


def children(parent: Element, tag: str = "*") -> Iterable[Element]:
    """Child elements, without comments."""
    return parent.iterchildren(tag)


def read_bytes(path: Path, largest: int = LARGEST_FILE) -> bytes:
    """The content of a regular file of at most `largest` bytes. Raises InputError."""
    try:
        if path.is_dir():
            raise InputError("is a folder, not a file", file=path)
        if not path.exists():
            siblings = [other.name for other in path.parent.glob("*.xml")] if path.parent.is_dir() else []
            raise InputError("there is no such file", file=path, remedy=did_you_mean(path.name, siblings))
        if not path.is_file():  # a pipe or a device could block for ever
            raise InputError("is not a regular file", file=path)
        with path.open("rb") as stream:
            data = stream.read(largest + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"cannot be read: {reason}", file=shorten(path, 200)) from None
    if not data:
        raise InputError("is empty", file=path, line=1, remedy="an XML document is wanted")
    if len(data) > largest:
        remedy = "a mission is a few kilobytes" if largest == LARGEST_FILE else ""
        raise InputError(f"is larger than {largest:,} bytes", file=path, line=1, remedy=remedy)
    return data


def read_document(
    path: Path,
    *,
    text: str | None = None,
    largest: int = LARGEST_FILE,
    most_elements: int = MOST_ELEMENTS,
    entities: bool = False,
) -> Element:
    """The root of a document of at most these sizes; of `text` if given, of the file otherwise. Raises InputError.

    With `entities` it may have a document type, whose entities are put in unless they are in other files.
    """
    try:
        document = read_bytes(path, largest) if text is None else text.encode()
        parser = etree.XMLParser(
            resolve_entities=cast(bool, "internal") if entities else False,
            no_network=True,
            load_dtd=False,
            dtd_validation=False,
            huge_tree=largest > LARGEST_FILE
            and b"<!ENTITY" not in document,  # it allows entities of any size
            remove_pis=True,
        )
        root = etree.fromstring(document, parser)
    except etree.XMLSyntaxError as error:
        # A column is "line 3, column 7" at the end of the message: the line is told before it.
        what = re.sub(r", line \d+, column (\d+)$", r", column \1", str(error.msg))
        line = max(error.lineno or 1, 1)
        remedy = 'each <tag> ends with its </tag> or />, each attribute reads name="value"; no < or & inside'
        if "ntity" in what:
            remedy = (
                "an entity is not known or too large"
                if entities
                else "no entities are allowed; delete their <!DOCTYPE ...>"
            )
        raise InputError(
            f"is not well-formed XML: {shorten(what, 200)}", file=path, line=line, remedy=remedy
        ) from None
    except (ValueError, LookupError, etree.LxmlError) as error:
        raise InputError(f"is not readable XML: {shorten(error, 200)}", file=path, line=1) from None
    if not entities and cast(Any, root.getroottree().docinfo).doctype:
        raise InputError(
            "a document type (<!DOCTYPE ...>) is not allowed: it can pull in entities and other files",
            file=path,
            line=1,
            remedy="delete it; the files of harness need none",
        )
    crowded = next((element for element in root.iter() if len(element.attrib) > MOST_ATTRIBUTES), None)
    if crowded is not None:
        raise InputError(
            f"an element has more than {MOST_ATTRIBUTES} attributes", file=path, line=line_of(crowded)
        )
    if sum(1 for _ in root.iter()) > most_elements:
        raise InputError(f"has more than {most_elements:,} elements", file=path, line=1)
    return root


def line_of(element: Element) -> int:
    """The line of an element in its file."""
    return cast(int | None, element.sourceline) or 1


def write_document(root: Element, path: Path) -> None:
    """Write a document. Raises OSError."""
    etree.ElementTree(root).write(str(path), encoding="utf-8", xml_declaration=True)


@lru_cache
def _schema(name: str) -> tuple[etree.XMLSchema, Words]:
    document = etree.parse(str(SCHEMAS / name))
    root = document.getroot()
    included = [
        str(SCHEMAS / found.get("schemaLocation", "")) for found in root.iterchildren(f"{_XS}include")
    ]
    roots = [root, *(etree.parse(file).getroot() for file in included)]
    return etree.XMLSchema(document), Words(
        tag for part in roots for tag in part.iterchildren(f"{_XS}element")
    )
