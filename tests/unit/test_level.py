"""The steadiness of a flight, from logs made so that the right answer is known."""

from math import isnan

import numpy as np
import pytest

from harness.analysis import level
from harness.log import Run
from harness.units import DEG, FT, KT

TIME = np.arange(0.0, 600.0)


def a_run(**changes):
    history = {
        "time": TIME,
        "mode_VP": np.full(600, "NAV level"),
        "mode_SPD": np.full(600, "THR"),
        "cas": np.full(600, 130.0),
        "target_cas": np.full(600, 130.0),
        "target_level": np.full(600, 1524.0),
        "target_level_error": np.zeros(600),
        "command_throttle": np.full(600, 0.6),
        "load_factor": np.full(600, 1.0),
        "roll": np.zeros(600),
    }
    return Run(history | changes, (), (), {}, "")


def swing(amplitude, period):
    return amplitude * np.sin(2 * np.pi * TIME / period)


def test_a_deviation_counts_from_its_capture():
    time = np.arange(0.0, 101.0)
    error = np.where(time < 40, 100.0 - time, 3.0)
    error[60] = -9.0
    found = level.deviation(time, error, tolerance=10.0)
    assert (found.captured, found.largest) == (40.0, 9.0)
    assert found.rms == pytest.approx(np.sqrt((50 * 9 + 81) / 51))


def test_passing_through_the_target_is_no_capture():
    time = np.arange(0.0, 100.0)
    found = level.deviation(time, time - 50, tolerance=3.0)
    assert isnan(found.captured)
    assert isnan(found.largest)


def test_coming_in_is_no_deviation():
    time = np.arange(0.0, 100.0)
    found = level.deviation(time, 100 * np.exp(-time / 5), tolerance=10.0)
    assert found.captured == 12
    assert found.largest < 2.0


def test_leaving_the_target_after_its_capture_is_held_against_the_pilot():
    time = np.arange(0.0, 100.0)
    assert level.deviation(time, np.where(time > 80, 30.0, 0.0), 10.0).largest == 30.0


def test_a_sine_turns_twice_in_each_period_and_noise_does_not():
    time = np.arange(0.0, 600.0, 0.25)
    assert level.reversals(time, 0.1 * np.sin(2 * np.pi * time / 20), 0.02) == pytest.approx(6, abs=0.2)
    assert level.reversals(time, 0.005 * np.sin(2 * np.pi * time / 20), 0.02) == 0.0
    assert level.reversals(time, time / 600, 0.02) == 0.0


def test_each_wanted_speed_is_captured_anew_and_the_level_only_once():
    wanted = np.where(TIME < 300, 130.0, 125.0)
    found = level.level_flight(
        a_run(
            mode_VP=np.where(TIME < 50, "PATH by-speed", "NAV level"),
            target_cas=wanted,
            cas=wanted + np.where((TIME >= 300) & (TIME < 350), 3.0, 0.2),
            target_level_error=np.where(TIME < 60, 40.0, np.where(TIME == 305, 14.0, 2.0)),
        )
    )
    (held,) = found.levels
    assert (held.begin, held.end, held.target) == (50, 599, 1524.0)
    assert (held.deviation.captured, held.deviation.largest) == (60, 14.0)
    first, second = found.speeds
    assert (first.begin, first.end, second.begin, second.target) == (60, 300, 300, 125.0)
    assert (first.deviation.captured, second.deviation.captured) == (60, 350)
    assert second.deviation.largest == pytest.approx(0.2)


def test_a_speed_never_captured_is_not_forgotten():
    (held,) = level.level_flight(a_run(cas=np.full(600, 120.0))).speeds
    assert isnan(held.deviation.captured)


def test_a_speed_wanted_for_less_than_a_minute_is_judged_only_if_captured():
    found = level.level_flight(a_run(target_cas=np.where(TIME > 550, 140.0, 130.0)))
    assert [held.target for held in found.speeds] == [130.0]


def test_a_hunting_lever_shows():
    found = level.level_flight(a_run(command_throttle=0.6 + swing(0.05, 30.0)))
    assert found.lever_reversals == pytest.approx(4.0, abs=0.2)
    assert found.lever_swing == pytest.approx(0.1, rel=0.2)
    assert found.level_swing == 0.0


def test_a_slow_trend_is_no_swing():
    found = level.level_flight(a_run(command_throttle=0.6 - TIME * 1e-4))
    assert found.lever_swing == pytest.approx(0.0, abs=1e-9)


def test_a_level_and_a_speed_that_swing_in_their_bands_show():
    found = level.level_flight(
        a_run(target_level_error=swing(20 * FT, 40.0), cas=130.0 + swing(1 * KT, 40.0))
    )
    assert found.level_swing == pytest.approx(40 * FT, rel=0.2)
    assert found.cas_swing == pytest.approx(2 * KT, rel=0.2)


def test_a_turn_and_the_minute_after_it_are_not_steady():
    disturbed = np.where((TIME > 300) & (TIME < 340), swing(20 * FT, 40.0), 0.0)
    turning = np.where((TIME > 290) & (TIME < 330), 25 * DEG, 0.0)
    assert level.level_flight(a_run(target_level_error=disturbed, roll=turning)).level_swing == 0.0


def test_a_limit_cycle_in_a_climb_shows_and_its_beginning_does_not():
    climb = {"mode_VP": np.full(600, "PATH by-speed"), "mode_SPD": np.full(600, "PITCH")}
    pull_up = np.where(TIME < 15, 1.2, 1.0)
    assert level.climb_swing(a_run(load_factor=pull_up, **climb)) == 0.0
    assert level.climb_swing(a_run(load_factor=1 + swing(0.14, 11.0), **climb)) == pytest.approx(
        0.28, rel=0.05
    )
    assert isnan(level.climb_swing(a_run()))


def test_too_little_level_flight_to_tell_is_not_called_steady():
    short = level.level_flight(a_run(mode_VP=np.where(TIME < 50, "NAV level", "PATH by-speed")))
    assert isnan(short.lever_swing)
    assert isnan(short.lever_reversals)
