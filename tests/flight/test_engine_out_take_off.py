"""From the feet to the air law: at lift-off with an engine failed the rudder goes on where it stands."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from harness.flight import fly
from harness.log import Reporter
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.state import Commands, State
from harness.takeoff.case import Happening, TakeOff
from harness.takeoff.flight import prepared
from harness.units import DEG

CLEAR = 60.0  # m


@dataclass
class Rudder:
    """Height, rudder, yaw rate and roll at each step of the pilot, m and degrees."""

    plant: JSBSimPlant
    rows: list[tuple[float, float, float, float]] = field(default_factory=list)
    down: list[bool] = field(default_factory=list)

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        self.down.append(state.main_on_ground > 0.5)
        rudder = self.plant.fdm["fcs/rudder-pos-rad"]
        self.rows.append((state.height, rudder / DEG, state.yaw_rate / DEG, state.roll / DEG))

    def note(self, event: object) -> None:
        pass


@pytest.mark.parametrize(("mass", "vr"), [(90e3, 65.0), (124e3, 70.0)])
def test_the_rudder_goes_on_where_the_feet_had_it(mass, vr):
    pilot, plant, _ = prepared(TakeOff(mass, vr), Happening(vef=vr - 4.0, v2=vr + 3.0))
    seen = Rudder(plant)
    fly(pilot, plant, observers=(seen,), time_limit=120.0, until=lambda state: state.height > CLEAR)
    _, rudder, yaw_rate, roll = np.array(seen.rows).T
    lift_off = int(np.flatnonzero(seen.down)[-1])
    assert rudder[lift_off] < -5.0, "against the engine that failed on the left"
    # A step is 42 ms: the actuator at its limit does 1.7 deg.
    assert abs(np.diff(rudder[lift_off - 2 :])).max() < 1.0
    assert abs(yaw_rate[lift_off:]).max() < 3.0
    assert abs(roll[lift_off:]).max() < 5.0
