"""Steps a JSBSim script, as the `jsbsim` command does, and reads what any aircraft has."""

import re
from collections.abc import Callable, Sequence
from math import isfinite, nan
from pathlib import Path
from time import monotonic
from typing import NamedTuple

import jsbsim
import numpy as np

from harness.errors import FlightError, InputError, NumericalError, TimeLimitError, did_you_mean
from harness.log import Event
from harness.log.run import History
from harness.plant.messages import Messages
from harness.plant.properties import STATE, Binding
from harness.state import FIELDS
from harness.units import FT, G0, LB

MOST_ROWS = 40_000  # of the time history: beyond, every second row is dropped and the interval doubled
LOOK = 256  # frames between two looks at the clock and at whether the state is finite
MOST_ENGINES = 12

_ANY_AIRCRAFT = {
    # What our aircraft publishes themselves, in JSBSim's own properties.
    "height": Binding("position/h-agl-ft", FT),
    "mass": Binding("inertia/weight-lbs", LB),
    "fuel": Binding("propulsion/total-fuel-lbs", LB),
    "main_on_ground": Binding("gear/wow"),
    "command_elevator": Binding("fcs/elevator-cmd-norm"),
    "command_aileron": Binding("fcs/aileron-cmd-norm"),
    "command_rudder": Binding("fcs/rudder-cmd-norm"),
    "command_throttle": Binding("fcs/throttle-cmd-norm"),
    "command_flap": Binding("fcs/flap-cmd-norm"),
    "command_brake": Binding("fcs/left-brake-cmd-norm"),
}
_COLUMNS = dict(zip(FIELDS, STATE, strict=True)) | _ANY_AIRCRAFT
POSITION_AND_ATTITUDE = ("latitude", "longitude", "altitude", "roll", "pitch", "heading")
_LOCATED = re.compile(r"(?:In file )?(/.+?):(?: line )?(\d+):?\s+(.*)", re.DOTALL)
_NOTICE = re.compile(r"(?P<name>.*?) \(Event \d+\) executed at time: (?P<time>\S+)(?P<rest>.*)", re.DOTALL)


class Playback(NamedTuple):
    """A script as it was played, and what stopped it early, if anything did.

    `end` maps JSBSim's properties of position, speed and attitude to their last values.
    """

    aircraft: str
    dt: float
    frames: int
    history: History
    events: tuple[Event, ...]
    end: dict[str, float]
    stopped: FlightError | None


class Order(NamedTuple):
    """What to play. Times in seconds; `dt` 0 obeys the script's own step; `root` is the JSBSim root.

    `at` are the frames to keep in the history, instead of every `interval` seconds; `limit` is wall time.
    """

    root: Path
    script: Path
    outputs: Path
    dt: float
    end: float
    limit: float
    settings: tuple[tuple[str, float], ...]
    at: tuple[int, ...]
    interval: float


def play(order: Order) -> Playback:
    """Play a script to its end.

    Raises InputError when JSBSim refuses it. A state that is no longer finite and the limit stop it. A few wrong inputs
    make JSBSim abort the whole process: call it in one that may die.
    """
    messages = _Notices()
    fdm = _load(order, messages)
    _set(fdm, order.settings)
    fdm.run_ic()
    requested = fdm.get_ic().trim_requested()
    if requested != jsbsim.TrimMode.NONE:
        jsbsim.FGTrim(fdm, requested).do_trim()
    record = _Record(fdm, order)
    stopped = _step(fdm, order, record)
    return Playback(
        aircraft=Path(fdm.get_full_aircraft_path()).name,
        dt=fdm.get_delta_t(),
        frames=record.frames,
        history=record.history(),
        events=tuple(messages.events),
        end={name: fdm.get_property_value(name) for name in END if fdm.get_property_manager().hasNode(name)},
        stopped=stopped,
    )


END = tuple(
    binding.name
    for field, binding in _COLUMNS.items()
    if field
    in (
        *POSITION_AND_ATTITUDE,
        "tas",
        "roll_rate",
        "pitch_rate",
        "yaw_rate",
        "vertical_speed",
        "mass",
        "fuel",
    )
)


def _load(order: Order, messages: "_Notices") -> jsbsim.FGFDMExec:
    jsbsim.set_logger(messages)
    fdm = jsbsim.FGFDMExec(str(order.root))
    fdm.set_debug_level(0)
    fdm.set_output_path(str(order.outputs))
    try:
        loaded = fdm.load_script(str(order.script), order.dt)
    except jsbsim.BaseError as error:
        raise _refused(str(error)) from error
    if not loaded:
        raise _refused("\n    ".join(messages.serious) or "no reason given")
    if fdm.get_delta_t() <= 0:
        raise InputError("the script has no step", file=order.script, remedy="give one: --rate 120")
    return fdm


def _refused(said: str) -> InputError:
    """What JSBSim said, as file, line and message where it gives them."""
    found = _LOCATED.match(said.strip())
    what = "JSBSim refuses the script"
    if found:
        return InputError(f"{what}: {' '.join(found[3].split())}", file=found[1], line=int(found[2]))
    return InputError(f"{what}: {said.strip()}")


def _set(fdm: jsbsim.FGFDMExec, settings: Sequence[tuple[str, float]]) -> None:
    manager = fdm.get_property_manager()
    for name, value in settings:
        node = manager.get_node(name)
        if node is None:
            known = [entry.split(" ")[0] for entry in fdm.query_property_catalog("").splitlines()]
            raise InputError(
                f"this aircraft has no property {name}",
                file=f"--set {name}",
                remedy=did_you_mean(name, known),
            )
        if not node.get_attribute(jsbsim.Attribute.WRITE):
            raise InputError(f"property {name} cannot be written", file=f"--set {name}")
        node.set_double_value(value)


def _step(fdm: jsbsim.FGFDMExec, order: Order, record: "_Record") -> FlightError | None:
    """Run to the end, as the `jsbsim` command does; return what stopped it before."""
    run, now = fdm.run, fdm.get_sim_time
    latest = monotonic() + order.limit
    frames = 0
    going = True
    while going and now() <= order.end:
        try:
            going = run()
        except jsbsim.BaseError as error:
            return FlightError(f"JSBSim stopped: {str(error).strip()}", time=now(), phase="script")
        frames += 1
        if frames == record.due:
            record.take(frames)
        if frames % LOOK == 0 and (not record.finite() or monotonic() > latest):
            break
    record.take(frames)
    if not record.finite():
        return NumericalError(
            "the state of the aircraft is no longer finite",
            time=now(),
            phase="script",
            knob="look at the last rows of the time history",
        )
    if going and now() <= order.end:
        return TimeLimitError(
            f"the script has not ended after {order.limit:.0f} s of computing",
            time=now(),
            phase="script",
            knob="end it sooner: --end SECONDS; or wait longer: --limit SECONDS",
        )
    return None


class _Record:
    """The columns of the history that this aircraft has."""

    def __init__(self, fdm: jsbsim.FGFDMExec, order: Order) -> None:
        manager = fdm.get_property_manager()
        self._dt = fdm.get_delta_t()
        self._every = max(round(order.interval / self._dt), 1)
        self._at = iter(order.at) if order.at else None
        self._readings: dict[str, tuple[Callable[[], float], float]] = {}
        for field, binding in _COLUMNS.items():
            node = manager.get_node(binding.name)
            if node is not None and field != "time":
                self._readings[field] = (node.get_double_value, binding.factor)
        self._sum(manager, "thrust", "propulsion/engine[{}]/thrust-lbs", LB * G0)
        self._sum(manager, "fuel_flow", "propulsion/engine[{}]/fuel-flow-rate-pps", LB)
        self._height = self._readings["altitude"][0]
        self._speed = self._readings["tas"][0]
        self._rows: list[tuple[float, ...]] = []
        self.due = 0
        self.frames = 0
        self.take(0)

    def _sum(self, manager: jsbsim.FGPropertyManager, field: str, name: str, factor: float) -> None:
        """A column that is the sum over the engines, where the aircraft itself publishes none."""
        nodes = [manager.get_node(name.format(engine)) for engine in range(MOST_ENGINES)]
        getters = [node.get_double_value for node in nodes if node is not None]
        if field not in self._readings and getters:
            self._readings[field] = (lambda: sum(get() for get in getters), factor)

    def take(self, frame: int) -> None:
        """Record this frame, and say which is next."""
        self.frames = frame
        time = frame * self._dt
        if not self._rows or self._rows[-1][0] != time:
            self._rows.append((time, *(get() * factor for get, factor in self._readings.values())))
        if self._at is not None:
            self.due = next((at for at in self._at if at > frame), 0)
            return
        if len(self._rows) > MOST_ROWS:
            del self._rows[1::2]
            self._every *= 2
        self.due = frame + self._every - frame % self._every

    def finite(self) -> bool:
        """Whether height and speed are numbers."""
        return isfinite(self._height() + self._speed())

    def history(self) -> History:
        """The columns; what was never finite is left out."""
        columns = np.array(self._rows, dtype=float).T
        named = dict(zip(("time", *self._readings), columns, strict=True))
        return {name: column.copy() for name, column in named.items() if np.isfinite(column).any()}


class _Notices(Messages):
    """Keeps what the events of a script notify, beside what JSBSim warns of."""

    def __init__(self) -> None:
        super().__init__()
        self.events: list[Event] = []

    def flush(self) -> None:
        """End the message."""
        found = _NOTICE.search(self._text.strip())
        if found:
            values = "; ".join(line.strip() for line in found["rest"].splitlines() if line.strip())
            time = float(found["time"]) if _number(found["time"]) else nan
            self.events.append(
                Event(time, "script", " ".join(found["name"].split()), "script", detail=values)
            )
            self._text = ""
        super().flush()


def _number(text: str) -> bool:
    return re.fullmatch(r"[-+0-9.eE]+", text) is not None
