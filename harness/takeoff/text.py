"""Cards and fields as data and as text."""

from math import isnan
from typing import Any

from harness.takeoff.card import Card
from harness.takeoff.field import Field
from harness.takeoff.greatest import Greatest
from harness.takeoff.runway import FREEZING, Site
from harness.units import KT
from harness.world.atmosphere import temperature


def _known(value: object) -> object:
    """What is not a number is null in JSON."""
    return None if isinstance(value, float) and isnan(value) else value


def field_data(field: Field) -> dict[str, Any]:
    """A field as flat JSON: speeds in m/s CAS, distances in m; what is not a number is null."""
    data: dict[str, Any] = {}
    for name, value in field._asdict().items():
        nested = value._asdict() if hasattr(value, "_asdict") else None
        if nested is None:
            data[name] = value
        else:
            data |= {
                f"{name.removesuffix('s')}_{key}" if name == "gradients" else key: one
                for key, one in nested.items()
            }
    return {name: _known(value) for name, value in data.items()}


def field_text(row: dict[str, Any]) -> str:
    """One mass in a few lines."""

    def knots(name: str) -> str:
        return "-" if row[name] is None else f"{row[name] / KT:.1f}"

    speeds = "  ".join(f"{title} {knots(name)}" for title, name in SPEEDS)
    return "\n".join(
        (
            f"{row['mass_kg'] / 1e3:.1f} t   kt CAS: {speeds}   V1 set by {row['v1_set_by']}",
            f"  take-off run {row['take_off_run']:.0f} m, take-off distance {row['take_off_distance']:.0f} m",
            f"  accelerate-stop {row['accelerate_stop']:.0f} m (with reverse {row['accelerate_stop_reverse']:.0f} m)",
            f"  engine failed: to the screen {row['accelerate_go_oei']:.0f} m, stop {row['accelerate_stop_oei']:.0f} m",
            f"  engine failed: first segment {row['gradient_first']:.1%}, second {row['gradient_second']:.1%}",
            *told(row),
        )
    )


def told(row: dict[str, Any]) -> list[str]:
    """What there is to say about the speeds and the distances."""
    lines = [f"  VMCA -: {row['vmca_told']}"] if row["vmca_told"] else []
    if row["dry_v1"] is not None:
        lines.append(
            f"  never below those of the dry runway, V1 {row['dry_v1'] / KT:.1f} kt: "
            f"take-off distance {row['dry_take_off_distance']:.0f} m, "
            f"accelerate-stop {row['dry_accelerate_stop']:.0f} m"
        )
    return lines


SPEEDS = (
    ("VS", "vs"),
    ("VMCG", "vmcg"),
    ("VMCA", "vmca"),
    ("V1", "v1"),
    ("VR", "vr"),
    ("VLOF", "vlof"),
    ("V2", "v2"),
)


def card_data(card: Card, site: Site, greatest: Greatest | None = None) -> dict[str, Any]:
    """The card as JSON; without a search the greatest mass and what sets it are null."""
    case = card.case
    return {
        "possible": card.met,
        "runway": {
            "name": site.name,
            "tora_m": site.available.run,
            "toda_m": site.available.distance,
            "asda_m": site.available.stop,
            "elevation_m": site.elevation,
            "slope": site.slope,
            "surface": case.surface,
        },
        "mass_kg": case.mass,
        "flaps": case.flaps,
        "isa_deviation_K": case.isa_deviation,
        "temperature_degC": temperature(case.elevation) + case.isa_deviation - FREEZING,
        "qnh_Pa": case.qnh,
        "headwind_counted_mps": case.headwind,
        "crosswind_mps": case.crosswind,
        "needs": [{**need._asdict(), "margin": need.margin, "met": need.met} for need in card.needs],
        "limiting": {"name": card.limiting.name, "kind": card.limiting.kind, "margin": card.limiting.margin},
        "greatest_mass_kg": None if greatest is None else _known(greatest.mass),
        "greatest_mass_set_by": None if greatest is None else greatest.set_by,
        **field_data(card.field),
    }


def shown(value: float, unit: str) -> str:
    """A required or available value in the unit of the pages."""
    factor = {"m": 1.0, "%": 100.0, "kt": 1.0 / KT}[unit]
    return f"{value * factor:.{0 if unit == 'm' else 1}f} {unit}"


def card_text(data: dict[str, Any]) -> str:
    """The card as text."""
    runway = data["runway"]
    verdict = "possible" if data["possible"] else "NOT POSSIBLE"
    lines = [
        f"{runway['name']}, {data['mass_kg'] / 1e3:.1f} t: take-off {verdict}",
        f"  TORA {runway['tora_m']:.0f} m, TODA {runway['toda_m']:.0f} m, ASDA {runway['asda_m']:.0f} m",
        f"  {runway['surface']}, elevation {runway['elevation_m']:.0f} m, slope {runway['slope']:+.2%}",
        f"  {data['temperature_degC']:.1f} degC (ISA {data['isa_deviation_K']:+.1f} K)",
        f"  QNH {data['qnh_Pa'] / 100:.1f} hPa",
        f"  headwind counted {data['headwind_counted_mps'] / KT:+.1f} kt",
        "  kt CAS: "
        + "  ".join(
            f"{title} {'-' if data[name] is None else f'{data[name] / KT:.0f}'}" for title, name in SPEEDS
        )
        + f"   V1 set by {data['v1_set_by']}",
        *told(data),
        f"  {'':26}{'required':>12}{'available':>12}{'margin':>9}",
    ]
    lines += [
        f"  {need['name']:26}{shown(need['required'], need['unit']):>12}{shown(need['available'], need['unit']):>12}"
        f"{need['margin']:>9.1%}{'' if need['met'] else '  NOT MET'}"
        for need in data["needs"]
    ]
    limiting = data["limiting"]
    lines.append(f"  least margin: {limiting['name']} ({limiting['kind']})")
    if data["greatest_mass_set_by"]:
        mass = "none" if data["greatest_mass_kg"] is None else f"{data['greatest_mass_kg'] / 1e3:.1f} t"
        lines.append(f"  greatest mass on this runway: {mass}, set by {data['greatest_mass_set_by']}")
    return "\n".join(lines)
