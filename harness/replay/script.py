"""Reading a JSBSim script before JSBSim does, and setting the stage: a root in which it can do no harm.

JSBSim opens the sockets that an aircraft or a script names, and writes where their <output> says. So both are copied
without their sockets, and with outputs that are plain file names; everything else in the root is linked, not copied.
"""

from pathlib import Path
from typing import NamedTuple, cast

from harness import resources
from harness.errors import InputError, did_you_mean
from harness.xml_source import Element, line_of, read_document, write_document

LARGEST_SCRIPT = 50_000_000  # bytes; an exported mission has one or two million
MOST_ELEMENTS = 500_000
OUTSIDE = "script"  # folder of a script that is not in its root
SOCKETS = ("SOCKET", "FLIGHTGEAR", "TERRASYNC", "QTJSBSIM")


class Script(NamedTuple):
    """A JSBSim script: the file, its root element, the aircraft it uses, its step (s, 0: none given) and the root.

    `root` is the folder with the aircraft/ that it uses.
    """

    path: Path
    document: Element
    aircraft: str
    dt: float
    root: Path


def read_script(name: str, root: Path | None) -> Script:
    """Find a script by name or by path, and the root it belongs to.

    Without a `root` it is the nearest folder above the script that has its aircraft, else the harness's own.
    Raises InputError.
    """
    path = resources.find_script(name)
    document = read_document(path, largest=LARGEST_SCRIPT, most_elements=MOST_ELEMENTS, entities=True)
    if document.tag != "runscript":
        raise InputError(
            f"the document is a <{document.tag}>, not a <runscript>",
            file=path,
            line=line_of(document),
            remedy="a mission is flown with: harness fly MISSION" if document.tag == "mission" else "",
        )
    use, run = document.find("use"), document.find("run")
    if use is None or not use.get("aircraft"):
        line = line_of(document if use is None else use)
        raise InputError(
            "the script names no aircraft",
            file=path,
            line=line,
            remedy='<use aircraft="gta" initialize="parked"/>',
        )
    if run is None:
        raise InputError("the script has no <run>", file=path, line=line_of(document))
    try:
        dt = float(run.get("dt", "0"))
    except ValueError:
        raise InputError(f'dt "{run.get("dt")}" is not a number', file=path, line=line_of(run)) from None
    aircraft = cast(str, use.get("aircraft"))
    return Script(path, document, aircraft, dt, _root_of(path, aircraft, root, line_of(use)))


def _root_of(path: Path, aircraft: str, given: Path | None, line: int) -> Path:
    candidates = [given] if given else [*path.resolve().parents, resources.root()]
    for root in candidates:
        if (root / "aircraft" / aircraft / f"{aircraft}.xml").is_file():
            return root.resolve()
    looked = given or resources.root()
    known = [file.parent.name for file in (looked / "aircraft").glob("*/*.xml")]
    raise InputError(
        f'there is no aircraft "{aircraft}" in {looked / "aircraft"}',
        file=path,
        line=line,
        remedy=did_you_mean(aircraft, set(known)) or "give the JSBSim root that has it: --root DIR",
    )


def line_naming(script: Script, name: str) -> int:
    """The first line of the script whose element names a property; 0 when none does."""
    for element in script.document.iter("property", "set", "condition", "independentVar"):
        if name in (element.get("name", ""), *(element.text or "").split()):
            return line_of(element)
    return 0


def stage(script: Script, folder: Path, *, sockets: bool) -> Path:
    """Make a root in `folder` for a run of the script, and return the script's file in it. Raises OSError."""
    main = script.root / "aircraft" / script.aircraft / f"{script.aircraft}.xml"
    aircraft = read_document(main, largest=LARGEST_SCRIPT, most_elements=MOST_ELEMENTS, entities=True)
    _replace(main, script.root, folder, _tamed(aircraft, sockets=sockets))
    path = script.path.resolve()
    home = script.root if path.is_relative_to(script.root) else path.parent
    place = folder if home == script.root else folder / OUTSIDE
    return _replace(path, home, place, _tamed(script.document, sockets=sockets))


def _replace(original: Path, root: Path, folder: Path, document: Element) -> Path:
    """Put a document into `folder` in the place that `original` has in `root`, among links to its neighbours."""
    *inner, name = original.relative_to(root).parts
    for part in ("", *inner):
        root, folder = root / part, folder / part
        if folder.is_symlink():
            folder.unlink()
        folder.mkdir(exist_ok=True)
        for entry in root.iterdir():
            link = folder / entry.name
            if not (link.exists() or link.is_symlink()):
                link.symlink_to(entry)
    file = folder / name
    file.unlink()
    write_document(document, file)
    return file


def _tamed(document: Element, *, sockets: bool) -> Element:
    """The aircraft or script without its sockets, and without the folders of its outputs; line numbers stay."""
    for element in document.findall("input") + document.findall("output"):
        if element.get("type", "").upper() in SOCKETS or element.get("port"):
            if not sockets:
                _remove(document, element)
        elif element.get("name"):
            element.set("name", Path(element.get("name", "")).name)
    return document


def _remove(parent: Element, element: Element) -> None:
    """Take an element out and leave its lines."""
    lines = "\n" * "".join(map(str, element.itertext())).count("\n") + (element.tail or "")
    before = element.getprevious()
    if before is None:
        parent.text = (parent.text or "") + lines
    else:
        before.tail = (before.tail or "") + lines
    parent.remove(element)
