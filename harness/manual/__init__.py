"""The flight manual: limits, flaps, thrust settings, speeds, gains, phases, configurations and failures of one type.

Its file is aircraft/NAME/flight-manual.xml; another aircraft is another file. A mission may change speeds, gains and
phases for its own flight (`FlightManual.with_mission`).
"""

from harness.manual.model import FlapSetting, FlightManual, PropertySetting, SpeedRule
from harness.manual.reader import read_manual, words_of

__all__ = ["FlapSetting", "FlightManual", "PropertySetting", "SpeedRule", "read_manual", "words_of"]
