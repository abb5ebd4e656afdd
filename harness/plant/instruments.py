"""Instruments: properties of the simulator read into a State, which is renewed in place."""

from collections.abc import Callable, Sequence
from math import inf, isfinite
from operator import call, mul

from harness.state import FIELDS, MOTION, Motion, State

_HEIGHT = FIELDS.index("height")


class Instruments:
    """What the pilot looks at; `state` is what was last seen.

    Each look costs more than the pilot's own step, so there are three: a glance, the motion, and everything.
    """

    def __init__(
        self, getters: Sequence[Callable[[], float]], factors: Sequence[float], standing_height: float
    ) -> None:
        """What gives each of FIELDS, and what one unit of it is in SI.

        `standing_height` is what the height reads, in m, when the wheels carry the aircraft.
        """
        self.state = State(*[0.0] * len(FIELDS))
        self._get = list(getters)
        self._factors = list(factors)
        self._standing_height = standing_height
        self._motion = self._get[: len(MOTION)]
        _, self._vertical_speed, self._pitch, self._cas = self._get[:4]
        _, self._climb_factor, self._pitch_factor, self._cas_factor = self._factors[:4]

    def glance(self, time: float) -> bool:
        """Renew what changes fastest; False when some of it is not finite."""
        vertical_speed = self._vertical_speed() * self._climb_factor
        pitch = self._pitch() * self._pitch_factor
        state = self.state
        state.time = time
        state.vertical_speed = vertical_speed
        state.pitch = pitch
        state.cas = self._cas() * self._cas_factor
        return -inf < vertical_speed + pitch + state.cas < inf

    def look(self, time: float, *, whole: bool) -> bool:
        """Renew the motion, or the whole State; False, and nothing done, when some of it is not finite."""
        numbers = list(map(mul, map(call, self._get if whole else self._motion), self._factors))
        if not -inf < sum(numbers) < inf:
            return False
        numbers[0] = time
        numbers[_HEIGHT] -= self._standing_height
        # The constructor of a dataclass is the fastest way to put many fields.
        if whole:
            State.__init__(self.state, *numbers)
        else:
            Motion.__init__(self.state, *numbers)
        return True

    def lost(self) -> list[str]:
        """The fields that are not finite."""
        return [field for field, get in zip(FIELDS, self._get, strict=True) if not isfinite(get())]
