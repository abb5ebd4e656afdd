"""The inverse search for the greatest mass, on take-offs in closed form."""

import pytest

from harness.errors import FlightError
from harness.manual import read_manual
from harness.takeoff import greatest
from harness.takeoff.card import Card, needs
from harness.takeoff.case import TakeOff
from harness.takeoff.climb import Gradients
from harness.takeoff.field import Field
from harness.takeoff.field_flights import Runway
from harness.takeoff.speeds import ControlSpeeds, Speeds

MANUAL = read_manual("gta")
CONTROL = ControlSpeeds(55.0, 60.0, "")
HIGHEST = MANUAL.limits["maximum-take-off-mass"]
PLENTY = Runway(9000.0, 9000.0, 9000.0)


@pytest.fixture(autouse=True)
def _here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every card in this process, where the tests can count them."""
    monkeypatch.setattr(greatest, "fly_all", lambda fly, cases, *_: [fly(case) for case in cases])


def a_card(
    mass: float, runway: Runway, *, brakes: float = 0.5, tyres: float = 0.5, climb: float = 0.2
) -> Card:
    """A take-off whose needs are powers of the mass; `brakes` and so on are those of 110 t."""
    share = mass / 110e3
    distance, stop, vr = 1300.0 * share**2.4, 1250.0 * share**2.1, 66.0 * share**0.5
    speeds = Speeds(60.0 * share**0.5, 55.0, 60.0, "", 67.0, 69.0 * share**0.5, 63.0, vr)
    field = dict.fromkeys(Field._fields, 1.0) | {
        "speeds": speeds,
        "v1": 0.93 * vr,
        "v1_set_by": "balance",
        "slowest_v1": 58.0,
        "take_off_run": 0.9 * distance,
        "take_off_distance": distance,
        "accelerate_stop": stop,
        "gradients": Gradients(climb / share - 0.08, vr, climb / share - 0.07, vr),
        "brake_energy": brakes * share**2,
        "tyre_speed": tyres * share**0.5,
    }
    one = Field(**field)  # type: ignore[arg-type]
    return Card(TakeOff(mass), runway, CONTROL, one, tuple(needs(one, runway)))


@pytest.mark.parametrize(
    ("runway", "more", "limit"),
    [
        (Runway(1500.0, 1500.0, 1500.0), {}, ("field", 110e3 * (1500 / 1300) ** (1 / 2.4))),
        (Runway(900.0, 1500.0, 1500.0), {}, ("field", 110e3 * (900 / 1170) ** (1 / 2.4))),
        (Runway(9000.0, 9000.0, 1250.0), {}, ("field", 110e3)),
        (PLENTY, {"climb": 0.11}, ("climb segment", 110e3 * 0.11 / 0.1)),
        (PLENTY, {"brakes": 0.8}, ("brake energy", 110e3 * (1 / 0.8) ** 0.5)),
        (PLENTY, {"tyres": 0.95}, ("tyre speed", 110e3 * (1 / 0.95) ** 2)),
    ],
)
@pytest.mark.parametrize("start", [85e3, 110e3, 140e3])
def test_greatest_mass_within_the_tolerance(runway, more, limit, start, monkeypatch):
    kind, expected = limit
    flown: list[float] = []

    def card(case, *_, **__):
        flown.append(case.mass)
        return a_card(case.mass, runway, **more)

    monkeypatch.setattr(greatest, "card", card)
    found = greatest.greatest_mass(a_card(start, runway, **more), MANUAL)
    assert expected - greatest.MASS_TOLERANCE <= found.mass <= expected
    assert found.set_by == kind
    assert found.inside is not None
    assert found.inside.met
    assert found.outside is not None
    assert not found.outside.met
    assert 1 <= len(flown) <= 9, "cards flown beside the first"


def test_a_long_runway_takes_the_greatest_mass_there_is(monkeypatch):
    monkeypatch.setattr(greatest, "card", lambda case, *_, **__: a_card(case.mass, PLENTY))
    found = greatest.greatest_mass(a_card(110e3, PLENTY), MANUAL)
    assert (found.mass, found.set_by) == (HIGHEST, "maximum take-off mass")


def test_a_runway_too_short_for_any(monkeypatch):
    short = Runway(500.0, 500.0, 500.0)
    monkeypatch.setattr(greatest, "card", lambda case, *_, **__: a_card(case.mass, short))
    found = greatest.greatest_mass(a_card(110e3, short), MANUAL)
    assert str(found.mass) == "nan"
    assert found.set_by == "field even at 80.6 t"


def test_masses_that_do_not_fly_are_outside(monkeypatch):
    def card(case, *_, **__):
        if case.mass > 120e3:
            raise FlightError("it does not climb", time=0.0, phase="take-off")
        return a_card(case.mass, PLENTY)

    monkeypatch.setattr(greatest, "card", card)
    found = greatest.greatest_mass(a_card(110e3, PLENTY), MANUAL)
    assert found.set_by == "flight"
    assert 120e3 - greatest.MASS_TOLERANCE <= found.mass <= 120e3


@pytest.mark.parametrize(
    ("set_by", "limited", "kind"),
    [("VMCG", "accelerate-stop distance", "VMCG"), ("brake energy", "take-off distance", "brake energy")],
)
def test_a_distance_too_long_for_the_sake_of_v1_is_put_to_what_set_v1(set_by, limited, kind):
    runway = Runway(1300.0, 1500.0, 1200.0) if kind == "VMCG" else Runway(1290.0, 1290.0, 1500.0)
    field = a_card(110e3, runway).field._replace(v1_set_by=set_by)
    found = {need.name: need for need in needs(field, runway)}
    assert not found[limited].met
    assert found[limited].kind == kind


def test_without_a_clearway_the_take_off_run_is_the_take_off_distance():
    """CS 25.113(c)."""
    field = a_card(110e3, PLENTY).field
    run = {length: needs(field, Runway(3000.0, length, 3000.0))[0].required for length in (3000.0, 3200.0)}
    assert run == {3000.0: field.take_off_distance, 3200.0: field.take_off_run}
