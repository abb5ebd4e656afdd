"""All that a flight wrote into the simulator: with it, and the aircraft, the flight can be flown again bit for bit."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from harness.errors import InputError

FILE = "inputs.parquet"
BEFORE = -2  # step of what is written before the initial conditions are applied
AT_START = -1  # step of what is written between them and the first frame


class Write(NamedTuple):
    """A property written: before the first frame of pilot step `step`, or at one of the steps named above.

    `value` is in the simulator's own unit of the property.
    """

    step: int
    name: str
    value: float


@dataclass
class Inputs:
    """What a flight wrote, in the order of writing.

    `rate` is frames a second, `frames_per_step` the frames of a pilot step, `steps` the pilot steps flown.
    """

    rate: int = 0
    frames_per_step: int = 0
    steps: int = 0
    writes: list[Write] = field(default_factory=list)


def write_inputs(inputs: Inputs, folder: Path) -> None:
    """Write inputs.parquet into the folder of a run. Raises OSError."""
    import pyarrow as pa
    from pyarrow import parquet

    facts = {name: str(getattr(inputs, name)) for name in ("rate", "frames_per_step", "steps")}
    schema = pa.schema(
        [("step", pa.int32()), ("name", pa.dictionary(pa.int32(), pa.string())), ("value", pa.float64())],
        metadata=facts,
    )
    steps, names, values = zip(*inputs.writes, strict=True) if inputs.writes else ((), (), ())
    columns = [
        pa.array(steps, pa.int32()),
        pa.array(names, pa.string()).dictionary_encode(),
        pa.array(values, pa.float64()),
    ]
    parquet.write_table(pa.Table.from_arrays(columns, schema=schema), folder / FILE, compression="zstd")


def read_inputs(folder: Path) -> Inputs:
    """Read them back. Raises InputError when the folder has none, or not whole."""
    import pyarrow as pa
    from pyarrow import parquet

    file = folder / FILE
    try:
        table = parquet.read_table(file)
        facts = {name.decode(): int(value) for name, value in table.schema.metadata.items()}
        columns = (table.column(name).to_pylist() for name in ("step", "name", "value"))
        return Inputs(
            facts["rate"],
            facts["frames_per_step"],
            facts["steps"],
            [Write(*row) for row in zip(*columns, strict=True)],
        )
    except FileNotFoundError:
        what = "the folder of the run has no record of what was written into the simulator"
    except (OSError, KeyError, ValueError, TypeError, pa.ArrowException) as error:
        what = f"is not a record of what was written into the simulator: {error}"
    raise InputError(
        what, file=file, remedy="fly the mission again: `harness fly` keeps it in the run's folder."
    )
