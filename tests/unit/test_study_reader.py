"""Studies: what a file may say, which points follow, and how each mistake is told."""

import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import chisquare, kstest

from harness import resources
from harness.errors import InputError
from harness.instructor import check_kept
from harness.manual import PropertySetting
from harness.studies import design
from harness.studies.cases import Cases
from harness.studies.model import Study
from harness.studies.reader import read_study
from harness.studies.report import sobol
from harness.units import parse

Read = Callable[..., Study]
FUEL = '<factor path="loading/fuel" name="fuel"><values list="5 t, 6 t, 7000 kg"/></factor>'
MASS = '<factor path="loading/take-off-mass" name="mass"><range from="89 t" to="124 t" step="7 t"/></factor>'
WING = (
    '<factor path="aircraft/property[metrics/Sw-sqft]/value" name="wing_sqft"><values list="2400"/></factor>'
)
OUTPUT = '<output name="fuel_burned_kg"/>'


@pytest.fixture
def read(tmp_path: Path) -> Read:
    def read(*parts: str, attributes: str = 'name="s" of="hop"') -> Study:
        path = tmp_path / "s.xml"
        path.write_text(f"<study {attributes}>\n" + "\n".join((*parts, OUTPUT)) + "\n</study>", "utf-8")
        return read_study(path)

    return read


def numbers(study: Study) -> list[list[float | str | None]]:
    return [[level and level.value for level in point] for point in design.points(study)]


def sampled(kind: str, n: int, *spreads: str, seed: int = 1) -> list[str]:
    paths = ("loading/fuel", "loading/take-off-mass", "environment/qnh")
    factors = [f'<factor path="{p}">{s}</factor>' for p, s in zip(paths, spreads, strict=False)]
    return [*factors, f'<design kind="{kind}" n="{n}" seed="{seed}"/>']


def test_a_grid_has_every_combination_and_the_last_factor_varies_fastest(read: Read) -> None:
    study = read(MASS, FUEL)
    assert design.count(study) == 18
    found = numbers(study)
    assert found[:4] == [[89e3, 5e3], [89e3, 6e3], [89e3, 7e3], [96e3, 5e3]]
    assert found[-1] == [124e3, 7e3]
    assert [factor.column for factor in study.factors] == ["mass_kg", "fuel_kg"]
    first = next(design.points(study))
    assert [level and level.text for level in first] == ["89 t", "5 t"]


def test_one_at_a_time_begins_with_the_mission_as_it_is(read: Read) -> None:
    study = read(FUEL, MASS, '<design kind="one-at-a-time"/>')
    found = numbers(study)
    assert design.count(study) == len(found) == 1 + 3 + 6
    assert found[0] == [None, None]
    assert found[1] == [5e3, None]
    assert found[-1] == [None, 124e3]


def test_equal_values_are_one_level(read: Read) -> None:
    values = '<values list="100 t, 100 t, 100000 kg, 90 t"/>'
    study = read(f'<factor path="loading/take-off-mass">{values}</factor>')
    assert numbers(study) == [[100e3], [90e3]]


def test_steps_are_free_of_the_noise_of_binary_numbers(read: Read) -> None:
    study = read('<factor path="loading/fuel"><range from="0.1 t" to="0.7 t" step="0.1 t"/></factor>')
    texts = [level.text for (level,) in design.points(study) if level]
    assert texts == ["0.1 t", "0.2 t", "0.3 t", "0.4 t", "0.5 t", "0.6 t", "0.7 t"]


def test_words_and_speeds_with_their_kind_stay_as_they_are(read: Read) -> None:
    study = read(
        '<factor path="route/waypoint[Allersberg]/level" name="level"><values list="FL80, FL100"/></factor>',
        '<factor path="route/waypoint[Allersberg]/speed" name="speed"><range from="230 kt CAS" to="240 kt CAS"'
        ' step="10 kt CAS"/></factor>',
    )
    level, speed = list(design.points(study))[-1]
    assert level is not None
    assert speed is not None
    assert (level.text, level.value, speed.text) == ("FL100", "FL100", "240 kt CAS")
    assert speed.value == pytest.approx(240 * 1852 / 3600)
    assert [factor.column for factor in study.factors] == ["level", "speed_mps"]


def test_a_latin_hypercube_has_one_sample_in_every_stratum(read: Read) -> None:
    spread = '<range from="80 t" to="120 t"/>'
    study = read(*sampled("latin-hypercube", 50, '<range from="4 t" to="8 t"/>', spread))
    fuel, mass = np.array(numbers(study), float).T
    assert sorted((fuel - 4e3) // 80) == list(range(50))
    assert sorted((mass - 80e3) // 800) == list(range(50))


def test_distributions_have_their_moments(read: Read) -> None:
    study = read(
        *sampled(
            "sobol",
            2048,
            '<normal mean="6 t" standard-deviation="500 kg"/>',
            '<triangular from="80 t" mode="90 t" to="120 t"/>',
            '<lognormal median="1000 hPa" sigma="0.01"/>',
        )
    )
    assert design.count(study) == 2048 * 5
    points = np.array(numbers(study), float)[:2048]
    fuel, mass, qnh = points.T
    # closed forms; a scrambled Sobol sequence of 2048 integrates smooth functions to about 1e-4
    assert fuel.mean() == pytest.approx(6000, rel=1e-3)
    assert fuel.std() == pytest.approx(500, rel=5e-3)
    assert mass.mean() == pytest.approx((80e3 + 90e3 + 120e3) / 3, rel=1e-4)
    assert mass.var() == pytest.approx(
        (80**2 + 90**2 + 120**2 - 80 * 90 - 80 * 120 - 90 * 120) / 18 * 1e6, rel=5e-3
    )
    assert np.median(qnh) == pytest.approx(1e5, rel=1e-4)
    assert qnh.mean() == pytest.approx(1e5 * math.exp(0.01**2 / 2), rel=1e-5)


def test_a_sobol_design_is_saltellis_scheme(read: Read) -> None:
    uniform = '<range from="0 t" to="1 t"/>'
    study = read(*sampled("sobol", 8, uniform, uniform))
    a, b, first, second = np.array(numbers(study), float).reshape(4, 8, 2)
    assert (first == np.column_stack((b[:, 0], a[:, 1]))).all()
    assert (second == np.column_stack((a[:, 0], b[:, 1]))).all()


def _normal(z: float) -> float:
    return 0.5 * (1.0 + math.erf(z / math.sqrt(2.0)))


@pytest.mark.parametrize(
    ("spread", "below"),
    [
        ('<range from="4 t" to="8 t"/>', lambda x: (x - 4e3) / 4e3),
        ('<normal mean="6 t" standard-deviation="500 kg"/>', lambda x: _normal((x - 6e3) / 500.0)),
        (
            '<normal mean="6 t" standard-deviation="1 t" from="5 t" to="8 t"/>',
            lambda x: (_normal((x - 6e3) / 1e3) - _normal(-1.0)) / (_normal(2.0) - _normal(-1.0)),
        ),
        ('<lognormal median="6 t" sigma="0.2"/>', lambda x: _normal(math.log(x / 6e3) / 0.2)),
        (
            '<triangular from="4 t" mode="5 t" to="8 t"/>',
            lambda x: (x - 4e3) ** 2 / 4e6 if x < 5e3 else 1.0 - (8e3 - x) ** 2 / 12e6,
        ),
    ],
)
@pytest.mark.parametrize("kind", ["monte-carlo", "latin-hypercube", "sobol"])
def test_what_is_flown_is_distributed_as_the_file_says(
    read: Read, kind: str, spread: str, below: Callable[[float], float]
) -> None:
    """Against the closed forms, by the samples' own texts, which are what a case is given."""
    n = 1024
    study = read(*sampled(kind, n, spread, '<range from="80 t" to="120 t"/>', seed=7))
    flown, other = np.array(
        [[parse(level.text, "mass") for level in point if level] for point in design.points(study)]
    ).T
    assert flown.tolist() == [row[0] for row in numbers(study)]  # what the table says
    shares = np.array([below(x) for x in flown[:n]])
    assert kstest(shares, "uniform").pvalue > 0.01
    assert abs(np.corrcoef(shares, other[:n])[0, 1]) < 4.0 / math.sqrt(n)
    if kind != "monte-carlo":  # one in every stratum; of a Sobol design in its first sample and in its second
        for block in (flown[:n], flown[n : 2 * n]) if kind == "sobol" else (flown,):
            strata = np.floor(n * np.array([below(x) for x in block]))
            assert sorted(strata) == list(range(n))


def test_words_and_levels_are_equally_likely(read: Read) -> None:
    study = read(*sampled("monte-carlo", 3000, '<values list="5 t, 6 t, 7 t"/>', seed=7))
    counts = np.unique(np.array(numbers(study), float), return_counts=True)[1]
    assert chisquare(counts).pvalue > 0.01


def test_sobol_indices_are_those_of_ishigamis_function(read: Read) -> None:
    """Closed forms, a = 7, b = 0.1: Ishigami and Homma, ISUMA 1990, as in Saltelli et al. (2008), p. 196."""
    uniform = '<range from="0 t" to="1 t"/>'
    study = read(*sampled("sobol", 4096, uniform, uniform, '<range from="0 hPa" to="1 hPa"/>', seed=3))
    x, y, z = math.pi * (2.0 * design.samples(study).T - 1.0)
    found = list(sobol(study, np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)).values())
    assert [of["first"] for of in found] == pytest.approx([0.3139, 0.4424, 0.0], abs=0.02)
    assert [of["total"] for of in found] == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.02)


def test_cut_normals_stay_within_and_directions_wrap(read: Read) -> None:
    wind = '<factor path="environment/wind-from"><normal mean="2 deg true" standard-deviation="20 deg"/></factor>'
    cut = '<factor path="loading/fuel"><normal mean="6 t" standard-deviation="2 t" from="5 t" to="7 t"/></factor>'
    study = read(wind, cut, '<design kind="monte-carlo" n="100" seed="3"/>')
    directions, fuel = np.array(numbers(study), float).T
    assert ((directions >= 0) & (directions <= 2 * math.pi)).all()
    assert (directions > math.pi).any()
    assert ((fuel >= 5e3) & (fuel <= 7e3)).all()


def test_a_seed_gives_the_same_samples_and_another_seed_others(read: Read) -> None:
    uniform = '<range from="4 t" to="8 t"/>'
    for kind in ("monte-carlo", "latin-hypercube", "sobol"):
        one, again, other = (numbers(read(*sampled(kind, 8, uniform, seed=seed))) for seed in (1, 1, 2))
        assert one == again != other


def test_keys_and_seeds_follow_from_what_goes_in(read: Read) -> None:
    study = read(FUEL)
    one, again = list(Cases(study)), list(Cases(study))
    assert one == again
    assert len({case.key for case in one}) == len({case.seed for case in one}) == 3
    fixed = list(Cases(read(FUEL, '<set path="environment/qnh" value="1000 hPa"/>')))
    assert not {case.key for case in one} & {case.key for case in fixed}
    uniform = '<range from="7 t" to="8 t"/>'
    first, second = (Cases(read(*sampled("monte-carlo", 2, uniform, seed=seed))) for seed in (1, 2))
    assert {case.seed for case in first}.isdisjoint(case.seed for case in second)


def test_numbers_of_the_aircraft_are_factors_too(read: Read) -> None:
    gain = '<factor path="aircraft/gain[taxi-speed]/value" name="taxi"><values list="5 m/s, 6 m/s"/></factor>'
    speed = (
        '<factor path="aircraft/speed[VR]/value" name="VR"><values list="118 kt CAS, 125 kt CAS"/></factor>'
    )
    cases = Cases(read(WING, gain, speed))
    assert cases.count == 4
    assert [path for path, _ in cases.request(next(iter(cases)))["overrides"]] == [
        "aircraft/property[metrics/Sw-sqft]/value",
        "aircraft/gain[taxi-speed]/value",
        "aircraft/speed[VR]/value",
    ]


def test_equal_samples_are_cases_of_their_own(read: Read) -> None:
    study = read(
        '<factor path="loading/fuel"><values list="7 t"/></factor>', '<design kind="monte-carlo" n="5"/>'
    )
    assert len({case.key for case in Cases(study)}) == 5


@pytest.mark.parametrize("name", resources.studies())
def test_the_shipped_studies_are_fit_to_run(name: str) -> None:
    cases = Cases(read_study(resources.find_study(name)))
    assert 2 <= cases.count <= 100
    assert cases.study.description


@pytest.mark.parametrize(
    ("parts", "line", "words"),
    [
        ([FUEL.replace("loading/fuel", "loading/fule")], 2, '"fule"'),
        ([FUEL.replace("loading/fuel", "cargo/fuel")], 2, "<cargo>"),
        ([FUEL.replace("5 t, 6 t, 7000 kg", "5, 6, 7")], 2, "has no unit"),
        ([FUEL.replace("5 t, 6 t, 7000 kg", "5 t, 6 kt")], 2, "is a speed"),
        ([FUEL.replace("5 t, 6 t, 7000 kg", "")], 2, "is empty"),
        ([FUEL.replace("5 t, 6 t, 7000 kg", "5 t,,6 t")], 2, "empty place"),
        ([MASS.replace("89 t", "89")], 2, "does not fit"),
        (
            [MASS.replace('"89 t"', '"89"').replace('"124 t"', '"124"').replace('"7 t"', '"7"')],
            2,
            "has no unit",
        ),
        ([MASS.replace("124 t", "80 t")], 2, "the range is empty"),
        ([MASS.replace("7 t", "0 t")], 2, "the range is empty"),
        ([MASS.replace("7 t", "7 bananas")], 2, 'the unit "bananas" is not known'),
        ([MASS.replace("89 t", "many")], 2, "is not a number"),
        ([MASS.replace(' step="7 t"', "")], 2, "needs levels"),
        ([FUEL, FUEL], 3, "here twice"),
        ([FUEL, MASS.replace('"mass"', '"fuel"')], 3, "would be there twice"),
        ([FUEL, '<design kind="gird"/>'], 3, "did you mean grid"),
        ([FUEL, '<design kind="grid" n="5"/>'], 3, "as many cases as"),
        ([FUEL, '<design kind="monte-carlo"/>'], 3, 'lacks its "n"'),
        ([FUEL, '<design kind="monte-carlo" n="ten"/>'], 3, "not a whole number"),
        ([FUEL, '<design kind="sobol" n="100"/>'], 3, "write 64 or 128"),
        ([FUEL, '<output name="feul_burned_kg"/>'], 3, "did you mean fuel_burned_kg"),
        ([FUEL, '<output name="wall_time_s"/>'], 3, 'no output "wall_time_s"'),
        ([FUEL, '<output name="phases[DPE].fuel"/>'], 3, "did you mean phases[DEP].fuel"),
        ([FUEL, '<output name="phases"/>'], 3, "known: phases[APP.final].distance"),
        ([FUEL, '<output name="accelerate_stop_distance_m"/>'], 3, "mean rejected_take_off.accelerate_stop"),
        ([FUEL, '<output name="rejected_take_off"/>'], 3, "did you mean rejected_take_off.stop_s"),
        ([FUEL, '<output name="rejected_take_off/stop_s"/>'], 3, "did you mean rejected_take_off.stop_s"),
        ([FUEL, '<set path="environment/qnh" value="1000"/>'], 3, "has no unit"),
        (['<factor path="loading/fuel"/>'], 2, "0 spreads"),
        ([], 1, "varies nothing"),
        ([WING.replace("Sw", "Sx")], 2, "has no property metrics/Sx-sqft"),
        ([WING.replace("metrics/Sw-sqft", "aero/alpha-rad")], 2, "cannot be written"),
        ([WING.replace("2400", "2400 m2")], 2, "is an area"),
    ],
)
def test_each_mistake_is_told_where_it_is(
    read: Read, tmp_path: Path, parts: list[str], line: int | None, words: str
) -> None:
    with pytest.raises(InputError) as caught:
        Cases(read(*parts))
    place = f"{tmp_path / 's.xml'}:{line}: " if line else f"{tmp_path / 's.xml'}: "
    assert str(caught.value).startswith(place)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ('name="s" of="hopp"', "did you mean hop?"),
        ('name="s" of="hop" kind="fligt"', "did you mean flight?"),
        ('name="s" of="hop" wall-limit="5"', "has no unit"),
        ('name="s" of="hop" wall-limit="0 s"', "more than zero"),
        ('name="a/b" of="hop"', "characters that do not belong there"),
        ('name="s"', 'lacks its "of"'),
    ],
)
def test_a_study_says_what_it_is_of(read: Read, attributes: str, words: str) -> None:
    with pytest.raises(InputError) as caught:
        read(FUEL, attributes=attributes)
    assert words in str(caught.value)


def test_a_property_that_does_not_keep_its_value_made_no_difference_and_is_refused() -> None:
    plant = SimpleNamespace(fdm=SimpleNamespace(get_property_value={"kept": 2.0, "computed": 3.0}.get))
    check_kept(plant, [PropertySetting("kept", 2.0, "s.xml", 2)])  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"s.xml:3: the property computed was set to 2 and is 3"):
        check_kept(plant, [PropertySetting("computed", 2.0, "s.xml", 3)])  # type: ignore[arg-type]
