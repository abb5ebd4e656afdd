"""The take-off card as one page to print."""

from importlib.resources import files
from typing import Any

from jinja2 import Environment, StrictUndefined, select_autoescape

from harness import __version__
from harness.takeoff.text import SPEEDS, shown
from harness.units import FT, HPA, KT


def page(data: dict[str, Any]) -> str:
    """HTML that stands alone, from the card's JSON."""
    environment = Environment(
        autoescape=select_autoescape(default=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    template = environment.from_string((files("harness.takeoff") / "card.html.j2").read_text("utf-8"))
    runway = data["runway"]
    longest = max(
        need[side] for need in data["needs"] if need["unit"] == "m" for side in ("required", "available")
    )
    return template.render(
        card=data,
        runway=runway,
        speeds=[(title, data[name]) for title, name in SPEEDS],
        shown=shown,
        longest=longest,
        knots=KT,
        foot=FT,
        hectopascal=HPA,
        version=__version__,
    )
