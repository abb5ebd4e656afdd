"""Write the parts of the documentation that follow from the program: `.venv/bin/python docs/generate.py`.

The phase graph is drawn by the pilot's own state machine; the words of mission files come from harness/vocabulary.py
and from the schema of their reader. tests/unit/test_docs.py holds that what is committed is what this writes.
"""

import re
from collections.abc import Iterable
from pathlib import Path

from harness import vocabulary
from harness.manual import FlightManual, read_manual
from harness.pilot.machine import diagram
from harness.plan import Condition, Step
from harness.units import KINDS
from harness.vocabulary import Argument

DOCS = Path(__file__).parent
AIRCRAFT = "gta"
MADE = re.compile(r"(<!-- generated: ([\w-]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def main() -> None:
    """Bring every page up to date."""
    for page in pages():
        page.write_text(renewed(page), "utf-8")


def pages() -> list[Path]:
    """The pages with generated parts."""
    return [DOCS / "phases.md", DOCS / "mission-file.md"]


def renewed(page: Path) -> str:
    """The text of a page with its generated parts made anew."""
    parts = {
        "graph": graph,
        "phases": phases,
        "quantities": quantities,
        "settings": settings,
        "modes": modes,
        "configurations": configurations,
        "failures": failures,
    }
    text = page.read_text("utf-8")
    return MADE.sub(lambda found: f"{found[1]}\n{parts[found[2]]()}\n\n{found[3]}", text)


def graph() -> str:
    """The phase graph as Mermaid text, as the machine draws it, with identifiers that Mermaid takes."""
    lines = []
    for line in diagram().splitlines():
        if re.match(r"stateDiagram|\s+(direction|state |\}|\S+ -->)", line):
            bare = line.partition(": enter")[0]
            lines.append(
                re.sub(r'("[^"]*")|(?<!\w)[A-Z][\w/.-]*', lambda m: m[1] or re.sub(r"\W", "_", m[0]), bare)
            )
    return "\n".join(("```mermaid", *lines, "```"))


def phases() -> str:
    """What the pilot does in each phase, and what has to hold before the next."""
    manual = read_manual(AIRCRAFT)
    return "\n\n".join(_phase(name, manual) for name in vocabulary.PHASES if name in manual.phases)


def _phase(name: str, manual: FlightManual) -> str:
    plan = manual.phases[name]
    limit = manual.gains.get(f"time-limit {name}")
    lines = [f"### {name}: {vocabulary.PHASES[name]}", ""]
    lines += [f"{number}. {_step(step)}" for number, step in enumerate(plan.steps, 1)]
    for checklist in plan.checklists:
        lines += ["", f"To {checklist.to} when all of these hold:", ""]
        lines += [f"* {item.name}: {_condition(item)}" for item in checklist.items]
    if limit is not None:
        lines += ["", f"Time limit {limit:.0f} s."]
    return "\n".join(lines)


def _step(step: Step) -> str:
    action = dict(step.action)
    target = action.pop("set", None) or action.pop("mode")
    to = " ".join([action.pop("to"), *action.values()])
    when = " and ".join(_condition(condition) for condition in step.when)
    return f"{step.name} ({target} {to})" + (f", once {when}" if when else "")


def _condition(condition: Condition) -> str:
    relation = condition.relation.replace("-", " ")
    return f"{condition.quantity.replace('-', ' ')} {relation} {condition.required}"


def quantities() -> str:
    """What conditions can look at."""
    plans = read_manual(AIRCRAFT).phases.values()
    used = {
        condition.quantity: f'`{condition.relation}="{condition.required}"`'
        for plan in plans
        for conditions in (
            *(step.when for step in plan.steps),
            *(checklist.items for checklist in plan.checklists),
        )
        for condition in conditions
    }
    rows = [
        (f"`{name}`", "yes or no" if kind == "yes-no" else KINDS[kind].noun, used.get(name, _example(kind)))
        for name, kind in vocabulary.QUANTITIES.items()
    ]
    return table(("quantity", "is", "for example"), rows)


def settings() -> str:
    """What steps can set."""
    manual = read_manual(AIRCRAFT)
    values = {
        "thrust-setting": _words(manual.thrust),
        "flap-setting": _words(setting.name for setting in manual.flaps),
        "up-down": _words(("up", "down")),
        "course": _words(("runway",)),
        "shut-down": _words(("shut-down",)),
        "ratio": "a number, full travel is 1",
        "load": "the name of a pallet",
    }
    rows = [(f"`{name}`", values[kind]) for name, kind in vocabulary.SETTINGS.items()]
    return table(("set", "to"), rows)


def modes() -> str:
    """Super-modes, sub-modes and what each takes."""
    rows = [
        (
            f"`{mode}`",
            f"`{sub_mode}`",
            "<br>".join(_argument(name, argument) for name, argument in arguments.items()),
        )
        for mode, sub_modes in vocabulary.MODES.items()
        for sub_mode, arguments in sub_modes.items()
    ]
    return table(("mode", "to", "and"), rows)


def configurations() -> str:
    """What can be chosen of the aircraft."""
    rows = [
        (f"`{name}`", f"`{choice}`", f"`{setting.property}` = {setting.value:g}")
        for name, choices in read_manual(AIRCRAFT).configurations.items()
        for choice, setting in choices.items()
    ]
    return table(("configuration", "choice", "sets"), rows)


def failures() -> str:
    """What can fail."""
    rows = [
        (f"`{name}`", f"`{setting.property}` = {setting.value:g}")
        for name, setting in read_manual(AIRCRAFT).failures.items()
    ]
    return table(("failure", "sets"), rows)


def _argument(name: str, argument: Argument) -> str:
    kinds = {"word": "", "speed-target": "a speed of the manual, `V2 + 10 kt`, `200 kt CAS`"}
    value = kinds.get(argument.kind) if argument.kind in kinds else _example(argument.kind)
    return f"`{name}`: " + ", ".join(filter(None, (_words(argument.words), value)))


def _example(kind: str) -> str:
    return "`yes`" if kind == "yes-no" else f"`{KINDS[kind].example}`"


def _words(words: Iterable[str]) -> str:
    return ", ".join(f"`{word}`" for word in words)


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """A Markdown table."""
    lines = [head, tuple("---" for _ in head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


if __name__ == "__main__":
    main()
