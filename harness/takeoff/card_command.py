"""`harness takeoff card` and `harness takeoff field`: speeds, distances and limits of CS-25."""

import argparse
import json
from typing import TYPE_CHECKING, Any

from harness.command_line import OUTSIDE, add_json, print_json
from harness.errors import InputError
from harness.takeoff import options
from harness.units import UnitError, parse

if TYPE_CHECKING:
    from harness.command_line import Subparsers
    from harness.takeoff.field_flights import Runway
    from harness.takeoff.runway import Site

DISTANCES = ("--tora", "--toda", "--asda")


def add(topics: "Subparsers") -> None:
    """The arguments of both."""
    card = topics.add_parser(
        "card", help="required against available on a runway, and the greatest mass there"
    )
    card.add_argument(
        "--runway",
        metavar="AIRPORT/RUNWAY",
        help="from the navigation database; without it, the distances by hand",
    )
    for option in DISTANCES:
        card.add_argument(option, metavar="3000m", help="available, in place of the runway's length")
    card.add_argument("--mass", metavar="110t", required=True, help="take-off mass")
    card.add_argument("--temperature", metavar="25degC", help="on the runway; in place of --isa-deviation")
    card.add_argument("--no-greatest-mass", action="store_true", help="do not search the greatest mass")
    card.add_argument(
        "--out", metavar="DIR", help="folder for a new folder with the card as JSON and as a page to print"
    )
    field = topics.add_parser("field", help="speeds and field lengths over mass")
    field.add_argument("--mass", metavar="FROM:TO:STEP", required=True, help="take-off masses, also 89t,100t")
    for parser, run in ((card, run_card), (field, run_field)):
        parser.add_argument(
            "--vr",
            metavar="SPEED",
            default="scheduled",
            help="rotation speed, CAS (default: the least of CS-25)",
        )
        parser.add_argument(
            "--surface", choices=("dry", "wet"), default="dry", help="of the paved runway (default: dry)"
        )
        options.add_conditions(parser)
        add_json(parser)
        parser.set_defaults(run=run)


def run_field(chosen: argparse.Namespace) -> int:
    """`harness takeoff field`: the balanced field of each mass."""
    masses = options.read("--mass", options.masses, chosen.mass)
    fields = options.conditions(chosen)
    workers = options.workers(chosen.workers)
    from harness.takeoff.case import TakeOff, check_all, fine
    from harness.takeoff.field import fields_of
    from harness.takeoff.text import field_data, field_text

    cases = [fine(TakeOff(mass, surface=chosen.surface, **fields)) for mass in masses]
    check_all(cases)
    rows = [
        {"mass_kg": case.mass, **field_data(field)}
        for case, field in zip(cases, fields_of(cases, workers), strict=True)
    ]
    if chosen.json:
        print_json(rows)
    else:
        print("\n\n".join(field_text(row) for row in rows))
    return 0


def run_card(chosen: argparse.Namespace) -> int:
    """`harness takeoff card`: exit code 1 when the take-off is not possible."""
    mass = options.read("--mass", parse, chosen.mass, "mass")
    celsius = (
        None if chosen.temperature is None else options.read("--temperature", _celsius, chosen.temperature)
    )
    if celsius is not None and chosen.isa_deviation is not None:
        raise InputError(
            "both --temperature and --isa-deviation say how warm it is",
            file="--temperature",
            remedy="give one",
        )
    wind = _wind_from(chosen)
    fields = options.conditions(chosen)
    workers = options.workers(chosen.workers)
    site = _site(chosen, fields)
    from harness.manual import read_manual
    from harness.takeoff.card import card
    from harness.takeoff.case import TakeOff, fine
    from harness.takeoff.greatest import greatest_mass
    from harness.takeoff.runway import deviation, on_site
    from harness.takeoff.text import card_data, card_text

    if celsius is not None:
        fields["isa_deviation"] = deviation(celsius, site.elevation)
    case = on_site(fine(TakeOff(mass, surface=chosen.surface, **fields)), site, *wind)
    manual = read_manual(case.aircraft)
    result = card(case, site.available, manual, workers=workers)
    greatest = None if chosen.no_greatest_mass else greatest_mass(result, manual, workers)
    data = card_data(result, site, greatest)
    folder = _keep(data, chosen.out) if chosen.out else None
    if chosen.json:
        print_json(data)
    else:
        print(card_text(data) + (f"\nkept in {folder}" if folder else ""))
    return 0 if result.met else OUTSIDE


def _keep(data: dict[str, Any], out: str) -> Any:  # noqa: ANN401  the path of the folder
    from harness.log import RunFolder
    from harness.takeoff.page import page

    with RunFolder(out, "card") as folder:
        (folder.path / "card.json").write_text(json.dumps(data, indent=2) + "\n", "utf-8")
        (folder.path / "card.html").write_text(page(data), "utf-8")
        return folder.keep()


def _site(chosen: argparse.Namespace, fields: dict[str, Any]) -> "Site":
    from harness.takeoff.field_flights import Runway
    from harness.takeoff.runway import Site, from_database

    given = {
        option[2:]: options.read(option, parse, text, "length")
        for option in DISTANCES
        if (text := getattr(chosen, option[2:])) is not None
    }
    for option, length in given.items():
        if not 0 < length < 1e4:
            raise InputError(
                f"{length:.0f} m is no length of a runway", file=f"--{option}", remedy="from 1 m to 10 km"
            )
    if chosen.runway is not None:
        site = from_database(chosen.runway)
        return site._replace(
            available=_available(given, site.available),
            elevation=fields.get("elevation", site.elevation),
            slope=fields.get("slope", site.slope),
        )
    if "tora" not in given:
        raise InputError(
            "no runway is given",
            file="--runway",
            remedy="--runway EDDK/14L, or --tora 2500m with --elevation and --slope",
        )
    tora = given["tora"]
    available = _available(given, Runway(tora, tora, tora))
    return Site("runway by hand", 0.0, fields.get("elevation", 0.0), fields.get("slope", 0.0), available)


def _available(given: dict[str, float], runway: "Runway") -> "Runway":
    """The distances given, the rest those of the runway; the take-off run alone makes the other two."""
    tora = given.get("tora", runway.run)
    spare = (tora, tora) if "tora" in given else (runway.distance, runway.stop)
    toda, asda = given.get("toda", spare[0]), given.get("asda", spare[1])
    if toda < tora:
        raise InputError(
            f"a TODA of {toda:.0f} m is less than the TORA of {tora:.0f} m",
            file="--toda",
            remedy="TODA is TORA and the clearway, if there is one",
        )
    return type(runway)(tora, toda, asda)


def _wind_from(chosen: argparse.Namespace) -> tuple[float | None, float]:
    """A wind given by direction, `--wind 10kt 250deg`: (direction, speed), taken out of the options."""
    from harness.takeoff.runway import wind_direction

    for speed, word in chosen.wind:
        direction = wind_direction(word)
        if direction is not None:
            chosen.wind = [one for one in chosen.wind if one[1] != word]
            return direction, options.read("--wind", parse, speed, "speed")
    return None, 0.0


def _celsius(text: str) -> float:
    number = text.removesuffix("degC").strip()
    try:
        if text.endswith("degC"):
            return float(number)
    except ValueError:
        pass
    raise UnitError(f'"{text}" is no temperature; write e.g. 25degC')
