"""Reading procedures and checklists from XML, and checking that every word in them has a meaning.

The words are in `harness.vocabulary`; the names an aircraft adds (speeds, settings) come as `Words`.
"""

import re
from collections.abc import Iterable, Iterator
from math import inf
from typing import NamedTuple, TypeVar

from harness import vocabulary
from harness.errors import InputError, did_you_mean
from harness.plan import RELATIONS, Checklist, Condition, Emergency, Failure, PhasePlan, Step
from harness.units import DEG, UnitError, parse, parse_speed, show
from harness.xml_source import Element, Source, children

_OFFSET = re.compile(r"(\S+) ([+-]) (.+)")
_ALWAYS = frozenset({"name", "remove", "set", "mode", "to"})
_POSITIONS = {"up": 0.0, "down": 1.0}

_ONE_SIDED = frozenset({"brakes", "speedbrake", "ground-spoilers", "crossfeed", "ramp"})
_STEEPEST = {
    "pitch": 30 * DEG,
    "bank": 60 * DEG,
    "angle": 15 * DEG,
}  # what a step may ask for: the aircraft's own limits

Meaning = TypeVar("Meaning")


class Words(NamedTuple):
    """The names a flight manual gives to speeds, thrust settings and flap settings, and a mission to its loads."""

    speeds: frozenset[str]
    thrust: frozenset[str]
    flaps: frozenset[str]
    loads: frozenset[str] = frozenset()


class Reference(NamedTuple):
    """A right-hand side: a number (SI), or a name to look up plus a number. `yes` is 1 and `no` is 0."""

    name: str
    offset: float


def parse_reference(text: str, kind: str) -> Reference:
    """The right-hand side of a condition or an argument: "200 ft/min", "VR", "V2 + 10 kt", "yes".

    `kind` is a kind of quantity of the vocabulary. Names are returned unchecked. Raises UnitError.
    """
    if kind == "yes-no":
        if text not in ("yes", "no"):
            raise UnitError(f'"{text}" is neither yes nor no')
        return Reference("", float(text == "yes"))
    if text[:1] in set("+-.0123456789") or text in ("nan", "inf"):
        return Reference("", _number(text, kind))
    offset = _OFFSET.fullmatch(text)
    if offset is None:
        return Reference(text, 0.0)
    sign = 1.0 if offset[2] == "+" else -1.0
    return Reference(offset[1], sign * _number(offset[3], kind))


def _number(text: str, kind: str) -> float:
    if kind in ("speed", "speed-target") and text.endswith(" CAS"):
        return parse_speed(text).value
    return parse(text, "speed" if kind == "speed-target" else kind)


def read_phase(source: Source, element: Element) -> PhasePlan:
    """The plan in a <phase> element, faults noted in `source`."""
    procedure = source.one(element, "procedure", needed=False)
    steps = [] if procedure is None else list(children(procedure, "step"))
    checklists = list(children(element, "checklist"))
    source.distinct(steps, "name")
    source.distinct(checklists, "to")
    file, line = source.place(element)
    return PhasePlan(
        element.get("name", ""),
        tuple(read_step(source, step) for step in steps),
        tuple(_checklist(source, checklist) for checklist in checklists),
        file,
        line or 0,
    )


def read_step(source: Source, element: Element) -> Step:
    """The step in a <step> or <action> element, faults noted in `source`."""
    attributes = {str(key): str(value) for key, value in element.attrib.items()}
    remove = attributes.pop("remove", "") == "yes"
    name = attributes.pop("name")
    if not remove and (("set" in attributes) == ("mode" in attributes) or "to" not in attributes):
        source.fault(
            f'"{name}" does not say what to do',
            element,
            remedy='write set="gear" to="up", or mode="SPD" to="THR" speed="V2"',
        )
    conditions = tuple(_condition(source, when, name) for when in children(element, "when"))
    only_if = tuple(_condition(source, entry, name) for entry in children(element, "if"))
    file, line = source.place(element)
    return Step(name, attributes, conditions, file, line or 0, remove, only_if)


def read_emergency(source: Source, element: Element) -> Emergency:
    """What an <emergency> element says, faults noted in `source`."""
    name = element.get("name", "")
    plan = read_phase(source, element)
    return Emergency(
        name, tuple(_condition(source, when, name) for when in children(element, "when")), plan.steps
    )


def read_failure(source: Source, element: Element) -> Failure:
    """The failure in a <failure> element of a mission, faults noted in `source`."""
    name = element.get("name", "")
    conditions = tuple(_condition(source, when, name) for when in children(element, "when"))
    file, line = source.place(element)
    return Failure(name, element.get("phase", ""), conditions, file, line or 0)


def _checklist(source: Source, element: Element) -> Checklist:
    items = list(children(element, "item"))
    source.distinct(items, "name")
    file, line = source.place(element)
    read = tuple(_condition(source, item, item.get("name", "")) for item in items)
    return Checklist(element.get("to", ""), read, file, line or 0)


def _condition(source: Source, element: Element, name: str) -> Condition:
    remove = element.get("remove") == "yes"
    given = [relation for relation in RELATIONS if element.get(relation) is not None]
    if not remove and (len(given) != 1 or element.get("quantity") is None):
        source.fault(
            f"<{element.tag}> needs a quantity and exactly one of at-least, at-most, is",
            element,
            remedy=f'write <{element.tag} quantity="height" at-least="400 ft"/>',
        )
    relation = given[0] if given else "is"
    file, line = source.place(element)
    required = element.get(relation, "")
    return Condition(
        element.get("name", name), element.get("quantity", ""), relation, required, file, line or 0, remove
    )


def check_plans(plans: Iterable[PhasePlan], words: Words) -> Iterator[InputError]:
    """A fault for every phase, quantity, setting, mode or name without a meaning."""
    for plan in plans:
        for checklist in plan.checklists:
            if (plan.name, checklist.to) not in vocabulary.EDGES and plan.name in vocabulary.PHASES:
                ways = [to for start, to in vocabulary.EDGES if start == plan.name]
                what = f'no way leads from "{plan.name}" to "{checklist.to}"'
                yield InputError(
                    what, file=checklist.file, line=checklist.line, remedy=did_you_mean(checklist.to, ways)
                )
            for item in checklist.items:
                yield from check_condition(item, words)
        for step in plan.steps:
            yield from check_step(step, words)
        if plan.name not in vocabulary.PHASES:
            what, remedy = (
                f'"{plan.name}" is not a phase we can fly',
                did_you_mean(plan.name, vocabulary.PHASES),
            )
            yield InputError(what, file=plan.file, line=plan.line, remedy=remedy)


def check_emergencies(emergencies: Iterable[Emergency], words: Words) -> Iterator[InputError]:
    """A fault for every word of the emergencies without a meaning."""
    for emergency in emergencies:
        for condition in emergency.when:
            yield from check_condition(condition, words)
        for step in emergency.steps:
            yield from check_step(step, words)


def check_step(step: Step, words: Words) -> Iterator[InputError]:
    """Faults in the words of one step."""
    for condition in (*step.only_if, *step.when):
        yield from check_condition(condition, words)
    if step.remove:
        return
    try:
        if "set" in step.action:
            _check_setting(step.action, words)
        else:
            _check_mode(step.action, words)
    except UnitError as error:
        yield _fault(f"{step.name}: ", error, step)


def check_condition(condition: Condition, words: Words) -> Iterator[InputError]:
    """Faults in the words of one condition."""
    if condition.remove:
        return
    try:
        _check_comparison(condition, words)
    except UnitError as error:
        yield _fault("", error, condition)


def _check_comparison(condition: Condition, words: Words) -> None:
    kind = _known(condition.quantity, vocabulary.QUANTITIES, "a quantity")
    if kind == "yes-no" and condition.relation != "is":
        raise UnitError(f'{condition.quantity} is yes or no; write is="yes"')
    names = _names(condition.quantity, kind, words)
    reference = parse_reference(condition.required, kind)
    if reference.name:
        _known(reference.name, dict.fromkeys(names, ""), f"known for {condition.quantity}")


def _names(quantity: str, kind: str, words: Words) -> frozenset[str]:
    """The names that may stand on the right-hand side for this quantity."""
    if quantity == "flap":
        return words.flaps
    if quantity == "gear":
        return frozenset(_POSITIONS)
    if kind == "speed":
        return words.speeds | {name for name, of in vocabulary.TARGETS.items() if of == kind}
    return frozenset(name for name, of in vocabulary.TARGETS.items() if of == kind)


def _check_setting(action: dict[str, str], words: Words) -> None:
    kind = _known(action["set"], vocabulary.SETTINGS, "something a step can set")
    for extra in action.keys() - _ALWAYS:
        raise UnitError(f'a step that sets {action["set"]} has no "{extra}"; it takes set and to')
    choices = {
        "thrust-setting": words.thrust,
        "flap-setting": words.flaps,
        "up-down": frozenset(_POSITIONS),
        "course": frozenset({"runway"}),
        "load": words.loads,
        "shut-down": frozenset({"shut-down"}),
    }
    if kind in choices:
        _known(action["to"], dict.fromkeys(choices[kind], ""), f"a position of {action['set']}")
        return
    value = parse(action["to"], kind)
    least = 0 if action["set"] in _ONE_SIDED else -1
    if kind == "ratio" and not least <= value <= 1:
        raise UnitError(f'to="{action["to"]}" is outside {least} .. 1; full travel is 1')


def _check_mode(action: dict[str, str], words: Words) -> None:
    modes = _known(action["mode"], vocabulary.MODES, "a super-mode")
    arguments = _known(action["to"], modes, f"a sub-mode of {action['mode']}")
    given = action.keys() - _ALWAYS
    if arguments and not given:
        wanted = " or ".join(f'{name}="..."' for name in arguments)
        raise UnitError(f"{action['mode']} {action['to']} needs its argument; add {wanted}")
    if len(given) > 1:
        raise UnitError(
            f"{' and '.join(sorted(given))} at once; {action['mode']} {action['to']} takes one of them"
        )
    for name in sorted(given):
        argument = _known(name, arguments, f"an argument of {action['mode']} {action['to']}")
        text = action[name]
        if text in argument.words:
            continue
        if argument.kind == "word":
            _known(text, dict.fromkeys(argument.words, ""), f"a {name}")
        reference = parse_reference(text, argument.kind)
        if reference.name:
            names = words.speeds if argument.kind == "speed-target" else frozenset()
            _known(reference.name, dict.fromkeys((*names, *argument.words), ""), f"a {name}")
        elif abs(reference.offset) > _STEEPEST.get(name, inf):
            most = show(_STEEPEST[name], "deg")
            raise UnitError(f'{name}="{text}" is no attitude of a transport aircraft; at most {most}')


def _known(word: str, meanings: dict[str, Meaning], what: str) -> Meaning:
    if word not in meanings:
        raise UnitError(f'"{word}" is not {what}; {did_you_mean(word, meanings)}')
    return meanings[word]


def _fault(prefix: str, error: UnitError, where: Step | Condition) -> InputError:
    what, _, remedy = str(error).partition("; ")
    return InputError(prefix + what, file=where.file, line=where.line, remedy=remedy)
