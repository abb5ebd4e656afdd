"""Take-offs over mass against the paper's two distances and the target curve between them."""

import csv
import io
import json

import pytest

from harness.errors import InputErrors
from harness.manual import read_manual
from harness.takeoff.case import TakeOff, check
from harness.takeoff.flight import Flown, fly_take_off
from harness.takeoff.rows import case_row, row

# Distance to 35 m, m: AIAA 2010-7777 Results B for 89 and 124 t; between them the curve of a point mass with two
# parameters fitted to those two (V01 to V06). Lift-off of the same model (V07), speed at 35 m (V08).
TARGETS = {89e3: 972.0, 96e3: 1045.0, 103e3: 1120.0, 110e3: 1198.0, 117e3: 1280.0, 124e3: 1367.0}
LIFTOFF = {89e3: 614.0, 124e3: 918.0}
SPEED_35M = {89e3: 73.0, 124e3: 71.0}
RATIO = 1.406


@pytest.fixture(scope="module")
def study() -> dict[float, Flown]:
    return {mass: fly_take_off(TakeOff(mass)) for mass in TARGETS}


def test_the_distances_of_fig_14(study):
    rows = {mass: row(flown) for mass, flown in study.items()}
    distance = [rows[mass]["distance_35m_m"] for mass in TARGETS]
    for mass, target in TARGETS.items():
        assert rows[mass]["distance_35m_m"] == pytest.approx(target, rel=0.03)
    assert distance == sorted(distance)
    assert distance[-1] / distance[0] == pytest.approx(RATIO, rel=0.02)
    for mass, target in LIFTOFF.items():
        assert rows[mass]["liftoff_distance_m"] == pytest.approx(target, rel=0.08)
    for mass, target in SPEED_35M.items():
        assert rows[mass]["v_35m_mps"] == pytest.approx(target, abs=3.0)


def test_a_take_off_is_flown_straight_and_without_striking_the_tail(study):
    limit = read_manual("gta").limits["tail-clearance-pitch"]
    for flown in study.values():
        assert abs(flown.across).max() < 1.0
        assert flown.pitch.max() < limit
        assert flown.ground_speed[0] < 0.2  # from standstill
        assert flown.height[: int(flown.liftoff)].max() < 0.1  # legs hang out a moment after contact is lost


def test_lift_off_is_where_the_wheels_lose_contact(study):
    """Between the last step of the pilot with weight on the wheels and the first without, told to him a frame later."""
    flown = study[103e3]
    (event,) = [event for event in flown.events if event.name == "main gear off the ground"]
    (release,) = [event for event in flown.events if event.name == "brakes released"]
    seen = event.time - release.time
    step, frame = 1.01 / flown.case.pilot_rate, 1.0 / flown.case.rate
    assert seen - step - frame <= flown.at(flown.liftoff, "time") <= seen + 0.01 * step


@pytest.mark.parametrize("mass", [89e3, 124e3])
@pytest.mark.parametrize("rate", [30, 60, 120])
def test_the_step_between_two_frames_hardly_shows(rate, mass):
    """From where he rotates: the pilot is up to a step late, and all comes later by the way the aircraft goes in it.

    So is the attitude law, which runs 30 times a second with 30 frames, and a frame itself: that is the rest, 0.25 %.
    """
    coarse, fine = (fly_take_off(TakeOff(mass, rate=each, pilot_rate=min(each, 120))) for each in (rate, 480))
    for flown in (coarse, fine):
        assert 0.0 <= late(flown) < 1.1 * flown.vr / flown.case.pilot_rate
    for key in ("liftoff_distance_m", "distance_35ft_m", "distance_35m_m"):
        assert row(coarse)[key] - late(coarse) == pytest.approx(
            row(fine)[key] - late(fine), abs=1.5 * coarse.vr / 30
        )


def late(flown):
    """How far after VR the pilot rotated, m."""
    return flown.at(flown.when("phase", "T/O.rotation"), "along") - flown.at(
        flown.at_speed(flown.vr), "along"
    )


def test_wind_slope_heat_and_height_act_as_they_must():
    still = case_row(TakeOff(mass=100e3))["distance_35m_m"]
    assert case_row(TakeOff(mass=100e3, headwind=5.0))["distance_35m_m"] < 0.92 * still
    assert case_row(TakeOff(mass=100e3, headwind=-5.0))["distance_35m_m"] > 1.08 * still
    assert case_row(TakeOff(mass=100e3, slope=0.02))["distance_35m_m"] > still
    assert case_row(TakeOff(mass=100e3, slope=-0.02))["distance_35m_m"] < still
    assert case_row(TakeOff(mass=100e3, isa_deviation=30.0))["distance_35m_m"] > still
    assert case_row(TakeOff(mass=100e3, elevation=1500.0))["distance_35m_m"] > still
    assert case_row(TakeOff(mass=100e3, start="rolling"))["distance_35m_m"] > still
    assert case_row(TakeOff(mass=100e3, heading=2.0))["distance_35m_m"] == pytest.approx(still, rel=1e-3)


def test_the_same_take_off_gives_the_same_row():
    assert case_row(TakeOff(mass=97e3, crosswind=7.0)) == case_row(TakeOff(mass=97e3, crosswind=7.0))


@pytest.mark.parametrize(
    ("case", "said"),
    [
        (TakeOff(60e3), "outside the limits"),
        (TakeOff(150e3), "outside the limits"),
        (TakeOff(100e3, 140.0), "a misprint|1.03 g"),
        (TakeOff(100e3, 30.0), "do not carry"),
        (TakeOff(100e3, flaps="full"), "no flap setting"),
        (TakeOff(100e3, headwind=80.0), "outside what a take-off"),
        (TakeOff(100e3, slope=0.2), "outside what a take-off"),
    ],
)
def test_what_cannot_be_flown_is_refused(case, said):
    with pytest.raises(InputErrors, match=said):
        check(case, read_manual("gta"))


def test_the_command(harness, tmp_path):
    done = harness("takeoff", "--mass", "100t,110t", "--wind", "10kt", "headwind", "--json", "--out", "kept")
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)
    assert [one["mass_kg"] for one in rows] == [100e3, 110e3]
    assert {"vr_mps", "liftoff_distance_m", "distance_35ft_m", "distance_35m_m", "time_35m_s"} <= rows[
        0
    ].keys()
    folder = tmp_path / "kept" / "takeoff-001"
    assert {file.name for file in folder.iterdir()} == {"takeoff.csv", "takeoff.json", "takeoff.png"}
    table = list(csv.DictReader(io.StringIO((folder / "takeoff.csv").read_text())))
    assert [float(line["distance_35m_m"]) for line in table] == [one["distance_35m_m"] for one in rows]
    alone = harness(
        "takeoff", "--mass", "100t,110t", "--wind", "10kt", "headwind", "--json", "--workers", "1"
    )
    assert json.loads(alone.stdout) == rows


@pytest.mark.parametrize(
    "arguments",
    [
        ("--mass", "60t"),
        ("--mass", "100"),
        ("--mass", "90t:80t:1t"),
        ("--mass", "80t:140t:1kg"),
        ("--vr", "140m/s"),
        ("--vr", "62.5"),
        ("--flaps", "full"),
        ("--wind", "10kt", "sideways"),
        ("--wind", "60kt", "headwind"),
        ("--workers", "0"),
    ],
)
def test_bad_input_is_one_clear_message(arguments, capsys):
    from harness.cli import main

    assert main(["takeoff", *arguments]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith(f"harness: {arguments[0]}: ")


def test_an_error_of_a_worker_arrives_whole():
    import pickle

    from harness.errors import OverrunError

    error = OverrunError("left the end", time=3.0, phase="RTO", required="a", achieved="b")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)  # noqa: S301  our own


def test_a_take_off_is_a_case_of_a_study():
    """The mission's own take-off, with the columns that the study was promised."""
    from harness import resources
    from harness.mission.overrides import Override
    from harness.studies import takeoff as kind
    from harness.studies.model import Subject

    file = resources.find_mission("circuit")
    subject = Subject(file.name, file.read_text("utf-8"))
    overrides = [Override("loading/take-off-mass", "110 t", "a study", 1)]
    result = kind.run_case(subject, overrides, 1)
    assert result.keys() == kind.outputs()
    assert result["mass_kg"] == 110e3
    assert result["elevation_m"] == pytest.approx(1470 * 0.3048, abs=1.0)
    assert result["distance_35m_m"] > case_row(TakeOff(mass=110e3))["distance_35m_m"]  # thinner air at Munich
