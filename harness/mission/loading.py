"""Reads the <loading> of a mission: masses, passengers in their seats, pallets at their positions."""

import re
from collections.abc import Mapping

from harness import resources
from harness.errors import did_you_mean
from harness.loading.aircraft import Stowage, read_stowage
from harness.loading.balance import Item
from harness.mission.model import Loading, Pallet
from harness.units import UnitError, parse
from harness.xml_source import NAN, Element, Source, children

_SEATS = re.compile(r"(\d{1,3})([A-Z])(?:-(\d{1,3})([A-Z]))?", re.ASCII)
_REMEDY = 'write <loading take-off-mass="100 t" fuel="12 t"/>, or payload= or passengers= or pallets for take-off-mass='


def read_loading(source: Source, element: Element | None, aircraft: str | None) -> Loading:
    """The loading in a <loading> element for an aircraft of that name, faults noted in `source`."""
    if element is None:
        return Loading(None, None, NAN)
    pallets = list(children(element, "pallet"))
    listed = [name for name in ("passengers", "seats") if element.get(name) is not None]
    ways = [name for name in ("take-off-mass", "payload") if element.get(name) is not None]
    if len(ways) + bool(listed or pallets) != 1:
        what = "<loading> needs the fuel and either the take-off mass or the payload"
        if ways and (listed or pallets):
            what = f"<loading> has a {ways[0]} and a list of what is on board: each gives the mass"
        source.fault(what, element, remedy=_REMEDY)
    if len(listed) > 1:
        source.fault("passengers= and seats= both say who is on board", element, "seats", "keep one of them")
    source.distinct(pallets, "name")
    fuel = source.quantity(element, "fuel", "mass")
    if ways or not (listed or pallets) or aircraft not in resources.aircraft():
        takeoff_mass, payload = (
            source.quantity(element, name, "mass") if name in ways else None
            for name in ("take-off-mass", "payload")
        )
        return Loading(takeoff_mass, payload, fuel)
    stowage = read_stowage(str(aircraft))
    nobody: tuple[Item, ...] = ()
    passengers = source.read(element, "passengers", lambda text: _first(text, stowage.seats), nobody)
    passengers += source.read(element, "seats", lambda text: _named(text, stowage.seats), nobody)
    loads = tuple(_pallet(source, pallet, stowage) for pallet in pallets)
    payload = sum(item.mass for item in (*passengers, *(load.item for load in loads)))
    return Loading(None, payload, fuel, passengers, loads)


def _first(text: str, seats: Mapping[str, Item]) -> tuple[Item, ...]:
    """The first so many seats, in the order in which they are filled."""
    count = parse(text, "count")
    if count != int(count) or not 0 <= count <= len(seats):
        raise UnitError(f'"{text}" is no number of passengers; there are {len(seats)} seats')
    return tuple(seats.values())[: int(count)]


def _named(text: str, seats: Mapping[str, Item]) -> tuple[Item, ...]:
    """The seats in a list such as "1A 1D 5A-12A"."""
    taken: dict[str, Item] = {}
    for word in text.split():
        found = _SEATS.fullmatch(word)
        if found is None or (found[4] and found[4] != found[2]):
            raise UnitError(f'"{word[:20]}" is not a seat; write e.g. 1A, or 5A-12A for a run of them')
        for number in range(int(found[1]), int(found[3] or found[1]) + 1):
            name = f"{number}{found[2]}"
            if name not in seats:
                raise UnitError(f'there is no seat "{name}"; {did_you_mean(name, seats)}')
            if name in taken:
                raise UnitError(f'seat "{name}" is taken twice; one passenger a seat')
            taken[name] = seats[name]
    return tuple(taken.values())


def _pallet(source: Source, element: Element, stowage: Stowage) -> Pallet:
    name = element.get("name", "")
    mass = source.quantity(element, "mass", "mass")
    position = source.quantity(element, "position", "length")
    hold, pallet = stowage.hold, stowage.pallet
    front, rear = position - pallet.length / 2, position + pallet.length / 2
    if front < hold.front or rear > hold.ramp_end:
        source.fault(
            f'pallet "{name}" reaches from {front:.1f} m to {rear:.1f} m, outside the hold',
            element,
            "position",
            f"hold and ramp reach from {hold.front:.1f} m to {hold.ramp_end:.1f} m aft of the nose",
        )
    if mass <= 0 or mass > pallet.heaviest:
        source.fault(
            f'pallet "{name}" of {mass / 1000:.1f} t cannot be carried',
            element,
            "mass",
            f"a pallet has more than 0 t and at most {pallet.heaviest / 1000:.1f} t",
        )
    return Pallet(stowage.on_pallet(name, mass, position), source.quantity(element, "parachute", "area", 0.0))
