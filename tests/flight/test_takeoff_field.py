"""Speeds, field lengths and the card: what CS-25 says must hold, on flights."""

import json
from dataclasses import replace

import pytest

from harness.takeoff.card import card
from harness.takeoff.case import Happening, TakeOff
from harness.takeoff.charts import early_rotation, sensitivities
from harness.takeoff.field import AT_V1, FieldFlights, Runway
from harness.takeoff.flight import CS25_SCREEN, fly_take_off
from harness.takeoff.page import page
from harness.takeoff.runway import deviation, from_database, on_site
from harness.takeoff.text import card_data, card_text

HEAVY = TakeOff(124e3, None, pilot_rate=120)


@pytest.fixture(scope="module")
def flights() -> FieldFlights:
    return FieldFlights(HEAVY)


def test_the_pilot_continues_and_rejects(flights):
    """An engine really fails, and both ways out of it are flown to their end."""
    vr = flights.speeds.vr
    go, stop = flights.go(vr - 4.0), flights.stop(vr - 4.0, failure=True, reverse=False)
    assert go.when("failure", "engine 1") < go.liftoff < go.at_height(CS25_SCREEN)
    assert stop.ground_speed[-1] < 1.0  # the step before it stands
    assert abs(stop.across).max() < 10.0
    assert go.thrust[-1] < 0.8 * go.thrust[int(go.when("failure", "engine 1")) - 5]


def test_first_action_is_at_v1_a_second_after_the_failure(flights):
    v1 = flights.speeds.vr - 4.0
    stop = flights.stop(v1, failure=True, reverse=False)
    decided, failed = stop.when("phase", "RTO"), stop.when("failure", "engine 1")
    assert v1 <= stop.at(decided, "cas") < v1 + 0.05
    assert 1.0 <= stop.at(decided, "time") - stop.at(failed, "time") < 1.4
    distance = flights.accelerate_stop(v1)
    assert distance == pytest.approx(stop.along[-1] + AT_V1 * v1, abs=1.0)


def test_stop_grows_and_go_shrinks_with_v1(flights):
    speeds = [flights.speeds.vr - step for step in (6.0, 3.0, 0.0)]
    stops, goes = [flights.accelerate_stop(v) for v in speeds], [flights.accelerate_go(v) for v in speeds]
    assert stops == sorted(stops)
    assert goes == sorted(goes, reverse=True)
    reverse = flights.accelerate_stop(speeds[0], reverse=True)
    assert reverse < stops[0]


@pytest.mark.slow
def test_balanced_field():
    """Accelerate-stop equals accelerate-go within 1 m, V1 is at most VR, the field grows with mass, heat and height."""
    fields = {}
    for name, case in {
        "here": HEAVY,
        "heavier": replace(HEAVY, mass=130e3),
        "hotter": replace(HEAVY, isa_deviation=25.0),
        "higher": replace(HEAVY, elevation=1500.0),
    }.items():
        fields[name] = field = FieldFlights(case).field()
        assert field.v1_set_by == "balance"
        assert field.accelerate_stop == pytest.approx(field.accelerate_go_oei, abs=1.0)
        assert field.speeds.vmcg < field.v1 <= field.speeds.vr <= field.speeds.v2
        assert field.v_35ft >= field.speeds.v2 - 0.15
        assert field.gradients.second > field.gradients.first > 0.0
    assert all(
        fields[name].accelerate_stop > fields["here"].accelerate_stop
        for name in ("heavier", "hotter", "higher")
    )


@pytest.mark.slow
def test_a_wet_stop_is_longer(flights):
    """At the same V1 and without reverse thrust."""
    v1 = flights.speeds.vr - 4.0
    happening = Happening(vef=flights.vef(v1), v1=v1)
    dry, wet = (fly_take_off(replace(flights.case, surface=surface), happening) for surface in ("dry", "wet"))
    assert wet.along[-1] > 1.1 * dry.along[-1]


@pytest.mark.slow
def test_card():
    site = from_database("EDDK/13R")
    case = on_site(replace(HEAVY, mass=100e3), site)
    plenty = card(case, Runway(3000.0, 3000.0, 3000.0), search=False)
    assert plenty.met
    short = card(case, Runway(1000.0, 1000.0, 1000.0), search=False)
    assert not short.met
    assert short.limiting.kind == "field"
    data = card_data(short, site)
    assert json.loads(json.dumps(data)) == data
    assert "NOT POSSIBLE" in card_text(data)
    assert "TAKE-OFF NOT POSSIBLE" in page(data)


def test_rotating_too_early_lengthens_by_at_most_one_per_cent():
    """AMC 25.107(e)(4): all engines, VR 10 kt or 7 % early."""
    for mass in (89e3, 124e3):
        assert early_rotation(replace(HEAVY, mass=mass))["longer"] <= 0.01


@pytest.mark.slow
def test_sensitivities():
    """Smooth at half their steps, with the signs of nature."""
    found = {one.name: one for one in sensitivities(HEAVY, 2)}
    assert all(one.smooth for one in found.values())
    longer = {name for name, one in found.items() if one.derivative > 0}
    assert longer == {"mass", "temperature", "elevation", "slope", "VR", "friction"} | (longer & {"flap"})


def test_a_runway_of_the_database_and_its_day():
    site = from_database("EDDK/14R")
    assert site.available.run == pytest.approx(1862.4, abs=5.0)
    assert site.elevation == pytest.approx(221 * 0.3048, abs=1.0)
    against = on_site(HEAVY, site, site.heading, 10.0)
    assert against.headwind == pytest.approx(5.0)
    behind = on_site(HEAVY, site, site.heading + 3.14159265, 10.0)
    assert behind.headwind == pytest.approx(-15.0)
    assert deviation(15.0, 0.0) == pytest.approx(0.0)
    assert deviation(15.0, 1000.0) == pytest.approx(6.5)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--mass", "100t"), "no runway is given"),
        (("--mass", "100t", "--runway", "EDDK"), "is no runway"),
        (("--mass", "100t", "--runway", "XXXX/14"), "no airport"),
        (("--mass", "300t", "--runway", "EDDK/14L"), "outside the limits"),
        (("--mass", "100t", "--runway", "EDDK/14L", "--temperature", "25"), "no temperature"),
        (("--mass", "100t", "--tora", "2000"), "no unit"),
    ],
)
def test_bad_input_of_a_card(arguments, said, capsys):
    from harness.cli import main

    assert main(["takeoff", "card", *arguments]) == 2
    assert said in capsys.readouterr().err
