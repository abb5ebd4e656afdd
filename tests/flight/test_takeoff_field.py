"""Speeds, field lengths and the card: what CS-25 says must hold, on flights."""

import json
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from harness.flight import fly
from harness.log import Reporter
from harness.manual import read_manual
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.state import Commands, State
from harness.takeoff.card import card
from harness.takeoff.case import Happening, TakeOff, fine
from harness.takeoff.charts import early_rotation, sensitivities
from harness.takeoff.climb import CLIMB_HEIGHT, CLIMB_OVER, climbs, gradient
from harness.takeoff.field import field_of
from harness.takeoff.field_flights import AT_V1, FieldFlights, Runway
from harness.takeoff.flight import CS25_SCREEN, fly_take_off, prepared
from harness.takeoff.greatest import MASS_TOLERANCE, greatest_mass
from harness.takeoff.page import page
from harness.takeoff.runway import deviation, from_database, on_site
from harness.takeoff.speeds import ControlSpeeds, control_speeds, vmcg
from harness.takeoff.text import card_data, card_text
from harness.units import G0, LB

PUSHING = ("prop", "aero", "external")  # external: the jets of the engines
HEAVY = fine(TakeOff(124e3, None))


@pytest.fixture(scope="module")
def control() -> ControlSpeeds:
    return control_speeds(HEAVY, read_manual("gta"), 2)


@pytest.fixture(scope="module")
def flights(control) -> FieldFlights:
    return FieldFlights(HEAVY, control=control, workers=2)


def test_the_pilot_continues_and_rejects(flights):
    """An engine really fails, and both ways out of it are flown to their end."""
    vr = flights.speeds.vr
    go = flights.fly(flights.going(vr - 4.0))
    stop = flights.fly(flights.stopping(vr - 4.0, failure=True))
    assert go.when("failure", "engine 1") < go.liftoff < go.at_height(CS25_SCREEN)
    assert stop.ground_speed[-1] < 1.0  # the step before it stands
    assert abs(stop.across).max() < 10.0
    assert go.thrust[-1] < 0.8 * go.thrust[int(go.when("failure", "engine 1")) - 5]


def test_first_action_is_at_v1_a_second_after_the_failure(flights):
    v1 = flights.speeds.vr - 4.0
    stop = flights.fly(flights.stopping(v1, failure=True))
    decided, failed = stop.when("phase", "RTO"), stop.when("failure", "engine 1")
    before = int(decided)  # the speed peaks between two rows: what the two before say of the moment
    gained = (stop.cas[before] - stop.cas[before - 1]) * (decided - before)
    assert v1 - 0.01 <= stop.cas[before] + gained < v1 + 0.05
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
    """Accelerate-stop equals accelerate-go within 1 m, V1 is at most VR, the field grows with mass, heat and height.

    Heavy, hot or high the brakes may bear less than the balanced V1.
    """
    fields = {}
    for name, case in {
        "here": HEAVY,
        "heavier": replace(HEAVY, mass=130e3),
        "hotter": replace(HEAVY, isa_deviation=25.0),
        "higher": replace(HEAVY, elevation=1500.0),
    }.items():
        fields[name] = field = field_of(case, workers=2)
        assert field.balanced_stop == pytest.approx(field.balanced_go, abs=1.0)
        if field.v1_set_by == "brake energy":
            assert field.v1 < field.v1_balanced
            assert field.brake_energy == pytest.approx(1.0, abs=0.003)
        else:
            assert field.v1_set_by == "balance"
            assert field.accelerate_stop == pytest.approx(field.accelerate_go_oei, abs=1.0)
        assert field.speeds.vmcg < field.v1 <= field.speeds.vr <= field.speeds.v2
        assert field.v_35ft >= field.speeds.v2 - 0.15
        assert field.gradients.second > field.gradients.first > 0.0
    assert fields["here"].v1_set_by == "balance"
    assert all(
        fields[name].balanced_stop > fields["here"].balanced_stop for name in ("heavier", "hotter", "higher")
    )


@pytest.mark.slow
def test_a_wet_stop_is_longer(flights):
    """At the same V1 and without reverse thrust."""
    v1 = flights.speeds.vr - 4.0
    happening = Happening(vef=flights.vef(v1), v1=v1)
    dry, wet = (fly_take_off(replace(flights.case, surface=surface), happening) for surface in ("dry", "wet"))
    assert wet.along[-1] > 1.1 * dry.along[-1]


@pytest.mark.slow
def test_wet_rules(control):
    """CS 25.109(b), 25.113(b), (c)(2): distances of a wet runway and V1 are its own, with the dry ones as a floor."""
    wet, dry = (
        field_of(replace(HEAVY, surface=surface), control=control, workers=2) for surface in ("wet", "dry")
    )
    # over 15 ft
    assert wet.accelerate_stop_oei == pytest.approx(wet.accelerate_go_oei, abs=1.0)
    assert wet.v1 < dry.v1
    assert wet.accelerate_stop == max(wet.accelerate_stop_oei, wet.accelerate_stop_aeo, dry.accelerate_stop)
    assert wet.take_off_distance == max(wet.accelerate_go_oei, dry.take_off_distance)
    assert wet.take_off_run == max(wet.accelerate_go_oei, wet.take_off_run_aeo)
    assert (wet.dry_v1, wet.dry_take_off_distance) == (dry.v1, dry.take_off_distance)


@pytest.mark.slow
def test_minimum_control_speeds_are_those_of_the_lightest(control):
    """CS 25.149: VMC at most 1.13 VSR of the greatest mass; VR, V2 keep away; a heavy aircraft has less VMCG."""
    manual = read_manual("gta")
    assert control.vmca < 1.13 * manual.stall_speed(manual.limits["maximum-take-off-mass"], "take-off")
    light = FieldFlights(fine(TakeOff(90e3, None)), manual, control, 2)
    assert light.speeds.vr >= 1.05 * control.vmca
    assert light.speeds.v2 >= 1.10 * control.vmca
    assert vmcg(replace(HEAVY, pilot_rate=24), manual) < control.vmcg


def test_where_there_is_no_vmca_it_says_so(monkeypatch):
    """As the heavy ones do: were none lighter, there would be no VMCA."""
    monkeypatch.setattr("harness.takeoff.speeds.lightest", lambda manual: 124e3)
    speeds = control_speeds(HEAVY, read_manual("gta"))
    assert np.isnan(speeds.vmca)
    assert "limits nothing" in speeds.vmca_told


@dataclass
class Excess:
    """Thrust less drag over the weight, at each step of the pilot, from the forces on the aircraft."""

    plant: JSBSimPlant
    rows: list[tuple[float, float]] = field(default_factory=list)

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        if state.height < CLIMB_HEIGHT / 2:
            return
        fdm = self.plant.fdm
        forces = np.array([sum(fdm[f"forces/fb{axis}-{part}-lbs"] for part in PUSHING) for axis in "xyz"])
        air = np.array([fdm[f"velocities/{axis}-aero-fps"] for axis in "uvw"])
        along = float(forces @ air / np.linalg.norm(air)) * LB * G0
        self.rows.append((state.time, along / (state.mass * G0)))

    def note(self, event: object) -> None:
        pass


@pytest.mark.parametrize("segment", [0, 1])
def test_gradient_is_the_excess_thrust_over_the_weight(flights, segment):
    """CS 25.121(a) at VLOF, gear down, (b) at V2, gear up: gamma = (T - D) / W with the forces of the same flight."""
    happening, height = climbs(flights, flights.speeds.vr - 4.0)[segment]
    flown = flights.fly((happening, height))
    go = flights.fly(flights.going(flights.speeds.vr - 4.0))
    expected = (go.at(go.liftoff, "cas"), flights.speeds.v2)[segment]
    assert flown.cas[-1] == pytest.approx(expected, abs=0.5)
    pilot, plant, track = prepared(flights.case, happening, flights.manual)
    excess = Excess(plant)
    fly(pilot, plant, observers=(track, excess), until=lambda state: state.height > CLIMB_HEIGHT)
    time, share = np.array(excess.rows).T
    mean = share[time >= time[-1] - CLIMB_OVER].mean()
    assert gradient(flown) == pytest.approx(np.tan(np.arcsin(mean)), abs=0.001)


@pytest.mark.slow
def test_greatest_mass_is_just_inside(control):
    """The mass found is possible, the mass a tolerance heavier is not; found again from another mass."""
    manual, runway = read_manual("gta"), Runway(1500.0, 1500.0, 1500.0)
    case = replace(HEAVY, mass=110e3)
    found = greatest_mass(card(case, runway, manual, control, workers=2), manual, 2)
    assert found.set_by == "field"
    fresh = [
        card(replace(case, mass=found.mass + more), runway, manual, control, workers=2)
        for more in (-MASS_TOLERANCE / 2, 1.5 * MASS_TOLERANCE)
    ]
    assert [one.met for one in fresh] == [True, False]


@pytest.mark.slow
def test_card(control):
    site = from_database("EDDK/13R")
    case = on_site(replace(HEAVY, mass=100e3), site)
    plenty = card(case, Runway(3000.0, 3000.0, 3000.0), control=control, workers=2)
    assert plenty.met
    short = card(case, Runway(1000.0, 1000.0, 1000.0), control=control, workers=2)
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
    """Smooth at half their steps, with the signs of nature; flaps are near their best, where the slope is small."""
    found = {one.name: one for one in sensitivities(HEAVY, 2)}
    assert all(one.smooth for one in found.values() if one.name != "flap")
    longer = {name for name, one in found.items() if one.derivative > 0}
    always = {"mass", "mass with VR", "temperature", "elevation", "slope", "VR", "friction"}
    assert longer == always | (longer & {"flap"})
    # Rules of thumb for a distance to a screen: twice the mass, a tenth for 10 kt, and so on.
    share = {name: one.usual_share for name, one in found.items()}
    assert 1.7 <= share["mass with VR"] * HEAVY.mass / 1000.0 <= 2.6
    assert 0.03 <= share["temperature"] <= 0.09
    assert 0.02 <= share["elevation"] <= 0.08
    assert -0.16 <= share["headwind"] <= -0.08
    assert 0.01 <= share["slope"] <= 0.06


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
