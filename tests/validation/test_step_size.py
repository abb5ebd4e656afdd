"""The flight does not depend on the step of the simulation: 120, 240 and 480 frames a second fly the same."""

from itertools import zip_longest

import pytest

DECISIONS = {"phase", "checklist", "procedure", "mode", "waypoint"}

pytestmark = [pytest.mark.slow, pytest.mark.timeout(900)]


@pytest.fixture(scope="module")
def coarse(fly):
    return fly("cologne-munich").run


@pytest.fixture(scope="module", params=[240, 480])
def fine(fly, request):
    return fly("cologne-munich", rate=request.param).run


def decisions(run):
    return [(event.kind, event.name, event.phase) for event in run.events if event.kind in DECISIONS]


def wp12(run):
    return next(passage for passage in run.passages if passage.name == "WP12")


def test_the_same_things_happen_in_the_same_order(coarse, fine):
    pairs = zip_longest(decisions(coarse), decisions(fine))
    assert next((pair for pair in pairs if pair[0] != pair[1]), None) is None


def test_wp12_is_reached_within_a_second(coarse, fine):
    release, fine_release = (run.summary["brake_release_s"] for run in (coarse, fine))
    assert wp12(fine).time - fine_release == pytest.approx(wp12(coarse).time - release, abs=1.0)


def test_the_fuel_agrees_within_two_thousandths(coarse, fine):
    assert wp12(fine).fuel_used == pytest.approx(wp12(coarse).fuel_used, rel=0.002)
    assert fine.summary["fuel_burned_kg"] == pytest.approx(coarse.summary["fuel_burned_kg"], rel=0.002)
