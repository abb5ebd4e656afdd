"""The words of the flight manual and the mission: phases, what can be measured, set and selected.

Readers check files against these tables without knowing the pilot; the pilot gives each word its meaning.
"""

from typing import NamedTuple

PHASES: dict[str, str] = {
    "TXY.out": "taxi from the stand to the runway",
    "T/O.run": "accelerate from standstill to rotation speed",
    "T/O.rotation": "raise the nose until the wheels leave the ground",
    "T/O.lift-off": "airborne, up to a positive climb with the gear coming up",
    "T/O.transition": "transition flight to the climb-out speed",
    "DEP": "initial climb: from take-off to clean configuration",
    "ENR.CLB": "climb to the leg's level",
    "ENR.CRS": "level flight",
    "ENR.DES": "descent to the leg's level",
    "APP.intermediate": "acquire the runway course, first flaps",
    "APP.final": "on the glide slope, landing configuration",
    "LDG.flare": "break the descent and touch down",
    "LDG.roll-out": "decelerate to taxi speed",
    "TXY.in": "taxi to the stand",
    "RTO": "rejected take-off: stop on the runway",
    "M/A": "missed approach: climb away",
    "END": "mission complete",
}
"""Every phase of the machine, `group.sub-phase`, in the order of AIAA 2010-7777 Fig. 4."""

EDGES: tuple[tuple[str, str], ...] = (
    ("TXY.out", "T/O.run"),
    ("T/O.run", "RTO"),
    ("T/O.run", "T/O.rotation"),
    ("T/O.rotation", "T/O.lift-off"),
    ("T/O.lift-off", "T/O.transition"),
    ("T/O.transition", "DEP"),
    ("DEP", "ENR.CLB"),
    ("DEP", "ENR.CRS"),
    ("ENR.CLB", "ENR.CRS"),
    ("ENR.CLB", "ENR.DES"),
    ("ENR.CRS", "ENR.CLB"),
    ("ENR.CRS", "ENR.DES"),
    ("ENR.CRS", "APP.intermediate"),
    ("ENR.DES", "ENR.CRS"),
    ("ENR.DES", "ENR.CLB"),
    ("ENR.DES", "APP.intermediate"),
    ("APP.intermediate", "APP.final"),
    ("APP.intermediate", "M/A"),
    ("APP.final", "M/A"),
    ("APP.final", "LDG.flare"),
    ("LDG.flare", "M/A"),
    ("LDG.flare", "LDG.roll-out"),
    ("LDG.roll-out", "TXY.in"),
    ("M/A", "ENR.CLB"),
    ("M/A", "END"),
    ("TXY.in", "END"),
    ("RTO", "END"),
)
"""The edges of the phase graph (Fig. 4, with the sub-phases of Fig. 6 and the RTO and M/A branches)."""

OUTCOMES: dict[str, str] = {
    "TXY.in": "completed",
    "RTO": "rejected take-off",
    "M/A": "missed approach",
}
"""How a flight may end, by the phase that leads to END."""

QUANTITIES: dict[str, str] = {
    "time": "time",
    "time-in-phase": "time",
    "cas": "speed",
    "ground-speed": "speed",
    "mach": "ratio",
    "altitude": "length",
    "height": "length",
    "vertical-speed": "vertical-speed",
    "pitch": "angle",
    "bank": "angle",
    "flap": "ratio",
    "gear": "ratio",
    "propeller-speed": "angular-speed",
    "engines-failed": "count",
    "main-gear-on-ground": "yes-no",
    "nose-gear-on-ground": "yes-no",
    "level-above": "length",
    "level-below": "length",
    "level-captured": "yes-no",
    "speed-error": "speed",
    "waypoints-remaining": "count",
    "distance-to-waypoint": "length",
    "distance-to-threshold": "length",
    "distance-past-threshold": "length",
    "approaches-missed": "count",
    "localizer-captured": "yes-no",
    "localizer-dots": "ratio",
    "glide-slope-dots": "ratio",
    "glide-slope-alive": "yes-no",
    "taxi-distance": "length",
    "heading-error": "angle",
    "centreline-deviation": "length",
}
"""What a condition can look at, with its kind of unit.

`engines-failed` counts those the pilot knows of. `level-above` is how far the wanted level lies above the aircraft,
`level-below` the opposite.
"""

TARGETS: dict[str, str] = {"leg-speed": "speed"}
"""Names a mode's argument can follow besides the speeds of the flight manual."""

SETTINGS: dict[str, str] = {
    "thrust": "thrust-setting",
    "elevator": "ratio",
    "aileron": "ratio",
    "rudder": "ratio",
    "flaps": "flap-setting",
    "gear": "up-down",
    "speedbrake": "ratio",
    "ground-spoilers": "ratio",
    "brakes": "ratio",
    "course": "course",
    "crossfeed": "ratio",
    "ramp": "ratio",
    "release": "load",
    "failed-engines": "shut-down",
}
"""What a procedure step can set, with the kind of value.

A course is `runway`, a load the name of a pallet, failed engines are `shut-down`.
"""

CONTROLS: tuple[str, ...] = ("thrust", "elevator", "aileron", "rudder", "steering")
"""Controls of the CTRL super-mode; each is DIRECT (the pilot's hand) or CONTROLLER."""


INNER_MODES: tuple[str, ...] = ("PM", "RM", "LM")
"""The inner modes: the pilot's pitch, roll and directional loops at work; OFF if none is, as with full fly-by-wire."""


class Argument(NamedTuple):
    """An argument of a sub-mode: its kind of value and the words it accepts."""

    kind: str
    words: tuple[str, ...] = ()


MODES: dict[str, dict[str, dict[str, Argument]]] = {
    "CTRL": {
        "DIRECT": {"control": Argument("word", CONTROLS)},
        "CONTROLLER": {"control": Argument("word", CONTROLS)},
    },
    "INN": {},  # not selected: the inner modes follow from the controls
    "SPD": {
        "OFF": {},
        "THR": {"speed": Argument("speed-target", ("leg-speed", "taxi"))},
        "PITCH": {"speed": Argument("speed-target", ("leg-speed",))},
    },
    "HP": {
        "NAV": {"guidance": Argument("word", ("route", "localizer", "runway", "align", "taxi"))},
        "PATH": {"track": Argument("angle", ("runway", "present"))},
        "ATT": {"bank": Argument("angle")},
    },
    "VP": {
        "NAV": {"guidance": Argument("word", ("level", "glide-slope"))},
        "PATH": {
            "angle": Argument("angle", ("by-speed", "flare")),
            "vertical-speed": Argument("vertical-speed"),
        },
        "ATT": {"pitch": Argument("angle")},
    },
}
"""Super-modes, their sub-modes and the arguments of each (AIAA 2010-7777 Figs. 8 and 9)."""
