"""The navigation database: what is in it, what it says of what is not, and the ILS made from a runway."""

from math import atan, tan

import pytest

from harness.navigation import database
from harness.navigation.database import Ils
from harness.units import DEG, FT
from harness.world import earth

NAV = database.load()
EVERY_RUNWAY = [runway for airport in NAV.airport_names() for runway in NAV.runways(airport)]


def test_the_tables_are_read_once():
    assert database.load() is NAV


def test_a_station_has_its_chart_values():
    cola = NAV.station("COL")
    assert (cola.name, cola.kind, cola.has_bearing, cola.has_dme) == ("Cola", "VORTAC", True, True)
    assert cola.latitude == pytest.approx(50.783501 * DEG)
    assert cola.elevation == pytest.approx(990 * FT)
    assert cola.frequency == pytest.approx(108.8e6)
    assert cola.declination == pytest.approx(0.93 * DEG)


@pytest.mark.parametrize("ident", ["COL", "RID", "NSN", "ILM", "ANS", "RTB", "ALB", "WLD", "MBG", "MDF"])
def test_every_station_of_the_reconstructed_mission_is_there(ident):
    assert NAV.station(ident).has_bearing


@pytest.mark.parametrize(
    ("ident", "bearing", "distance", "ndb"),
    [
        ("COL", 1, 1, 0),
        ("RID", 1, 1, 0),
        ("WYP", 1, 0, 0),
        ("NSN", 1, 0, 1),
        ("DMN", 0, 1, 0),
        ("ERD", 1, 1, 0),
        ("OBI", 1, 1, 1),
    ],
)
def test_the_kind_says_what_can_be_received(ident, bearing, distance, ndb):
    station = NAV.station(ident)
    assert (station.has_bearing, station.has_dme, station.is_ndb) == (bearing, distance, ndb)


def test_only_ndbs_lack_an_elevation():
    stations = NAV.stations()
    assert all(station.is_ndb for station in stations if station.elevation == 0)
    assert len(stations) > 100


@pytest.mark.parametrize(
    ("name", "teaching"),
    [
        ("CLO", "no station 'CLO' in the navigation database; did you mean LNO or COL?"),
        ("SBG", "2 stations are called SBG; write SBG NDB or SBG VOR-DME"),
        ("COL NDB", "no station 'COL NDB' in the navigation database; did you mean COL VORTAC?"),
        ("", "no station '' in the navigation database"),
    ],
)
def test_an_unknown_station_is_refused_with_what_would_be_right(name, teaching):
    with pytest.raises(LookupError) as refusal:
        NAV.station(name)
    assert refusal.value.args[0] == teaching


def test_two_stations_with_one_ident_are_told_apart_by_their_kind():
    assert NAV.station("sbg VOR-DME").frequency == pytest.approx(113.8e6)
    assert NAV.station("SBG NDB").frequency == pytest.approx(382e3)


def test_a_runway_of_2010_is_found_under_its_old_name():
    assert NAV.runway("EDDK", "14L") is NAV.runway("eddk", "13l")
    assert NAV.runway("EDDF", "25R").designator == "25R"  # today's 25R, although 25C was 25R in 2010


def test_an_unknown_runway_is_refused_with_the_list_of_runways():
    with pytest.raises(LookupError, match=r"EDDM has no runway '26C'; it has 08L, 08R, 26L, 26R"):
        NAV.runway("EDDM", "26C")
    with pytest.raises(LookupError, match=r"no airport 'EDMM' .*did you mean EDMO or EDDM"):
        NAV.runway("EDMM", "26L")


@pytest.mark.parametrize("runway", EVERY_RUNWAY, ids=lambda r: f"{r.airport}-{r.designator}")
def test_a_runway_is_as_long_and_points_where_its_records_say(runway):
    row = next(
        row
        for row in database._rows("runways.csv")
        if (row["airport"], row["designator"]) == (runway.airport, runway.designator)
    )
    assert runway.length == pytest.approx(float(row["length_ft"]) * FT, rel=0.01)
    assert runway.true_heading / DEG == pytest.approx(int(runway.designator[:2]) * 10, abs=8)
    assert abs(runway.slope) < 0.02


def test_points_on_a_runway_undo_offsets():
    runway = NAV.runway("EDDK", "13L")
    assert runway.offset(*runway.point(1200, -7)) == pytest.approx((1200, -7), abs=1e-3)
    assert runway.offset(*runway.point(-20_000, 300)) == pytest.approx((-20_000, 300), abs=1)
    assert runway.offset(runway.end_latitude, runway.end_longitude) == pytest.approx(
        (runway.length, 0), abs=1e-2
    )


@pytest.mark.parametrize("runway", EVERY_RUNWAY, ids=lambda r: f"{r.airport}-{r.designator}")
def test_an_ils_has_the_geometry_of_annex_10(runway):
    ils = Ils(runway)
    along, across = runway.offset(ils.localizer_latitude, ils.localizer_longitude)
    assert (along, across) == pytest.approx((runway.length + 300, 0), abs=0.01)
    assert tan(ils.localizer_full_scale) * along == pytest.approx(350 * FT)
    assert 2 * ils.localizer_full_scale <= 6 * DEG  # 3.1.3.7.1: no course sector wider than 6 degrees
    crossing = ils.aim_elevation + ils.aim_distance * tan(ils.GLIDE_ANGLE) - runway.elevation
    assert crossing == pytest.approx(15)
    assert 230 < ils.aim_distance < 350
    _, _, abeam = earth.inverse(*runway.point(ils.aim_distance), ils.glide_latitude, ils.glide_longitude)
    assert abeam == pytest.approx(120, abs=0.01)


def test_the_localizer_of_a_4_km_runway_is_1_4_degrees_wide():
    # 350 ft at 4 299 m, by hand
    assert Ils(NAV.runway("EDDM", "26L")).localizer_full_scale == pytest.approx(
        atan(106.68 / 4299.4), abs=1e-5
    )
