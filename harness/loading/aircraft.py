"""Where things are put on board of one type of aircraft, read from its files.

What the empty aircraft and the tanks weigh, and where, is what JSBSim flies: mass-balance.xml and propulsion.xml, as
the aircraft's main file names them. Hold, seats and the fuel-management table are in loading.xml.
"""

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from harness import resources
from harness.errors import InputError
from harness.loading.balance import Item
from harness.loading.tanks import filled
from harness.units import UnitError, parse
from harness.xml_source import NAN, Element, Source, children

SCHEMA = "loading.xsd"
BULK = "payload"
"""The first point mass of an aircraft: a payload of which only the mass is given."""


class Tank(NamedTuple):
    """A tank: what it holds at most, kg, and where."""

    name: str
    capacity: float
    x: float
    y: float
    z: float


class Hold(NamedTuple):
    """The cargo hold, m: its front end, its rear end where the ramp begins, the ramp's end, and the floor."""

    front: float
    rear: float
    ramp_end: float
    floor: float


class Pallet(NamedTuple):
    """What every pallet is like: a cylinder along x, its centre of gravity `height` above the floor, m; kg."""

    length: float
    radius: float
    height: float
    heaviest: float


class Stowage(NamedTuple):
    """What may be where in one type of aircraft. `seats` are in the order in which they are filled."""

    empty: Item
    bulk: Item
    hold: Hold
    pallet: Pallet
    seats: Mapping[str, Item]
    tanks: tuple[Tank, ...]
    fill_order: tuple[tuple[int, ...], ...]

    def fuel(self, mass: float) -> list[Item]:
        """What is in each tank, with `mass` kg on board. Raises InputError when that does not fit."""
        contents = filled([tank.capacity for tank in self.tanks], self.fill_order, mass)
        return [
            Item(tank.name, held, tank.x, tank.y, tank.z)
            for held, tank in zip(contents, self.tanks, strict=True)
        ]

    def on_pallet(self, name: str, mass: float, position: float) -> Item:
        """A pallet of `mass` kg with its centre of gravity `position` m aft of the nose."""
        height = self.hold.floor + self.pallet.height
        return Item(name, mass, position, 0.0, height, self.pallet.radius, self.pallet.length)


@lru_cache
def read_stowage(aircraft: str | Path) -> Stowage:
    """The stowage of an aircraft given by name, or its main file as a Path. Raises InputErrors naming file and line."""
    main = aircraft if isinstance(aircraft, Path) else resources.aircraft()[aircraft]
    source = Source(main.with_name("loading.xml"), SCHEMA, "loading-data")
    source.validate()
    balance = _part(main, "mass_balance")
    bulk = _point_mass(balance)
    hold, pallet, seats, fuel = (source.one(source.root, tag) for tag in ("hold", "pallet", "seats", "fuel"))
    source.finish()
    assert hold is not None
    assert pallet is not None
    assert seats is not None
    assert fuel is not None
    tanks = _tanks(_part(main, "propulsion"))
    floor = source.quantity(hold, "floor", "length")
    front, rear, ramp_end = (source.quantity(hold, name, "length") for name in ("front", "rear", "ramp-end"))
    length, radius, height = (
        source.quantity(pallet, name, "length") for name in ("length", "radius", "height")
    )
    stowage = Stowage(
        Item("empty aircraft", _number(balance, "emptywt"), *_location(balance)),
        bulk,
        Hold(front, rear, ramp_end, floor),
        Pallet(length, radius, height, source.quantity(pallet, "heaviest", "mass")),
        _seats(source, seats, floor),
        tanks,
        tuple(_numbers(source, line, len(tanks)) for line in children(fuel, "fill")),
    )
    if sorted(number for line in stowage.fill_order for number in line) != list(range(len(tanks))):
        source.fault("each tank is to be filled once", fuel, remedy=f"there are tanks 0 to {len(tanks) - 1}")
    source.finish()
    return stowage


def _part(main: Path, tag: str) -> Element:
    """A part of the JSBSim aircraft, from its main file or the file that this names."""
    found = Source(main, SCHEMA, "fdm_config").root.find(tag)
    if found is None:
        raise InputError(f"has no <{tag}>", file=main)
    file = found.get("file")
    return found if file is None else Source(main.with_name(file), SCHEMA, tag).root


def _tanks(propulsion: Element) -> tuple[Tank, ...]:
    return tuple(
        Tank(tank.get("name", f"tank {number}"), _number(tank, "capacity"), *_location(tank))
        for number, tank in enumerate(children(propulsion, "tank"))
    )


def _point_mass(balance: Element) -> Item:
    first = balance.find("pointmass")
    if first is None:
        return Item(BULK, 0.0, *_location(balance))
    form = first.find("form")
    size = () if form is None else (_number(form, "radius"), _number(form, "length"))
    return Item(BULK, 0.0, *_location(first), *size)


def _location(parent: Element) -> tuple[float, float, float]:
    place = parent.find("location")
    if place is None:
        raise InputError(f"<{parent.tag}> has no <location>")
    unit = place.get("unit", "M").lower()
    x, y, z = (parse(f"{place.findtext(axis, '').strip()} {unit}", "length") for axis in "xyz")
    return x, y, z


def _number(parent: Element, tag: str) -> float:
    """A length or a mass of a JSBSim file, in SI."""
    found = parent.find(tag)
    if found is None:
        raise InputError(f"<{parent.tag}> has no <{tag}>")
    unit = found.get("unit", "").lower()
    return parse(f"{(found.text or '').strip()} {unit}", "length" if unit in ("m", "ft") else "mass")


def _seats(source: Source, seats: Element, floor: float) -> dict[str, Item]:
    mass = source.quantity(seats, "passenger", "mass")
    height = floor + source.quantity(seats, "height", "length")
    found = {}
    for row in children(seats, "row"):
        letters = row.get("names", "").split()
        across = source.read(row, "at", _lengths, [NAN] * len(letters))
        first, pitch = (source.quantity(row, name, "length") for name in ("first", "pitch"))
        if len(across) != len(letters):
            source.fault("every name needs its place across", row, "at")
            across = [NAN] * len(letters)
        for number in range(int(source.quantity(row, "count", "count", 0.0))):
            for letter, y in zip(letters, across, strict=True):
                name = f"{number + 1}{letter}"
                found[name] = Item(name, mass, first + number * pitch, y, height)
    return found


def _lengths(text: str) -> list[float]:
    return [parse(word.strip(), "length") for word in text.split(",")]


def _numbers(source: Source, line: Element, most: int) -> tuple[int, ...]:
    def numbers(text: str) -> tuple[int, ...]:
        words = text.split()
        if not all(word.isdecimal() and int(word) < most for word in words):
            raise UnitError(f'"{text}" are not tanks; known are 0 to {most - 1}')
        return tuple(int(word) for word in words)

    return source.read(line, "tanks", numbers, ())
