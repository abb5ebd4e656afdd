"""Changing values of a mission before it is read: `--set PATH=VALUE`, and the <set> lines of a variant.

A path walks down from <mission>: `loading/take-off-mass`, `route/waypoint[WP3]/speed`,
`phase[T/O.run]/checklist[T/O.rotation]/item[rotation speed]/at-least`. The last word is an attribute (or
`description`); `[...]` picks an element by its name, or by the phase a checklist leads to.
"""

import re
from typing import NamedTuple

from lxml import etree

from harness.errors import InputError, did_you_mean, shorten
from harness.xml_source import Element, Source, children

_STEP = re.compile(r"([^/\[\]]+)(?:\[((?:[^\[\]]|\[\d+\])*)\])?(/|$)")  # a property's name may have an index
_OPTIONAL = {"environment", "speed", "gain", "property", "configuration", "description"}
"""Elements that are made when a path names one that is not there: their attributes mean something alone."""


class Override(NamedTuple):
    """A value to put at a path, and where it was asked for."""

    path: str
    value: str
    file: str
    line: int | None = None


def from_option(text: str) -> Override:
    """The override in the text after `--set`. Raises InputError."""
    found = re.fullmatch(r"((?:[^=\[\]]|\[(?:[^\[\]]|\[\d+\])*\])+)=(.*)", text, re.DOTALL)
    file = f"--set {shorten(text)}"
    if not found:
        remedy = "write --set PATH=VALUE, e.g. --set 'loading/take-off-mass=110 t'"
        raise InputError("is not PATH=VALUE", file=file, remedy=remedy)
    return Override(found[1].strip(), found[2].strip(), file)


def apply(source: Source, override: Override) -> None:
    """Put the value into the tree and remember where it came from.

    Raises InputError for a path that leads nowhere.
    """
    steps = _STEP.findall(override.path)
    if (
        not steps
        or "".join(f"{tag}[{key}]{end}" if key else tag + end for tag, key, end in steps) != override.path
    ):
        raise _wrong(
            override, f'"{shorten(override.path)}" is not a path', "write e.g. route/waypoint[WP3]/speed"
        )
    element = source.root
    last, key, _ = steps[-1]
    for tag, name, _ in steps[:-1]:
        element = _down(source, element, tag, name, override)
    try:
        if last in source.words.children[element.tag] and not source.words.attributes[last]:
            element = _down(source, element, last, key, override)
            element.text = override.value
            last = ""
        else:
            element.set(last, override.value)
    except ValueError:  # what XML cannot hold: control characters, a name with blanks
        raise _wrong(override, f'"{shorten(override.path)}" cannot take that value', "") from None
    source.origins[element, last] = (override.file, override.line)


def path_of(element: Element) -> str:
    """The path of an element, as an override would write it; "" for the mission itself."""
    steps: list[str] = []
    here: Element | None = element
    while here is not None and (parent := here.getparent()) is not None:
        name = here.get("to" if here.tag == "checklist" else "name") if here.tag != "aircraft" else None
        steps.append(here.tag if name is None else f"{here.tag}[{name}]")
        here = parent
    return "/".join(reversed(steps))


def _down(source: Source, parent: Element, tag: str, name: str, override: Override) -> Element:
    known = source.words.children[parent.tag]
    if tag not in known:
        raise _wrong(override, f"<{parent.tag}> has no <{shorten(tag)}>", did_you_mean(tag, known))
    key = "to" if tag == "checklist" else "name"
    found = list(children(parent, tag))
    named = [element for element in found if element.get(key) == name] if name else found
    if len(named) == 1:
        return named[0]
    names = [element.get(key, "") for element in found]
    if len(named) > 1:
        raise _wrong(override, f"there are {len(named)} <{tag}>", f"say which: {tag}[{names[0]}]")
    if tag not in _OPTIONAL:
        what = f'no <{tag}> is called "{shorten(name)}"' if found and name else f"the mission has no <{tag}>"
        remedy = did_you_mean(name, names) or f"write the <{tag}> into a mission file, and change it there"
        raise _wrong(override, what, remedy)
    made = etree.SubElement(parent, tag, {"name": name} if name else {})
    source.origins[made, ""] = (override.file, override.line)
    return made


def _wrong(override: Override, what: str, remedy: str) -> InputError:
    return InputError(what, file=override.file, line=override.line, remedy=remedy)
