"""What a person sees of a study: how far it is, and what it came to. The only user of rich."""

import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Self, TextIO

if TYPE_CHECKING:
    from rich.progress import Progress

EVERY = 15.0  # s between two plain lines


class StudyProgress:
    """Shows on `stream` how far a study is: a bar on a terminal, plain lines elsewhere. Used as a context."""

    def __init__(self, name: str, stream: TextIO) -> None:
        self._name = name
        self._stream = stream
        self._bar: Progress | None = None
        self._begin = self._shown = time.monotonic()
        self._first: int | None = None

    def __call__(self, done: int, total: int, failed: int) -> None:
        """Show that `done` of `total` cases are there, `failed` of which did not succeed."""
        if self._first is None:
            self._first = done
            self._begin = time.monotonic()
            if self._stream.isatty():
                self._bar = self._started(total)
        note = f"{failed} failed" if failed else ""
        if self._bar is not None:
            self._bar.update(self._bar.task_ids[0], completed=done, note=note)
            return
        now = time.monotonic()
        if now - self._shown >= EVERY:
            self._shown = now
            each = (now - self._begin) / (done - self._first) if done > self._first else 0.0
            left = f"about {_clock((total - done) * each)} left" if each else ""
            told = ", ".join(filter(None, (f"{done} of {total} cases", note, left)))
            self._stream.write(f"{self._name}: {told}\n")
            self._stream.flush()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.stop()

    def _started(self, total: int) -> "Progress":
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        bar = Progress(
            TextColumn(self._name),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            TextColumn("{task.fields[note]}"),
            console=Console(file=self._stream),
            refresh_per_second=4,
        )
        bar.add_task(self._name, total=total, completed=self._first or 0, note="")
        bar.start()
        return bar


def _clock(seconds: float) -> str:
    minutes, second = divmod(round(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{second:02d}"


def describe_study(summary: Mapping[str, Any]) -> str:
    """A summary for people."""
    counts = ", ".join(f"{number} {status}" for status, number in summary["counts"].items())
    lines = [f"{summary['study']}: {summary['cases']} cases, {counts}"]
    statistics = summary["statistics"]
    if statistics:
        head = ("n", "mean", "standard_deviation", "minimum", "p5", "p50", "p95", "maximum")
        titles = ("n", "mean", "st.dev.", "min", "p5", "p50", "p95", "max")
        width = max(len(name) for name in statistics)
        lines.append("  " + " " * width + "".join(f"{title:>11}" for title in titles))
        for name, found in statistics.items():
            lines.append(f"  {name:<{width}}" + "".join(f"{_number(found.get(key)):>11}" for key in head))
    for output, indices in summary["sobol"].items():
        lines.append(f"  Sobol indices of {output}, first order and total:")
        lines += [f"    {name:<36}{of['first']:8.3f}{of['total']:8.3f}" for name, of in indices.items()]
    for reason, number in summary["reasons"].items():
        lines.append(f"  {number} x {reason[:200]}")
    lines.append(f"  kept in {summary['table']}")
    return "\n".join(lines)


def _number(value: float | None) -> str:
    return "-" if value is None else str(value) if isinstance(value, int) else f"{value:.6g}"
