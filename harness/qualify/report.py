"""The table on the terminal and the page of a qualification."""

from collections.abc import Sequence
from html import escape
from math import isnan
from pathlib import Path

from jinja2 import Environment, PackageLoader
from markupsafe import Markup

from harness import __version__
from harness.analysis.plots.panels import panels_svg
from harness.errors import OutputError
from harness.qualify.judge import Verdict


def number(value: float) -> str:
    """A result with as many digits as it deserves."""
    if isnan(value):
        return "-"
    digits = next((d for limit, d in ((0.01, 5), (1, 3), (100, 2), (1000, 1)) if abs(value) < limit), 0)
    return f"{value:.{digits}f}"


def counts(verdicts: Sequence[Verdict]) -> dict[str, int]:
    """How many rows there are, are inside, and of those how many without having been calibrated on."""
    inside = [verdict for verdict in verdicts if verdict.inside]
    return {
        "rows": len(verdicts),
        "inside": len(inside),
        "outside": len(verdicts) - len(inside),
        "not calibrated": sum(not verdict.row.calibrated for verdict in verdicts),
        "not calibrated, inside": sum(not verdict.row.calibrated for verdict in inside),
    }


def table(verdicts: Sequence[Verdict]) -> str:
    """One line a row, plain text."""
    lines = [
        f"{'test':<6} {'title':<66} {'result':>9} {'target':>8} {'unit':<8} {'tolerance':<14} {'':<7} calibrated"
    ]
    for verdict in verdicts:
        row = verdict.row
        word = "inside" if verdict.inside else "OUTSIDE"
        lines.append(
            f"{row.id:<6} {row.title[:66]:<66} {number(verdict.result):>9} {row.target:>8g} {row.unit:<8} "
            f"{row.tolerance:<14} {word:<7} {'yes' if row.calibrated else 'no'}"
        )
    total = counts(verdicts)
    lines.append(
        f"{total['inside']} of {total['rows']} inside; of the {total['not calibrated']} not calibrated on, "
        f"{total['not calibrated, inside']}."
    )
    return "\n".join(lines)


def write_page(verdicts: Sequence[Verdict], aircraft: str, fingerprint: str, folder: Path) -> Path:
    """Write `qualification.html`, a single file without anything from a network. Raises OutputError."""
    environment = Environment(loader=PackageLoader("harness.qualify", ""), autoescape=True)
    environment.filters |= {"number": number, "id": id}
    drawn: dict[int, Markup] = {}
    for verdict in verdicts:
        key = id(verdict.panels)
        if verdict.panels and key not in drawn:
            drawn[key] = Markup(panels_svg(verdict.panels))  # noqa: S704  our own picture, its texts escaped by matplotlib
    page = environment.get_template("page.html.j2").render(
        aircraft=aircraft,
        fingerprint=fingerprint,
        version=__version__,
        verdicts=verdicts,
        flights=_flights(verdicts),
        drawn=drawn,
        counts=counts(verdicts),
        title=escape(f"Qualification of {aircraft}"),
    )
    path = folder / "qualification.html"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        path.write_text(page, encoding="utf-8")
    except OSError as error:
        raise OutputError(
            f"cannot be written: {error.strerror}", path=path, remedy="choose another folder with --out"
        ) from error
    return path


def _flights(verdicts: Sequence[Verdict]) -> list[list[Verdict]]:
    """The verdicts of the same flight together, in the order of the guide."""
    found: dict[tuple[str, str], list[Verdict]] = {}
    for verdict in verdicts:
        found.setdefault((verdict.row.manoeuvre, verdict.row.condition_text), []).append(verdict)
    return list(found.values())
