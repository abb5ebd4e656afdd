"""The sensors against what their file says of them: bias, noise, resolution, lag, failures; each its own sequence."""

import math
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from harness.plant.bench import Attitude, Bench
from harness.plant.properties import SENSED

RATE = {"gps": 10.0}  # Hz; the others 30


class Sensor:
    """What systems/sensors.xml says of one sensor."""

    def __init__(self, group: str, sensor: ET.Element):
        def number(path: str) -> float:
            return float(sensor.findtext(path) or 0)

        self.name, self.true = str(sensor.get("name")), (sensor.findtext("input") or "").strip()
        self.step = 1 / RATE.get(group, 30.0)
        self.lag = 1 / number("lag") if number("lag") else 0.0
        self.noise = number("noise")
        bits = number("quantization/bits")
        self.quantum = (number("quantization/max") - number("quantization/min")) / 2**bits if bits else 0.0
        self.bias = number("bias") - self.quantum / 2


def sensors() -> list[Sensor]:
    root = ET.parse(Path(__file__).resolve().parents[2] / "systems/sensors.xml").getroot()
    return [
        Sensor(str(channel.get("name")), s)
        for channel in root.iter("channel")
        for s in channel.iter("sensor")
    ]


@pytest.fixture(scope="module")
def bench(repository: Path) -> Bench:
    """Held still in moving air, 1200 m above the ground, heading east."""
    bench = Bench(repository, "gta")
    bench.place(1000.0, Attitude(80.0, alpha=0.05), heading=math.radians(90))
    bench.put("position/terrain-elevation-asl-ft", 1000.0)
    bench.move(False)
    bench.put("sensor/active", 1.0)
    bench.run(12.0)
    return bench


@pytest.fixture(scope="module")
def record(bench: Bench) -> dict[str, np.ndarray]:
    names = [name for sensor in sensors() for name in (sensor.name, sensor.true)]
    return bench.record(100.0, names, steps=4)


@pytest.mark.parametrize("sensor", sensors(), ids=lambda sensor: sensor.name)
def test_a_sensor_shows_the_truth_with_its_bias_noise_and_resolution(
    record: dict[str, np.ndarray], sensor: Sensor
):
    every = round(sensor.step * 30)
    shown, true = (record[name][1::every] for name in (sensor.name, sensor.true))
    error = shown - true
    spread = math.hypot(sensor.noise, sensor.quantum / math.sqrt(12))
    late = abs(true[-1] - true[0]) / (100.0 * 120)  # a frame: the Earth turns under the aircraft held still
    tolerance = 5 * spread / math.sqrt(len(error)) + 0.02 * spread + 1.5 * late
    assert np.mean(error) == pytest.approx(sensor.bias, abs=tolerance)
    assert np.std(error) == pytest.approx(spread, rel=0.12)
    if sensor.quantum:
        steps = np.diff(np.unique(shown)) / sensor.quantum
        assert np.allclose(steps, np.round(steps), atol=1e-3)
    if sensor.noise > sensor.quantum / 2:  # white: no sample knows of the one before
        centred = error - np.mean(error)
        assert abs(np.mean(centred[1:] * centred[:-1])) < 0.1 * np.var(centred)


def test_each_sensor_draws_from_its_own_sequence(record: dict[str, np.ndarray], bench: Bench):
    noisy = [sensor for sensor in sensors() if sensor.noise > sensor.quantum and sensor.step < 0.05]
    errors = [record[sensor.name] - record[sensor.true] for sensor in noisy]
    together = np.corrcoef(errors) - np.eye(len(errors))
    assert np.max(np.abs(together)) < 0.12
    seeds = [bench.get(f"{sensor.name}/randomseed") for sensor in sensors()]
    assert len(set(seeds)) == len(seeds)


def test_a_lag_is_that_of_its_time_constant(repository: Path):
    lagging = [sensor for sensor in sensors() if sensor.lag >= 0.1 and "speed-fps" not in sensor.name]
    bench = Bench(repository, "gta")
    bench.place(1000.0, Attitude(80.0))
    bench.move(False)
    bench.put("sensor/active", 1.0)
    bench.run(12.0)
    before = {sensor.name: bench.get(sensor.true) for sensor in lagging}
    bench.place(1600.0, Attitude(110.0))
    record = bench.record(4.0, [sensor.name for sensor in lagging], steps=4)
    for sensor in lagging:
        end = bench.get(sensor.true)
        if abs(end - before[sensor.name]) < 50 * sensor.noise:
            continue
        share = (record[sensor.name] - sensor.bias - before[sensor.name]) / (end - before[sensor.name])
        reached = np.interp(sensor.lag, record["time"], share)
        assert reached == pytest.approx(1 - math.exp(-1), abs=0.25 * sensor.step / sensor.lag + 0.06), (
            sensor.name
        )


@pytest.mark.parametrize("group", ["air-data", "imu", "gps", "radio-altimeter"])
def test_a_failed_sensor_freezes_or_dies_with_its_flag(bench: Bench, group: str):
    root = ET.parse(Path(__file__).resolve().parents[2] / "systems/sensors.xml").getroot()
    channel = next(channel for channel in root.iter("channel") if channel.get("name") == group)
    names = [str(sensor.get("name")) for sensor in channel.iter("sensor")]
    others = [
        sensor.name for sensor in sensors() if sensor.name not in names and sensor.noise > sensor.quantum
    ]
    bench.put(f"failure/sensor-{group}", 1.0)
    bench.run(0.5)
    frozen, living = [bench.get(name) for name in names], [bench.get(name) for name in others]
    bench.run(1.0)
    assert [bench.get(name) for name in names] == frozen
    assert [bench.get(name) for name in others] != living
    assert bench.get(f"sensor/{group}-valid") == 1.0
    bench.put(f"failure/sensor-{group}", 2.0)
    bench.run(0.5)
    assert [bench.get(name) for name in names] == [0.0] * len(names)
    assert bench.get(f"sensor/{group}-valid") == 0.0
    bench.put(f"failure/sensor-{group}", 0.0)
    bench.run(12.0)
    assert bench.get(f"sensor/{group}-valid") == 1.0
    assert all(bench.get(name) != 0.0 for name in names if "rate" not in name)


def test_the_sensors_rest_until_they_are_wanted(repository: Path):
    bench = Bench(repository, "gta")
    bench.place(1000.0, Attitude(80.0))
    bench.run(1.0)
    assert {bench.get(sensor.name) for sensor in sensors()} == {0.0}


def test_the_pilot_reads_each_sensor_in_the_unit_of_what_it_stands_for():
    assert {sensor.true: sensor.name for sensor in sensors()} == SENSED
    for true, sensed in SENSED.items():
        unit = re.search(r"(fps|rad|rad_sec|psf|ft)$", sensed)
        if unit and true != "atmosphere/pressure-altitude":
            assert true.endswith(unit[1]), true
