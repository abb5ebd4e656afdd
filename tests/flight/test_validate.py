"""`harness validate` flies and judges; the bars themselves are in tests/validation."""

import json

from conftest import Command


def test_a_flight_is_judged_quantity_by_quantity(harness: Command):
    result = harness("validate", "circuit", "--json")
    assert result.returncode == 0, result.stdout
    (flight,) = json.loads(result.stdout)["flights"]
    judged = {bar["quantity"]: bar["inside"] for bar in flight["bars"]}
    assert judged["flight completed"] is True
    assert judged["sink at touchdown"] is True
    assert judged["localizer, 1,000 ft to the flare"] is None


def test_a_flight_that_does_not_complete_is_outside(harness: Command, repository, tmp_path):
    text = (repository / "missions" / "circuit.xml").read_text("utf-8")
    stuck = (
        '<phase name="T/O.run"><checklist to="T/O.rotation">'
        '<item name="rotation speed" quantity="cas" at-least="300 kt"/>'
        "</checklist></phase></mission>"
    )
    (tmp_path / "stuck.xml").write_text(text.replace("</mission>", stuck), "utf-8")
    result = harness("validate", "stuck.xml")
    assert result.returncode == 1, result.stderr
    assert "flight completed" in result.stdout
    assert "NO" in result.stdout
    assert "Traceback" not in result.stderr
