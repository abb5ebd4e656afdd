"""A test pilot's hands: small loops on stick, pedals and levers, or on the aircraft's attitude hold."""

from math import pi

from harness.plant.bench import Bench
from harness.plant.trim import Trim

PITCH_PER_SPEED = 0.015  # rad per m/s: 15 s to the speed wanted, as steep as g sin(theta) makes it
PITCH_INTEGRAL = 0.0015  # rad per m/s and s
STICK_PER_PITCH = 6.0  # 1/rad
STICK_PER_RATE = 3.0  # s
STICK_INTEGRAL = 4.0  # 1/(rad s)
PEDAL_PER_HEADING = 8.0  # 1/rad
PEDAL_PER_RATE = 6.0  # s
PEDAL_INTEGRAL = 4.0  # 1/(rad s)


class Helm:
    """Holds a speed (which may change steadily) by pitch, and wings level or banked, from a trimmed condition on."""

    def __init__(
        self, bench: Bench, balanced: Trim, *, cas: float, rate: float = 0.0, bank: float = 0.0
    ) -> None:
        """`rate` is the change of speed wanted, m/s2; `bank` is held by the aircraft's roll loop, rad."""
        self._bench = bench
        self._trim = balanced
        self._cas = cas
        self._rate = rate
        self._integral = 0.0
        self._stick = 0.0
        self._pedal = 0.0
        self._heading = bench["heading"]
        self._last = 0.0
        bench.put("ap/roll-mode", 1.0)
        bench.put("ap/bank-target-rad", bank)
        bench.put("ap/yaw-mode", 1.0)

    def hold_speed(self, time: float) -> None:
        """Fly the speed with the aircraft's pitch hold."""
        self._bench.put("fcs/law", 0.0)
        self._bench.put("fcs/law", 0.0)
        self._bench.put("ap/pitch-mode", 1.0)
        self._bench.put("ap/pitch-target-rad", self._pitch(time))

    def hold_speed_by_stick(self, time: float) -> None:
        """Fly the speed with the elevator itself: nothing stops the nose short of the stall."""
        bench, step = self._bench, time - self._last
        error = self._pitch(time) - bench["pitch"]
        self._stick = min(1.0, max(-1.0, self._stick + STICK_INTEGRAL * error * step))
        stick = (
            self._trim.controls["elevator"] - STICK_PER_PITCH * error + STICK_PER_RATE * bench["pitch_rate"]
        )
        bench.put("fcs/elevator-cmd-norm", min(1.0, max(-1.0, stick - self._stick)))

    def hold_heading_by_pedals(self, step: float) -> None:
        """Keep the heading with the rudder alone; `step` is the time since the last call, s."""
        bench = self._bench
        bench.put("ap/yaw-mode", 0.0)
        error = (bench["heading"] - self._heading + pi) % (2 * pi) - pi
        pedal = (
            self._trim.controls["rudder"] - PEDAL_PER_HEADING * error - PEDAL_PER_RATE * bench["heading rate"]
        )
        if abs(pedal - self._pedal) < 1.0:
            self._pedal += PEDAL_INTEGRAL * error * step
        bench.put("fcs/rudder-cmd-norm", min(1.0, max(-1.0, pedal - self._pedal)))

    def _pitch(self, time: float) -> float:
        """The pitch attitude that brings the speed wanted."""
        step, self._last = time - self._last, time
        error = self._bench["cas"] - (self._cas + self._rate * time)
        self._integral += PITCH_INTEGRAL * error * step
        return self._trim.attitude.pitch + PITCH_PER_SPEED * error + self._integral
