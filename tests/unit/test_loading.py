"""Loading: closed forms, the fuel-management table, seats, pallets and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from harness.errors import InputError, InputErrors
from harness.loading.aircraft import read_stowage
from harness.loading.balance import Item, combined, four_points
from harness.loading.envelope import Envelope
from harness.loading.tanks import filled
from harness.manual import read_manual
from harness.mission.balance import LoadSheet
from harness.mission.check import check_file
from harness.pilot.balance import BalanceWatch
from harness.state import FIELDS, State

BULK = 'take-off-mass="95 t" fuel="8 t"/>'


def mission(folder: Path, repository: Path, loading: str, name: str = "hop") -> Path:
    text = (repository / "missions" / f"{name}.xml").read_text("utf-8")
    assert BULK in text
    path = folder / "loaded.xml"
    path.write_text(text.replace(f"<loading {BULK}", loading), "utf-8")
    return path


def refused(path: Path, *overrides: str) -> str:
    with pytest.raises(InputErrors) as caught:
        check_file(path, overrides)
    assert len(caught.value.every) == 1, str(caught.value)
    assert f"{path}:" in str(caught.value) or overrides
    return str(caught.value)


def points_of(cylinder: Item, count: int = 40) -> list[Item]:
    """A cylinder along x as very many points, by equal volumes: rings, angles and slices."""
    radii = cylinder.radius * np.sqrt((np.arange(count) + 0.5) / count)
    slices = cylinder.length * ((np.arange(count) + 0.5) / count - 0.5)
    angles = 2 * np.pi * np.arange(8) / 8
    mass = cylinder.mass / (count * count * 8)
    return [
        Item("", mass, cylinder.x + x, cylinder.y + r * np.cos(a), cylinder.z + r * np.sin(a))
        for r in radii
        for x in slices
        for a in angles
    ]


def test_a_cylinder_has_the_inertia_of_its_parts() -> None:
    whole = Item("", 8000.0, 21.0, 0.5, 3.2, radius=1.1, length=2.74)
    parts = combined(points_of(whole))
    assert combined([whole]).centre == pytest.approx(parts.centre)
    assert combined([whole]).inertia == pytest.approx(parts.inertia, rel=1e-3, abs=1e-6)


def test_two_bodies_turn_about_their_common_centre() -> None:
    """The reduced mass: 2 t and 6 t, 4 m apart along x: J = 2 * 6 / 8 * 16 t m2."""
    body = combined([Item("", 2000.0, 10.0, 0.0, 3.0), Item("", 6000.0, 14.0, 0.0, 3.0)])
    assert body.centre == pytest.approx([13.0, 0.0, 3.0])
    assert body.inertia == pytest.approx(np.diag([0.0, 24000.0, 24000.0]))


def test_four_points_stand_for_any_load() -> None:
    random = np.random.default_rng(1)
    items = [
        Item("", mass, x, y, z, radius, length)
        for mass, x, y, z, radius, length in random.uniform(
            (50, 10, -2, 2, 0, 0), (9000, 30, 2, 5, 1.5, 3), (25, 6)
        )
    ]
    load = combined(items)
    stand_in = combined([Item("", load.mass / 4, *place) for place in four_points(load)])
    assert stand_in.mass == pytest.approx(load.mass)
    assert stand_in.centre == pytest.approx(load.centre)
    assert stand_in.inertia == pytest.approx(load.inertia, rel=1e-9, abs=1e-6)


def test_tanks_fill_line_by_line_and_in_proportion() -> None:
    order = ((1, 2), (0,))
    assert filled((100.0, 30.0, 10.0), order, 20.0) == [0.0, 15.0, 5.0]
    assert filled((100.0, 30.0, 10.0), order, 60.0) == [20.0, 30.0, 10.0]
    with pytest.raises(InputError, match="141 kg of fuel do not fit: the tanks hold 140 kg"):
        filled((100.0, 30.0, 10.0), order, 141.0)


def test_the_aircraft_has_the_published_seats_and_tanks() -> None:
    stowage = read_stowage("gta")
    assert len(stowage.seats) == 116
    assert list(stowage.seats)[:4] == ["1A", "1D", "2A", "2D"]
    hold = stowage.hold
    assert all(hold.front < seat.x < hold.rear for seat in stowage.seats.values())
    assert hold.rear - hold.front == pytest.approx(17.7)
    assert hold.ramp_end - hold.rear == pytest.approx(5.4)
    assert sum(tank.capacity for tank in stowage.tanks) == pytest.approx(48879.0, abs=1.0)


def test_seats_and_pallets_make_the_payload(tmp_path: Path, repository: Path) -> None:
    loading = (
        '<loading fuel="8 t" seats="1A 1D 5A-7A"><pallet name="p" mass="3 t" position="19 m"/></loading>'
    )
    read = check_file(mission(tmp_path, repository, loading))
    assert read.loading.payload == 5 * 110.0 + 3000.0
    assert [item.name for item in read.loading.items] == ["1A", "1D", "5A", "6A", "7A", "p"]
    body = LoadSheet(read, read_manual("gta")).body(0.0)
    assert body.mass == 78600.0 + 3550.0
    places = [read_stowage("gta").seats[name].x for name in ("1A", "1D", "5A", "6A", "7A")]
    by_hand = (78600.0 * 18.988 + 110.0 * sum(places) + 3000.0 * 19.0) / 82150.0
    assert body.centre[0] == pytest.approx(by_hand)


def test_the_sheet_says_what_is_where(tmp_path: Path, repository: Path) -> None:
    loading = '<loading fuel="20 t" passengers="20"/>'
    read = check_file(mission(tmp_path, repository, loading))
    sheet = LoadSheet(read, read_manual("gta"))
    data, text = sheet.data(), str(sheet)
    assert sum(tank["mass_kg"] for tank in data["tanks"]) == pytest.approx(20000.0)
    assert data["states"]["take_off"]["mass_kg"] == pytest.approx(78600.0 + 2200.0 + 20000.0)
    assert 0.16 < data["states"]["zero_fuel"]["cg_mac"] < 0.40
    assert "20 passengers" in text
    assert "inner right" in text
    assert "% MAC" in text


PALLET = '<loading fuel="8 t"><pallet name="a" mass="{}" position="{}"/>{}</loading>'


@pytest.mark.parametrize(
    ("loading", "said"),
    [
        (PALLET.format("8 t", "9 m", ""), 'pallet "a" reaches from 7.6 m to 10.4 m, outside the hold'),
        (PALLET.format("8 t", "33 m", ""), "outside the hold"),
        (PALLET.format("17 t", "19 m", ""), 'pallet "a" of 17.0 t cannot be carried'),
        (PALLET.format("0 t", "19 m", ""), "cannot be carried"),
        (PALLET.format("8", "19 m", ""), 'mass="8" has no unit'),
        (PALLET.format("8 t", "19", ""), 'position="19" has no unit'),
        (PALLET.format("8 t", "19 kg", ""), 'position="19 kg" is a mass'),
        (PALLET.format("8 t", "19 m", '<pallet name="a" mass="1 t" position="25 m"/>'), "is here twice"),
        (PALLET.format("8 t", "19 m", '<pallet name="b" mass="1 t" position="20 m"/>'), "overlap by 1.74 m"),
        (PALLET.format("14 t", "31 m", ""), "aft of the limit of 40.0 % MAC at"),
        (PALLET.format("14 t", "11.5 m", ""), "forward of the limit of"),
        (
            (
                '<loading fuel="8 t" passengers="116"><pallet name="a" mass="15 t" position="17 m"/>'
                '<pallet name="b" mass="15 t" position="21 m"/></loading>'
            ),
            "the mass without fuel, 121.4 t, is above the zero-fuel limit of 115.6 t",
        ),
        ('<loading fuel="60 t" passengers="2"/>', "60.0 t of fuel is more than the tanks hold"),
        ('<loading fuel="8 t" passengers="117"/>', "there are 116 seats"),
        ('<loading fuel="8 t" passengers="1.5"/>', "no number of passengers"),
        ('<loading fuel="8 t" seats="1A 99D"/>', 'there is no seat "99D"'),
        ('<loading fuel="8 t" seats="1A 1A"/>', "taken twice"),
        ('<loading fuel="8 t" seats="aisle"/>', '"aisle" is not a seat'),
        ('<loading fuel="8 t" passengers="2" seats="1A"/>', "both say who is on board"),
        ('<loading fuel="8 t" payload="2 t" passengers="2"/>', "each gives the mass"),
        ('<loading fuel="8 t"/>', "either the take-off mass or the payload"),
    ],
)
def test_a_loading_that_cannot_be_is_refused_with_its_line(
    tmp_path: Path, repository: Path, loading: str, said: str
) -> None:
    assert said in refused(mission(tmp_path, repository, loading))


def test_a_balance_that_leaves_its_limits_is_told_once_and_once_when_it_is_back() -> None:
    watch = BalanceWatch(Envelope(17.0, 5.0, 0.15, (78e3, 141e3), (0.2, 0.2), (0.4, 0.4)))
    told = []
    for x in (18.5, 18.9, 19.1, 19.2, 19.3, 18.99, 18.8, 17.9):
        state = State(**dict.fromkeys(FIELDS, 0.0))
        state.centre_of_gravity, state.mass = x, 100e3
        told.append(watch.change(state))
    assert told == [
        *("", ""),
        "42.0 % MAC, outside 20.0 % MAC to 40.0 % MAC",
        *("", ""),
        "39.8 % MAC, inside 20.0 % MAC to 40.0 % MAC",
        "",
        "18.0 % MAC, outside 20.0 % MAC to 40.0 % MAC",
    ]


def test_heavy_seats_on_one_side_are_beyond_the_lateral_limit() -> None:
    limits = Envelope(17.4, 5.671, 0.15, (78e3, 141e3), (0.16, 0.2), (0.4, 0.36))
    body = combined([Item("", 80e3, 19.0, 0.0, 4.0), Item("", 10e3, 19.0, -1.75, 3.0)])
    (told,) = limits.faults(body)
    assert told == "the centre of gravity lies 0.19 m to the left, beyond the limit of 0.15 m at 90.0 t"


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        ("route/waypoint[run-in]/action[ramp open]/to=0.5", "with the ramp not open"),
        ("route/waypoint[drop zone]/action[vehicle away]/to=lorry", '"lorry" is not a position of release'),
        (
            "route/waypoint[drop zone]/speed=110 m/s CAS",
            "too fast with the ramp open\n    at most 180 kt CAS",
        ),
        ("loading/pallet[vehicle]/position=11.6 m", "forward of the limit"),
        (
            (
                "loading/pallet[supplies]/mass=9 t; loading/pallet[supplies]/position=11.6 m; "
                "loading/pallet[vehicle]/position=26 m"
            ),
            "after the release of vehicle the centre of gravity lies at",
        ),
    ],
)
def test_a_drop_that_cannot_be_is_refused(repository: Path, overrides: str, said: str) -> None:
    assert said in refused(repository / "missions/airdrop.xml", *overrides.split("; "))
