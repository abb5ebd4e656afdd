"""Pictures of a flight for a report, drawn from its log alone. The same log gives the same bytes."""

from pathlib import Path

from matplotlib import style

from harness.analysis.plots.annunciator import modes
from harness.analysis.plots.chart import route_map
from harness.analysis.plots.look import RC, save
from harness.analysis.plots.script import ground_track, script_profile
from harness.analysis.plots.timeline import profile
from harness.log import Run
from harness.mission.reader import read_mission

__all__ = ["draw_all", "draw_script", "modes", "profile", "route_map"]

FEWEST_ROWS = 3


def draw_all(run: Run, folder: Path) -> tuple[Path, ...]:
    """Draw route_map.png, profile.png and modes.png into the folder of the run, and return their paths.

    The route is read from the folder's mission.xml. A flight that ended before there is anything to draw gets
    no pictures.
    """
    if len(run.history["time"]) < FEWEST_ROWS:
        return ()
    mission = read_mission(folder / "mission.xml")
    paths = []
    with style.context(["default", RC]):
        for name, figure in (
            ("route_map", route_map(run, mission)),
            ("profile", profile(run)),
            ("modes", modes(run)),
        ):
            paths.append(folder / f"{name}.png")
            save(figure, paths[-1])
    return tuple(paths)


def draw_script(run: Run, folder: Path) -> tuple[Path, ...]:
    """Draw track.png and profile.png of a replayed script into its folder, and return their paths."""
    if len(run.history["time"]) < FEWEST_ROWS:
        return ()
    paths = []
    with style.context(["default", RC]):
        for name, figure in (("track", ground_track(run)), ("profile", script_profile(run))):
            paths.append(folder / f"{name}.png")
            save(figure, paths[-1])
    return tuple(paths)
