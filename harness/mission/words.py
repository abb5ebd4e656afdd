"""Whether the words of a mission mean something to this aircraft: gains, choices, failures, procedures, checklists."""

from collections.abc import Iterator, Sequence

from harness.errors import InputError, did_you_mean
from harness.manual import FlightManual, words_of
from harness.mission.model import Mission
from harness.plan import Condition, PhasePlan, Step
from harness.plan_reader import Words, check_condition, check_plans, check_step
from harness.vocabulary import OUTCOMES, PHASES


def word_faults(mission: Mission, manual: FlightManual) -> Iterator[InputError]:
    """A fault for every word of the mission that the flight manual does not know."""
    if mission.expects not in OUTCOMES.values():
        file, line = mission.place("expects")
        what = f'no flight ends with "{mission.expects}"'
        yield InputError(what, file=file, line=line, remedy=did_you_mean(mission.expects, OUTCOMES.values()))
    yield from _gains(mission, manual)
    yield from _configuration(mission, manual)
    yield from _failures(mission, manual)
    yield from _plans(mission, manual)


def _gains(mission: Mission, manual: FlightManual) -> Iterator[InputError]:
    for name, gain in mission.gains.items():
        file, line = mission.place(f"aircraft/gain[{name}]/value")
        if name not in manual.gains:
            what, remedy = f'{manual.aircraft} has no gain "{name}"', did_you_mean(name, manual.gains)
        elif gain.unit != manual.gain_units[name]:
            wanted = manual.gain_units[name] or "a number without unit"
            what, remedy = f'the gain "{name}" is in {gain.unit or "no unit"}', f"it is in {wanted}"
        else:
            continue
        yield InputError(what, file=file, line=line, remedy=remedy)


def _configuration(mission: Mission, manual: FlightManual) -> Iterator[InputError]:
    known = manual.configurations
    for name, choice in mission.configuration.items():
        file, line = mission.place(f"configuration/{name}")
        if name not in known:
            what, remedy = f'{manual.aircraft} has no configuration "{name}"', did_you_mean(name, known)
        elif choice not in known[name]:
            what, remedy = f'{name}="{choice}" is not one of its choices', did_you_mean(choice, known[name])
        else:
            continue
        yield InputError(what, file=file, line=line, remedy=remedy)


def _failures(mission: Mission, manual: FlightManual) -> Iterator[InputError]:
    words = _words(manual.with_mission(mission), mission)
    for failure in mission.failures:
        known: dict[str, object] = {**manual.failures}
        unknown = [("failure", failure.name, known)] if failure.name not in known else []
        if failure.phase and failure.phase not in PHASES:
            unknown.append(("phase", failure.phase, {**PHASES}))
        for what, name, names in unknown:
            yield InputError(
                f'{manual.aircraft} has no {what} "{name}"',
                file=failure.file,
                line=failure.line,
                remedy=did_you_mean(name, names),
            )
        for condition in failure.when:
            yield from check_condition(condition, words)


def _plans(mission: Mission, manual: FlightManual) -> Iterator[InputError]:
    flown = manual.with_mission(mission)
    words = _words(flown, mission)
    yield from check_plans(mission.phases.values(), words)
    for leg in mission.legs:
        for action in leg.actions:
            yield from check_step(action, words)
    for plan in mission.phases.values():
        yield from _removals(plan, manual)
        for checklist in flown.phases[plan.name].checklists if plan.name in flown.phases else ():
            if not checklist.items:
                what = f'nothing is left of the checklist from "{plan.name}" to "{checklist.to}"'
                remedy = "leave one item: an empty checklist is complete at once"
                yield InputError(what, file=checklist.file, line=checklist.line, remedy=remedy)


def _removals(plan: PhasePlan, manual: FlightManual) -> Iterator[InputError]:
    mine = manual.phases.get(plan.name, PhasePlan(plan.name, (), ()))
    changed: list[tuple[Sequence[Step | Condition], list[str]]] = [
        (plan.steps, [step.name for step in mine.steps]),
        (
            [item for checklist in plan.checklists for item in checklist.items],
            [item.name for checklist in mine.checklists for item in checklist.items],
        ),
    ]
    for entries, known in changed:
        for entry in entries:
            if entry.remove and entry.name not in known:
                what = f'the manual has no "{entry.name}" in {plan.name} to remove'
                remedy = did_you_mean(entry.name, known)
                yield InputError(what, file=entry.file, line=entry.line, remedy=remedy)


def _words(manual: FlightManual, mission: Mission) -> Words:
    """The names of the manual, and of the loads that may be released."""
    return words_of(manual)._replace(loads=frozenset(pallet.item.name for pallet in mission.loading.pallets))
