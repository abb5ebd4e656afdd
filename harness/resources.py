"""Finds missions, aircraft and scripts by name, from any folder, in a clone and in an installed wheel."""

import hashlib
import re
from html import unescape
from os import PathLike, fspath
from pathlib import Path

from harness.errors import InputError, did_you_mean

PACKAGE = Path(__file__).resolve().parent


def root() -> Path:
    """The JSBSim root: aircraft, engine, systems, missions, scripts. A wheel carries it in the package."""
    carried = PACKAGE / "data"
    return carried if carried.is_dir() else PACKAGE.parent


def missions() -> dict[str, Path]:
    """The missions that come with the harness, by name."""
    return _named(root() / "missions")


def studies() -> dict[str, Path]:
    """The studies that come with the harness, by name."""
    return _named(root() / "missions" / "studies")


def scripts() -> dict[str, Path]:
    """The JSBSim scripts that come with the harness, by name."""
    return _named(root() / "scripts")


def aircraft() -> dict[str, Path]:
    """The main files of the aircraft, by name: those with a flight manual."""
    manuals = sorted((root() / "aircraft").glob("*/flight-manual.xml"))
    return {manual.parent.name: manual.with_name(f"{manual.parent.name}.xml") for manual in manuals}


def find_mission(mission: str | PathLike[str]) -> Path:
    """The file of a mission given by name or by path.

    Raises InputError when there is none.
    """
    return _find("mission", mission, missions())


def find_study(study: str | PathLike[str]) -> Path:
    """The file of a study given by name or by path.

    Raises InputError when there is none.
    """
    return _find("study", study, studies())


def find_script(script: str | PathLike[str]) -> Path:
    """The file of a JSBSim script given by name or by path.

    Raises InputError when there is none.
    """
    return _find("script", script, scripts())


def _find(noun: str, wanted: str | PathLike[str], known: dict[str, Path]) -> Path:
    text = fspath(wanted)
    if text in known:
        return known[text]
    path = Path(text)
    try:
        if path.is_file():
            return path
        exists = path.exists()
    except (OSError, ValueError):  # too long, or a NUL character
        exists = False
    if exists and text:
        raise InputError("is not a file.", file=text, remedy=f"give a {noun}'s name or its XML file.")
    close = did_you_mean(path.stem if path.suffix == ".xml" else text, known)
    raise InputError(
        f'there is no {noun} "{text[:200]}", neither a name nor a file.',
        remedy=f"{close}\n    harness list shows all of them.".lstrip(),
    )


def description(path: Path) -> str:
    """What a mission, an aircraft or a script says about itself, on one line."""
    found = re.search(r"<description>(.*?)</description>", path.read_text("utf-8"), re.DOTALL)
    return " ".join(unescape(found[1]).split()) if found else ""


def fingerprint(name: str) -> str:
    """SHA-256 over the names and the bytes of every XML file an aircraft is made of."""
    files = set((root() / "aircraft" / name).rglob("*.xml"))
    unread = list(files)
    while unread:
        for reference in re.findall(r'\bfile\s*=\s*"([^"]+)"', unread.pop().read_text("utf-8")):
            for folder in ("engine", "systems"):
                file = root() / folder / f"{reference.removesuffix('.xml')}.xml"
                if file.is_file() and file not in files:
                    files.add(file)
                    unread.append(file)
    digest = hashlib.sha256()
    for path, file in sorted((file.relative_to(root()).as_posix(), file) for file in files):
        content = file.read_bytes()
        digest.update(f"{path} {len(content)}\n".encode() + content)
    return digest.hexdigest()


def _named(folder: Path) -> dict[str, Path]:
    return {path.stem: path for path in sorted(folder.glob("*.xml"), key=lambda path: path.stem)}
