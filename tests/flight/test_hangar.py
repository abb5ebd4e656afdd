"""An aircraft that was parked flies as one that is loaded, and once only."""

import pytest

from harness.plant import hangar
from harness.resources import root
from harness.takeoff.case import TakeOff
from harness.takeoff.flight import fly_take_off
from harness.takeoff.rows import row


@pytest.fixture
def loads(monkeypatch):
    seen = []
    monkeypatch.setattr(hangar, "_parked", {})
    monkeypatch.setattr(hangar, "_wanted", [])
    load = hangar.load
    monkeypatch.setattr(hangar, "load", lambda *sort: seen.append(sort) or load(*sort))
    return seen


def test_a_parked_aircraft_is_flown_once_and_gives_the_same_numbers(loads):
    case = TakeOff(91e3)
    hangar.park(hangar.Sort(root(), "gta", case.rate, own_rates=True))
    hangar.park(hangar.Sort(root(), "gta", case.rate, own_rates=True))
    assert len(loads) == 1
    parked = row(fly_take_off(case))
    assert len(loads) == 1
    assert row(fly_take_off(case)) == parked
    assert len(loads) == 2


def test_it_is_taken_for_flights_of_its_sort_only(loads):
    hangar.park(hangar.Sort(root(), "gta", 120))
    assert hangar.fresh(hangar.Sort(root(), "gta", 240)).get_delta_t() == 1 / 240
    hangar.park_again()
    assert loads[1:] == [(hangar.Sort(root(), "gta", 240),)] * 2
    assert hangar.fresh(hangar.Sort(root(), "gta", 240)).get_delta_t() == 1 / 240
    assert hangar.fresh(hangar.Sort(root(), "gta", 120)).get_delta_t() == 1 / 120
    assert len(loads) == 3
