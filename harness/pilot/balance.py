"""Watches the centre of gravity in flight: fuel leaks, tanks empty unevenly, loads move and leave."""

from math import inf

from harness.loading.envelope import Envelope, percent
from harness.state import State

LOOK_AGAIN = 0.01  # m: the centre of gravity is judged anew when it has moved this far


class BalanceWatch:
    """Tells when the centre of gravity leaves its limits along the aircraft, and when it is back."""

    def __init__(self, limits: Envelope | None) -> None:
        self._limits = limits
        self._seen = inf
        self._outside = False

    def change(self, state: State) -> str:
        """What has changed, in words; empty if nothing."""
        if self._limits is None or abs(state.centre_of_gravity - self._seen) < LOOK_AGAIN:
            return ""
        self._seen = state.centre_of_gravity
        share, (forward, aft) = self._limits.share(self._seen), self._limits.limits(state.mass)
        outside, self._outside = self._outside, not forward <= share <= aft
        if outside == self._outside:
            return ""
        return f"{percent(share)}, {'outside' if self._outside else 'inside'} {percent(forward)} to {percent(aft)}"
