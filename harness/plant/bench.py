"""A test bench: the aircraft alone, put anywhere in the air or on the ground, without mission and pilot.

The bench speaks SI and radians. Quantities are the fields of State and those of `MORE`; the aircraft's own
properties are read and written by their names.
"""

from collections.abc import Callable, Iterable
from math import atan2, cos, sin, sqrt
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from harness.errors import InputError
from harness.loading.aircraft import read_stowage
from harness.plant.hangar import Sort, load
from harness.plant.jsbsim_plant import GROUND_TRIM, INTEGRATORS, STANDING_HEIGHT
from harness.plant.properties import STATE, THROTTLES, Binding
from harness.state import FIELDS
from harness.units import FT, LB
from harness.world.atmosphere import GRAVITY, geometric

LBF = LB * GRAVITY
ENGINES = len(THROTTLES)
WHEELS = 14
CLOSE = 0.5  # m of pressure altitude
RUN_UP = 60.0  # s at most until engines that start in the air are steady
STEADY = 2e-4  # relative change of propeller speed and thrust within half a second
USUAL_FUEL = 10_000.0  # kg
DEEP = -1000.0  # m: the ground below an aircraft placed in the air, out of ground effect at sea level
PAYLOAD = 37_000.0  # kg; beyond it a mass is made with fuel

MORE = {
    "latitude": Binding("position/lat-geod-rad"),
    "elevator": Binding("fcs/elevator-pos-rad"),
    "aileron": Binding("fcs/aileron-pos-rad"),
    "rudder": Binding("fcs/rudder-pos-rad"),
    "forward acceleration": Binding("accelerations/udot-ft_sec2", FT),
    "side acceleration": Binding("accelerations/vdot-ft_sec2", FT),
    "downward acceleration": Binding("accelerations/wdot-ft_sec2", FT),
    "roll acceleration": Binding("accelerations/pdot-rad_sec2"),
    "pitch acceleration": Binding("accelerations/qdot-rad_sec2"),
    "yaw acceleration": Binding("accelerations/rdot-rad_sec2"),
    "distance": Binding("position/distance-from-start-mag-mt"),
    "ground speed": Binding("velocities/vg-fps", FT),
    "power": Binding("propulsion/engine-power-kw[0]", 1000.0),
    "propeller rpm": Binding("propulsion/engine[0]/propeller-rpm"),
    "heading rate": Binding("velocities/psidot-rad_sec"),
}
QUANTITIES: dict[str, Binding] = {**dict(zip(FIELDS, STATE, strict=True)), **MORE}

Record = dict[str, NDArray[np.float64]]
"""A time history: `time` from the start of the recording in s, and the quantities recorded."""


class Attitude(NamedTuple):
    """How the aircraft meets the air, rad, and its true airspeed in m/s."""

    tas: float
    alpha: float = 0.0
    beta: float = 0.0
    path: float = 0.0  # flight path angle, up
    bank: float = 0.0

    @property
    def pitch(self) -> float:
        """The pitch attitude of a steady path. Source: Stevens and Lewis, eq. 3.6-3 (rate-of-climb constraint)."""
        a = cos(self.alpha) * cos(self.beta)
        b = sin(self.bank) * sin(self.beta) + cos(self.bank) * sin(self.alpha) * cos(self.beta)
        s = sin(self.path)
        return atan2(a * b + s * sqrt(max(0.0, a * a - s * s + b * b)), a * a - s * s)


class Bench:
    """One aircraft and one simulator, for one test."""

    def __init__(self, root: Path, aircraft: str, *, rate: int = 120) -> None:
        self.rate = rate
        self._fdm = load(Sort(root, aircraft, rate))
        self._stowage = read_stowage(root / "aircraft" / aircraft / f"{aircraft}.xml")
        self._manager = self._fdm.get_property_manager()
        self._getters: dict[str, Callable[[], float]] = {}
        self._time = 0.0

    def has(self, name: str) -> bool:
        """Whether the aircraft has this property."""
        return self._manager.get_node(name) is not None

    def get(self, name: str) -> float:
        """A property, in its own unit. Raises InputError when there is none of this name."""
        getter = self._getters.get(name)
        if getter is None:
            node = self._manager.get_node(name)
            if node is None:
                raise InputError(
                    f"the aircraft has no property {name}", remedy="systems/ shows how the others provide it"
                )
            getter = self._getters[name] = node.get_double_value
        return getter()

    def put(self, name: str, value: float) -> None:
        """Write a property. Raises InputError when there is none of this name."""
        self.get(name)
        self._fdm[name] = value

    def put_all(self, name: str, value: float, count: int = ENGINES) -> None:
        """Write the properties NAME[0], NAME[1], ..."""
        for i in range(count):
            self.put(f"{name}[{i}]", value)

    def __getitem__(self, quantity: str) -> float:
        binding = QUANTITIES[quantity]
        return self.get(binding.name) * binding.factor

    def levers(self, position: float) -> Self:
        """All thrust levers: -1 full reverse .. 0 idle .. 1 take-off."""
        self.put_all("fcs/throttle-cmd-norm", position)
        return self

    def configure(self, *, flap: float, gear: float) -> None:
        """Flaps and gear at once where they are wanted."""
        for name, value in (("fcs/flap", flap), ("gear/gear", gear)):
            self.put(f"{name}-cmd-norm", value)
            self.put(f"{name}-pos-norm", value)

    def day(self, isa_deviation: float) -> None:
        """The deviation of the temperature from ISA, K. Before the aircraft is placed."""
        self.put("atmosphere/delta-T", isa_deviation * 1.8)

    def load(self, mass: float, fuel: float | None = None) -> None:
        """Fuel by filling order, the rest as payload in the hold; the mass is that of the aircraft, kg."""
        empty = self.get("inertia/empty-weight-lbs") * LB
        if fuel is None:
            fuel = min(max(USUAL_FUEL, mass - empty - PAYLOAD), mass - empty)
        for i, tank in enumerate(self._stowage.fuel(fuel)):
            self.put(f"propulsion/tank[{i}]/contents-lbs", tank.mass / LB)
        self.put("inertia/pointmass-weight-lbs[0]", (mass - empty - fuel) / LB)

    def place(self, altitude: float, attitude: Attitude, heading: float = 0.0) -> None:
        """Put the aircraft at a pressure altitude (m) in still air; engines and systems stay as they are."""
        flow = attitude
        for name, value in (
            ("terrain-elevation-ft", DEEP / FT),
            ("lat-geod-deg", 50.0),
            ("long-gc-deg", 8.0),
            ("h-sl-ft", geometric(altitude) / FT),
            ("psi-true-rad", heading),
            ("phi-rad", flow.bank),
            ("theta-rad", flow.pitch),
            ("u-fps", flow.tas * cos(flow.alpha) * cos(flow.beta) / FT),
            ("v-fps", flow.tas * sin(flow.beta) / FT),
            ("w-fps", flow.tas * sin(flow.alpha) * cos(flow.beta) / FT),
        ):
            self.put(f"ic/{name}", value)
        self.initialise()
        height = geometric(altitude)
        for _ in range(3):  # on a warm day a pressure altitude is higher up
            error = altitude - self["pressure_altitude"]
            if abs(error) < CLOSE:
                break
            height += error
            self.put("ic/h-sl-ft", height / FT)
            self.initialise()

    def park(self, *, speed: float = 0.0) -> None:
        """Stand on a runway at sea level that points north, or roll along it at `speed` m/s; brakes on."""
        self.put("ic/lat-geod-deg", 50.0)
        self.put("ic/long-gc-deg", 8.0)
        self.put("ic/h-agl-ft", STANDING_HEIGHT / FT)
        self.put("ic/u-fps", speed / FT)
        self.initialise()
        self.put("simulation/do_simple_trim", GROUND_TRIM)
        self.put_all("gear/wheel-speed-mps", speed, WHEELS)
        self.brakes(1.0)
        self.move(True)

    def brakes(self, pressed: float) -> None:
        """Both brake pedals, 0..1."""
        for side in ("left", "right"):
            self.put(f"fcs/{side}-brake-cmd-norm", pressed)

    def move(self, moving: bool) -> None:
        """Let the aircraft fly, or hold it still in moving air while engines and systems run."""
        for name, kind in INTEGRATORS.items():
            self.put(name, kind if moving else 0.0)

    def run_up(self) -> None:
        """Engines from wherever they are to steady running at their levers, the aircraft held still."""
        self.move(False)
        for i in range(ENGINES):
            if self.get(f"propulsion/engine-run[{i}]") > 0 and self.has(f"propulsion/core-norm[{i}]"):
                self.put(f"propulsion/core-norm[{i}]", 1.0)
                if self.get(f"propulsion/engine[{i}]/propeller-rpm") < 100:
                    self.put(f"fadec/blade-angle-deg[{i}]", 30.0)
                    self.put(f"fadec/governor-integral-deg[{i}]", 30.0)
        before = (0.0, 0.0)
        for _ in range(int(RUN_UP * 2)):
            self.run(0.5)
            now = (self["propeller rpm"], self["thrust"])
            if all(abs(a - b) <= STEADY * abs(a) for a, b in zip(now, before, strict=True)):
                return
            before = now

    def fail(self, engine: int) -> None:
        """Flame an engine out. Its propeller feathers by the aircraft's own logic."""
        name = f"failure/engine[{engine}]"
        if self.has(name):
            self.put(name, 1.0)
        else:
            self.put(f"propulsion/engine-run[{engine}]", 0.0)

    def run(self, seconds: float) -> None:
        """Run frames."""
        run = self._fdm.run
        for _ in range(round(seconds * self.rate)):
            run()

    def record(
        self,
        seconds: float,
        quantities: Iterable[str],
        *,
        steps: int = 5,
        pilot: Callable[[float], None] | None = None,
        until: Callable[[], bool] | None = None,
    ) -> Record:
        """Fly, calling `pilot(time)` before and recording after every `steps` frames, for `seconds` or `until`.

        Quantities are names of QUANTITIES or properties of the aircraft.
        """
        bindings = [(name, QUANTITIES.get(name, Binding(name))) for name in quantities]
        rows = [[0.0, *(self.get(binding.name) * binding.factor for _, binding in bindings)]]
        run = self._fdm.run
        for step in range(1, round(seconds * self.rate / steps) + 1):
            if pilot is not None:
                pilot((step - 1) * steps / self.rate)
            for _ in range(steps):
                run()
            rows.append([step * steps / self.rate, *(self.get(b.name) * b.factor for _, b in bindings)])
            if until is not None and until():
                break
        table = np.array(rows)
        if not np.isfinite(table).all():
            raise ArithmeticError("the state of the aircraft is no longer finite")
        return {name: table[:, i] for i, name in enumerate(("time", *(name for name, _ in bindings)))}

    def initialise(self) -> None:
        """Take the motion from the initial conditions; engines and systems stay as they are."""
        if not self._fdm.run_ic():
            raise InputError("JSBSim could not set the initial conditions")
