"""How the aircraft stands by statics, against JSBSim's own trim on the ground."""

import pytest

from harness.plant.jsbsim_plant import GROUND_TRIM
from harness.takeoff.case import TakeOff
from harness.takeoff.flight import prepared
from harness.units import FT


@pytest.mark.parametrize("mass", [82e3, 110e3, 141e3])
def test_statics_agree_with_the_trim(mass, monkeypatch):
    monkeypatch.setattr("harness.takeoff.flight.lined_up", lambda *_: ({}, {}))  # no thrust
    _, plant, _ = prepared(TakeOff(mass, vr=None))
    fdm = plant.fdm
    height, pitch = fdm["position/h-agl-ft"] * FT, fdm["attitude/theta-rad"]
    fdm["simulation/do_simple_trim"] = GROUND_TRIM
    assert height == pytest.approx(fdm["position/h-agl-ft"] * FT, abs=5e-4)
    assert pitch == pytest.approx(fdm["attitude/theta-rad"], abs=1e-4)


def test_the_springs_are_those_of_the_ground_reactions(repository):
    text = (repository / "aircraft/gta/ground-reactions.xml").read_text("utf-8")
    _, plant, _ = prepared(TakeOff(100e3))
    nose, main = (plant.fdm[f"gear/{leg}-stiffness-npm"] for leg in ("nose", "main"))
    assert f'<spring_coeff unit="N/M"> {nose:.0f} </spring_coeff>' in text
    pound_per_foot = 4.4482216 / FT
    assert main == pytest.approx(6 * 45224.4 * pound_per_foot, rel=1e-4)
    assert text.count("<value>45224.4</value>") == 6
