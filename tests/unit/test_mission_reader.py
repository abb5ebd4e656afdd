"""A mission is read whole, checked against its aircraft, and refused with file and line where it is wrong."""

# ruff: noqa: E501  a table of cases reads best one case a line

import os
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from harness import resources
from harness.errors import InputError
from harness.manual import read_manual
from harness.mission.check import check_file
from harness.mission.model import Mission
from harness.mission.reader import read_mission
from harness.units import DEG, FT, HPA, KT, NM, Level, Speed
from harness.world import earth

Refusal = Callable[..., str]

MANUAL = Path(__file__).parents[1] / "data" / "flight-manual.xml"


@pytest.fixture(autouse=True)
def a_fleet_of_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, repository: Path) -> None:
    """The missions are checked against the manual of the tests, so that tuning an aircraft breaks no test here."""
    folder = tmp_path / "root" / "aircraft" / "gta"
    shutil.copytree(repository / "aircraft" / "gta", folder)
    (folder / "flight-manual.xml").write_bytes(MANUAL.read_bytes())
    monkeypatch.setattr(resources, "root", lambda: tmp_path / "root")


@pytest.fixture
def original(repository: Path) -> Path:
    return repository / "missions" / "cologne-munich.xml"


@pytest.fixture
def refusal(tmp_path: Path, original: Path) -> Refusal:
    """Reads the mission with one text replaced and returns the message it is refused with."""

    def refuse(old: str, new: str, overrides: Iterable[str] = ()) -> str:
        text = original.read_text("utf-8")
        assert old in text
        path = tmp_path / "mission.xml"
        path.write_text(text.replace(old, new, 1), "utf-8")
        with pytest.raises(InputError) as refused:
            check_file(path, overrides)
        for fault in refused.value.faults:
            assert fault.file == str(path)
            assert 1 <= fault.line <= text.count("\n") + 2
        return str(refused.value)

    return refuse


@pytest.mark.parametrize("name", ["cologne-munich", "cologne-munich-tas", "circuit", "hop"])
def test_every_mission_shipped_is_accepted_by_its_aircraft(name: str, repository: Path) -> None:
    assert check_file(repository / "missions" / f"{name}.xml").name == name


@pytest.fixture
def cologne_munich(original: Path) -> Mission:
    return check_file(original)


def test_the_mission_is_si_and_nothing_is_left_to_look_up(cologne_munich: Mission) -> None:
    mission = cologne_munich
    assert mission.aircraft == "gta"
    assert mission.loading[:3] == (100_000.0, None, 12_000.0)
    assert (mission.departure.airport, mission.departure.runway) == ("EDDK", "13L")
    assert (mission.arrival.airport, mission.arrival.runway) == ("EDDM", "26L")
    assert len(mission.departure.taxi) == 3
    assert mission.departure.stand is not None
    assert mission.departure.stand.heading == pytest.approx(317.5 * DEG)
    first, second, third = mission.legs[:3]
    assert (first.mode, first.speed, first.level) == (
        "homing",
        Speed("CAS", 130.0),
        Level("FL", pytest.approx(5000 * FT)),
    )
    assert second.speed == Speed("MACH", 0.4)
    assert second.course_true == pytest.approx((148 + 1.25) * DEG)  # the declination at Ried in 2010
    assert second.fix.station is not None
    _, _, distance = earth.inverse(
        second.fix.latitude, second.fix.longitude, third.fix.latitude, third.fix.longitude
    )
    assert third.fix.distance == pytest.approx(45 * NM)
    assert distance == pytest.approx(45 * NM)


def test_the_route_is_the_one_of_the_facts(cologne_munich: Mission) -> None:
    """Leg lengths of the reconstruction, km, from the runway's threshold to WP12."""
    expected = [34.5, 130.3, 83.3, 35.8, 31.9, 25.3, 49.0, 29.9, 70.9, 83.5, 14.8, 26.9]
    fixes = [leg.fix for leg in cologne_munich.legs[:12]]
    for before, after, length in zip(fixes, fixes[1:], expected[1:], strict=False):
        flown = earth.inverse(before.latitude, before.longitude, after.latitude, after.longitude)[2]
        assert flown / 1000 == pytest.approx(length, abs=0.15)


def test_stations_are_flown_over_and_points_flown_by_unless_said_otherwise(cologne_munich: Mission) -> None:
    turns = {leg.name: leg.turn for leg in cologne_munich.legs}
    assert turns["WP1"] == "fly-over"
    assert turns["WP10"] == "fly-by"
    assert turns["WP13"] == "fly-by"


def test_the_arrival_is_lined_up_and_below_the_glide_slope(cologne_munich: Mission) -> None:
    last = cologne_munich.legs[-1]
    assert (last.speed.value, last.level.altitude) == (90.0, pytest.approx(5000 * FT))


def test_a_variant_is_its_base_with_values_set(original: Path, cologne_munich: Mission) -> None:
    variant = read_mission(original.with_name("cologne-munich-tas.xml"))
    assert variant.name == "cologne-munich-tas"
    assert variant.source_path.name == "cologne-munich-tas.xml"
    assert "true airspeeds" in " ".join(variant.description.split())
    assert variant.legs[0].speed == Speed("TAS", 130.0)
    assert variant.legs[1] == cologne_munich.legs[1]
    assert variant.loading == cologne_munich.loading
    assert "130 m/s TAS" in variant.text


def test_a_minimal_mission_is_short_and_takes_the_standard_day(repository: Path) -> None:
    mission = read_mission(repository / "missions" / "circuit.xml")
    assert mission.environment == (0.0, 1013.25 * HPA, 0.0, 0.0)
    assert mission.departure.stand is None
    assert mission.phases == {}


def test_payload_may_be_given_in_place_of_the_take_off_mass(tmp_path: Path, original: Path) -> None:
    path = tmp_path / "m.xml"
    path.write_text(
        original.read_text("utf-8").replace('take-off-mass="100 t"', 'payload="9400 kg"'), "utf-8"
    )
    loading = check_file(path).loading
    assert loading.total(78_600.0) == pytest.approx(100_000.0)
    assert loading.payload_of(78_600.0) == 9400.0


BAD_VALUES = [
    # a number without a unit, or of the wrong kind
    ('take-off-mass="100 t"', 'take-off-mass="100"', 'take-off-mass="100" has no unit\n    a mass is wanted, e.g. 100 t'),
    ('take-off-mass="100 t"', 'take-off-mass="100 m"', 'take-off-mass="100 m" is a length'),
    ('speed="130 m/s CAS"', 'speed="130 m"', 'speed="130 m" is a length\n    an airspeed is wanted, e.g. 130 m/s CAS'),
    ('speed="130 m/s CAS"', 'speed="130 m/s"', "write 130 m/s CAS or 130 m/s TAS"),
    ('fuel="12 t"', 'fuel="nan t"', 'fuel="nan t" is not a number'),
    ('fuel="12 t"', 'fuel="1e308 t"', "beyond anything that flies"),
    ('fuel="12 t"', 'fuel=""', "fuel is empty"),
    ('fuel="12 t"', "", 'lacks its "fuel"'),
    ('level="FL50"', 'level="50"', 'level="50" is not a level\n    write e.g. FL230 or 5000 ft'),
    ('course="148 deg magnetic"', 'course="148 deg"', "write 148 deg true or 148 deg magnetic"),
    ('heading="317.5 deg true"', 'heading="317.5 deg magnetic"', "write true"),
    ('latitude="50.877718 deg"', 'latitude="150 deg"', "beyond 90 deg"),
    # names that do not exist
    ("<loading take", "<loding take", "<loding> does not belong into <mission>\n    did you mean <loading>?"),
    ('turn="fly-by"', 'trun="fly-by"', '<waypoint> has no attribute "trun"\n    did you mean turn?'),
    ('mode="homing"', 'mode="homming"', 'mode="homming" is not known\n    did you mean homing?'),
    ('station="COL"', 'station="COLL"', "no station 'COLL'"),
    ('runway="13L"', 'runway="13X"', "EDDK has no runway '13X'"),
    ('airport="EDDM"', 'airport="EDDX"', "no airport 'EDDX'"),
    ('aircraft name="gta"', 'aircraft name="gtx"', 'no aircraft "gtx"\n    did you mean gta?'),
    ('<mission name="cologne-munich"', '<mission name="../../x"', "characters that do not belong"),
    # elements missing or doubled
    ('<loading take-off-mass="100 t" fuel="12 t"/>', "", "<mission> has no <loading>"),
    ('<aircraft name="gta"/>', '<aircraft name="gta"/>\n<aircraft name="gta"/>', "<aircraft> is here twice; the first is in line 17"),
    ('name="WP2"', 'name="WP1"', '<waypoint name="WP1"> is here twice'),
    ("<route>", "<route>hello", "<route> has text inside"),
    # legs that make no sense
    (' course="148 deg magnetic"', "", '<waypoint> lacks its "course"'),
    ('station="COL" mode="homing"', 'station="COL" mode="homing" course="108 deg true"', "a homing leg has no course"),
    ('station="COL" mode="homing"', 'mode="homing"', "either at a station or at a latitude"),
    ('station="COL" mode="homing"', 'latitude="50 deg" longitude="7 deg" mode="homing"', "needs a station to receive"),
    ('station="NSN" mode="homing"', 'station="NSN" mode="tracking" course="80 deg true" distance="5 NM"', "it has no DME"),
    ('station="COL" mode="homing"', 'station="COL" mode="homing" distance="5 NM"', "only a tracking leg"),
    ('course="148 deg magnetic"', 'course="328 deg magnetic"', "leads away from its station"),
    ('name="WP2" station="RID" mode="tracking" course="148 deg magnetic"', 'name="WP2" station="COL" mode="homing"', "no length"),
    # what this aircraft cannot do
    ('level="FL230"', 'level="FL450"', "WP2: FL450 is above the maximum altitude of gta\n    at most 37,000 ft"),
    ('level="FL50"', 'level="FL360"', "is a climb of 18 deg\n    at most 15 deg: another level, or a longer leg"),
    ('level="FL50"', 'level="FL10"', "WP1: FL10 is too low: COL lies at 990 ft"),
    ('speed="130 m/s CAS"', 'speed="180 m/s CAS"', "WP1: 350 kt CAS at FL50 is above VMO 300 kt"),
    ('speed="130 m/s CAS"', 'speed="180 m/s TAS"', "is 327 kt CAS and is above VMO 300 kt"),
    ('speed="M0.4"', 'speed="M0.8"', "is 352 kt CAS and is above VMO"),
    ('speed="M0.4" level="FL230"', 'speed="M0.73" level="FL350"', "above MMO M0.72"),
    ('speed="130 m/s CAS"', 'speed="60 m/s CAS"', "too slow\n    at least 159 kt CAS: 1.2 times the clean stall speed at 100.0 t"),
    ('fuel="12 t"', 'fuel="60 t"', "60.0 t of fuel is more than the tanks hold\n    gta holds 48.9 t"),
    ('fuel="12 t"', 'fuel="0 t"', "nothing to burn"),
    ('take-off-mass="100 t"', 'take-off-mass="160 t"', "160.0 t is above the limit of 141.0 t"),
    ('take-off-mass="100 t"', 'take-off-mass="130 t"', "above the zero-fuel limit of 109.6 t"),
    ('take-off-mass="100 t"', 'take-off-mass="85 t"', "the payload would be -5.6 t"),
    ('take-off-mass="100 t"', 'payload="-5 t"', "the payload would be -5.0 t"),
    ('take-off-mass="100 t"', 'take-off-mass="100 t" payload="5 t"', "either the take-off mass or the payload"),
    ('level="5000 ft"', 'level="9000 ft"', "above the glide slope of EDDM 26L"),
    ('latitude="48.372595 deg" longitude="12.177138 deg"', 'latitude="48.3 deg" longitude="11.6 deg"', "no room to line up"),
    ('latitude="50.877718 deg"', 'latitude="5.877718 deg"', "the wrong way round?"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "teaching"), BAD_VALUES)
def test_bad_input_is_refused_with_what_would_be_right(
    refusal: Refusal, old: str, new: str, teaching: str
) -> None:
    assert teaching in refusal(old, new)


BAD_ELEMENTS = [
    ('<speed name="VR" value="140 m/s CAS"/>', "VR of 272 kt is above 200 kt, the limit with these flaps"),
    ('<speed name="VR" value="30 m/s CAS"/>', "too slow to fly"),
    ('<speed name="V1" value="130 kt CAS"/>', "V1 of 130 kt is above VR of 121 kt"),
    ('<speed name="VRR" value="60 m/s CAS"/>', 'gta has no speed "VRR"\n    did you mean VR'),
    ('<speed name="VR" value="60 m/s TAS"/>', "not a calibrated airspeed"),
]


@pytest.mark.parametrize(("element", "teaching"), BAD_ELEMENTS)
def test_a_decision_speed_outside_the_envelope_is_refused(
    refusal: Refusal, element: str, teaching: str
) -> None:
    assert teaching in refusal('<aircraft name="gta"/>', f'<aircraft name="gta">{element}</aircraft>')


BAD_DAYS = [
    ('qnh="500 hPa"', "has not been seen on Earth\n    it lies between 850 hPa and 1090 hPa"),
    ('qnh="1013"', '"1013" has no unit; a pressure'.replace("; ", "\n    ")),
    ('isa-deviation="90 K"', "has not been seen on Earth"),
    ('wind-speed="15 kt"', 'add wind-from="270 deg true"'),
    ('wind-speed="-3 kt" wind-from="10 deg true"', "has not been seen on Earth"),
    ('wind-speed="15 kt" wind-from="400 deg true"', "between 0 deg and 360 deg"),
]


@pytest.mark.parametrize(("attributes", "teaching"), BAD_DAYS)
def test_a_day_that_cannot_be_is_refused(refusal: Refusal, attributes: str, teaching: str) -> None:
    assert teaching in refusal("<route>", f"<environment {attributes}/><route>")


BAD_PLANS = [
    ('<phase name="ENR.CLIMB"/>', '"ENR.CLIMB" is not a phase we can fly\n    did you mean'),
    ('<phase name="DEP"><checklist to="LDG.flare"/></phase>', 'no way leads from "DEP" to "LDG.flare"'),
    (
        '<phase name="DEP"><procedure><step name="x" remove="yes"/></procedure></phase>',
        'no "x" in DEP to remove',
    ),
    (
        '<phase name="DEP"><procedure><step name="x" set="flaps" to="UP"/></procedure></phase>',
        '"UP" is not a position of flaps\n    did you mean up?',
    ),
    (
        '<phase name="T/O.run"><checklist to="T/O.rotation"><item name="x" quantity="csa" at-least="VR"/></checklist></phase>',
        '"csa" is not a quantity\n    did you mean cas?',
    ),
]


@pytest.mark.parametrize(("phase", "teaching"), BAD_PLANS)
def test_a_phase_with_words_without_meaning_is_refused(refusal: Refusal, phase: str, teaching: str) -> None:
    assert teaching in refusal("<route>", f"{phase}<route>")


def test_an_action_at_a_waypoint_has_the_words_of_a_step(refusal: Refusal) -> None:
    action = '<waypoint name="WP0" station="KBO" mode="homing" speed="130 m/s CAS" level="FL50">'
    action += '<action name="slow down" set="speedbrak" to="0.5"/></waypoint>'
    assert "did you mean speedbrake?" in refusal("<!-- Table 1 -->", action)


def test_all_faults_are_told_at_once(refusal: Refusal) -> None:
    message = refusal('take-off-mass="100 t" fuel="12 t"', 'take-off-mass="100" fuel="12"')
    assert message.count("mission.xml:18:") == 2


DOCUMENTS = {
    "malformed": (b"<mission><route></mission>", "is not well-formed XML"),
    "empty": (b"", "is empty"),
    "no markup": (b"hello", "is not well-formed XML"),
    "another root": (b"<plan/>", "the document is a <plan>, not a <mission> or <variant>"),
    "a namespace": (b'<mission xmlns="urn:x" name="a"/>', "the document is a <{urn:x}mission>"),
    "too large": (b"<mission>" + b" " * 1_000_000 + b"</mission>", "is larger than 1,000,000 bytes"),
    "too many": (b'<mission name="x"><route>' + b"<waypoint/>" * 9000 + b"</route></mission>", "more than 2,000 elements"),
    "too deep": (b"<mission>" * 10_000, "depth"),
    "doctype": (b'<!DOCTYPE mission><mission name="x"/>', "a document type (<!DOCTYPE ...>) is not allowed"),
    "doctype in UTF-16": ('<!DOCTYPE mission><mission name="x"/>'.encode("utf-16"), "is not allowed"),
    "entity": (b'<!DOCTYPE m [<!ENTITY a "b">]><mission name="&a;"/>', "is not allowed"),
    "external entity": (b'<!DOCTYPE m [<!ENTITY a SYSTEM "SECRET">]><mission><route>&a;</route></mission>', "is not allowed"),
    "external subset": (b'<!DOCTYPE m SYSTEM "SECRET"><mission name="x"/>', "is not allowed"),
    "entity bomb": (
        b'<!DOCTYPE m [<!ENTITY a "aaaaaaaaaa">'
        + b"".join(b'<!ENTITY %c "%s">' % (98 + i, b"&%c;" % (97 + i) * 10) for i in range(12))
        + b']><mission name="&m;"/>',
        "entit",
    ),
    "XInclude": (
        b'<mission name="x"><xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="SECRET" parse="text"/></mission>',
        "include> does not belong into <mission>",
    ),
    "schema hint": (
        b'<mission name="x" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="SECRET"/>',
        "<mission> has no attribute",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", DOCUMENTS)
def test_what_is_no_honest_document_is_refused_and_opens_nothing(name: str, tmp_path: Path) -> None:
    content, teaching = DOCUMENTS[name]
    secret = tmp_path / "pipe"
    os.mkfifo(secret)  # whoever opened it would wait for ever
    path = tmp_path / "m.xml"
    path.write_bytes(content.replace(b"SECRET", str(secret).encode()))
    with pytest.raises(InputError) as refused:
        check_file(path)
    assert str(refused.value).startswith(f"{path}:1: ")
    assert teaching in str(refused.value)


def test_utf_16_is_read_like_any_other_encoding(tmp_path: Path, original: Path) -> None:
    path = tmp_path / "m.xml"
    path.write_bytes(original.read_text("utf-8").replace("UTF-8", "UTF-16").encode("utf-16"))
    assert check_file(path).name == "cologne-munich"


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    (tmp_path / "circuit.xml").write_text("<mission/>")
    for path, teaching in [
        (tmp_path / "circit.xml", "there is no such file\n    did you mean circuit.xml?"),
        (tmp_path, "is a folder, not a file"),
        (tmp_path / ("x" * 300), "cannot be read: File name too long"),
        (Path("/dev/null"), "is not a regular file"),
    ]:
        with pytest.raises(InputError) as refused:
            check_file(path)
        assert teaching in str(refused.value)


@pytest.mark.parametrize(
    ("override", "value"),
    [
        ("loading/take-off-mass=110 t", lambda mission: mission.loading.takeoff_mass == 110_000.0),
        ("route/waypoint[WP3]/speed=M0.42", lambda mission: mission.legs[2].speed == Speed("MACH", 0.42)),
        ("environment/isa-deviation=15 K", lambda mission: mission.environment.isa_deviation == 15.0),
        ("aircraft/speed[VR]/value=62.5 m/s CAS", lambda mission: mission.speeds["VR"].value == 62.5),
        ("name=tuesday", lambda mission: mission.name == "tuesday"),
        ("description=a = b", lambda mission: mission.description == "a = b"),
    ],
)
def test_an_override_sets_one_value(original: Path, override: str, value: Callable[[Mission], bool]) -> None:
    assert value(check_file(original, [override]))


def test_overrides_add_up_and_show_in_the_text_of_the_mission(original: Path) -> None:
    mission = check_file(original, ["environment/wind-speed=15 kt", "environment/wind-from=270 deg true"])
    assert mission.environment.wind_speed == pytest.approx(15 * KT)
    assert 'wind-speed="15 kt"' in mission.text


def test_an_override_reaches_into_phases(tmp_path: Path, original: Path) -> None:
    phase = '<phase name="T/O.run"><checklist to="T/O.rotation"><item name="rotation speed" quantity="cas" '
    phase += 'at-least="VR"/></checklist></phase><route>'
    path = tmp_path / "m.xml"
    path.write_text(original.read_text("utf-8").replace("<route>", phase), "utf-8")
    override = "phase[T/O.run]/checklist[T/O.rotation]/item[rotation speed]/at-least=VR + 5 kt"
    mission = check_file(path, [override])
    manual = read_manual("gta").with_mission(mission)
    assert manual.phases["T/O.run"].checklists[0].items[0].required == "VR + 5 kt"


@pytest.mark.parametrize(
    ("override", "teaching"),
    [
        ("loading/take-off-mass=110", 'take-off-mass="110" has no unit'),
        ("route/waypoint[WP3]/sped=M0.4", "did you mean speed?"),
        ("route/waypoint[WPX]/speed=M0.4", 'no <waypoint> is called "WPX"'),
        ("route/waypoint/speed=M0.4", "say which: waypoint[WP1]"),
        ("rout/waypoint[WP1]/speed=M0.4", "did you mean route?"),
        ("route/waypoint[WP1]/speed=300 m/s TAS", "above VMO 300 kt"),
        ("aircraft/speed[VR]/value=140 m/s CAS", "VR of 272 kt is above"),
        ("loading", "is not PATH=VALUE"),
        ("=4", "is not PATH=VALUE"),
        ("/=1", "is not a path"),
        ("route[=1", "is not PATH=VALUE"),
        ("loading/fuel=\x00", "cannot take that value"),
    ],
)
def test_a_wrong_override_is_refused_and_named(original: Path, override: str, teaching: str) -> None:
    with pytest.raises(InputError) as refused:
        check_file(original, [override])
    assert str(refused.value).startswith("--set ")
    assert teaching in str(refused.value)


@pytest.mark.parametrize(
    ("of", "line", "teaching"),
    [
        ("nothing", "", 'v.xml:1: of="nothing" is not a mission in the same folder'),
        ("../circuit", "", "v.xml:1: of has characters that do not belong there"),
        ("v", "", 'v.xml:1: of="v" is not a mission'),
        ("w", "", "w.xml:1: the document is a <variant>, not a <mission>"),
        (
            "base",
            '<set path="route/waypoint[WPX]/speed" value="M0.4"/>',
            'v.xml:2: no <waypoint> is called "WPX"',
        ),
        ("base", '<set path="loading/fuel" value="12"/>', 'v.xml:2: fuel="12" has no unit'),
        (
            "base",
            '<set path="loading/fuel" value="60 t"/>',
            "v.xml:2: 60.0 t of fuel is more than the tanks hold",
        ),
    ],
)
def test_a_wrong_variant_is_refused_where_it_is_wrong(
    tmp_path: Path, original: Path, of: str, line: str, teaching: str
) -> None:
    (tmp_path / "base.xml").write_bytes(original.read_bytes())
    (tmp_path / "w.xml").write_text('<variant name="w" of="v"/>')
    (tmp_path / "v.xml").write_text(f'<variant name="v" of="{of}">\n{line}</variant>')
    with pytest.raises(InputError) as refused:
        check_file(tmp_path / "v.xml")
    assert teaching in str(refused.value)


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ('<configuration flight-control="fly"/>', 'flight-control="fly" is not one of its choices\n    known: direct, full'),
        ('<configuration brakes="steel"/>', 'gta has no configuration "brakes"'),
        ('<failures><failure name="engine 9"/></failures>', 'gta has no failure "engine 9"\n    did you mean engine 1?'),
        ('<failures><failure name="engine 1" phase="CRS"/></failures>', 'gta has no phase "CRS"\n    did you mean ENR.CRS'),
        ('<failures><failure name="engine 1"><when quantity="cas" at-least="9 s"/></failure></failures>', '"9 s" is a time'),
        ('<failures><failure name="engine 1"/><failure name="engine 1"/></failures>', "is here twice"),
    ],
)  # fmt: skip
def test_configurations_and_failures_are_those_of_the_manual(
    part: str, message: str, refusal: Refusal
) -> None:
    assert message in refusal("</mission>", f"{part}</mission>")


@pytest.mark.parametrize(
    ("gain", "message"),
    [
        (
            'name="altitude-time" value="3 s"',
            'gta has no gain "altitude-time"\n    did you mean altitude-time-constant',
        ),
        (
            'name="altitude-time-constant" value="3 m"',
            'the gain "altitude-time-constant" is in m\n    it is in s',
        ),
        ('name="altitude-time-constant" value="3"', "is in no unit"),
        ('name="altitude-time-constant" value="three"', "is not a number"),
    ],
)
def test_gains_are_those_of_the_manual_and_in_their_unit(gain: str, message: str, refusal: Refusal) -> None:
    assert message in refusal('<aircraft name="gta"/>', f'<aircraft name="gta"><gain {gain}/></aircraft>')


def test_a_configuration_can_be_chosen_from_the_command_line(original: Path) -> None:
    mission = check_file(original, ["configuration/flight-control=direct"])
    assert mission.configuration == {"flight-control": "direct"}
    with pytest.raises(InputError, match="--set configuration/flight-control=indirect") as refused:
        check_file(original, ["configuration/flight-control=indirect"])
    assert "did you mean direct" in str(refused.value)
