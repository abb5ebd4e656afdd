"""The way back after a missed approach: a left-hand circuit to the same runway."""

from math import pi

from harness.mission.model import Fix, Leg
from harness.navigation.database import Runway
from harness.units import FT, Level, Speed
from harness.world import earth

HEIGHT = 1500 * FT  # above the runway, usual for a circuit
CORNERS = (  # metres past the threshold and left of the centreline; two turns of 25 deg bank fit between the sides
    ("go-around upwind", 6000.0, 0.0),
    ("go-around crosswind", 6000.0, 5000.0),
    ("go-around downwind", -12500.0, 5000.0),
    ("go-around base", -12500.0, 0.0),
)


def circuit(runway: Runway, cas: float) -> tuple[Leg, ...]:
    """The legs from the runway round to its extended centreline, at `cas` m/s."""
    level = Level("ALT", runway.elevation + HEIGHT)
    return tuple(
        Leg(name, _fix(runway, along, left), "direct", None, Speed("CAS", cas), level, "fly-by", (), 1)
        for name, along, left in CORNERS
    )


def _fix(runway: Runway, along: float, left: float) -> Fix:
    latitude, longitude = earth.direct(runway.latitude, runway.longitude, runway.true_heading, along)
    return Fix(*earth.direct(latitude, longitude, runway.true_heading - 0.5 * pi, left))
