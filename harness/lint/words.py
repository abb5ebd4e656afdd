"""The words of JSBSim: elements by where they stand, and the properties it makes itself. Data beside this file."""

from pathlib import Path

HERE = Path(__file__).parent


def _read(name: str) -> dict[str, frozenset[str]]:
    """The blocks of a file of words: `[block]` lines begin one, `#` a comment."""
    blocks: dict[str, set[str]] = {}
    block = blocks.setdefault("", set())
    for line in (HERE / name).read_text("utf-8").splitlines():
        if line.startswith("["):
            block = blocks.setdefault(line.strip("[]"), set())
        elif not line.startswith("#"):
            block.update(line.split())
    return {title: frozenset(words) for title, words in blocks.items()}


_words = _read("jsbsim-words.txt")
SECTIONS = _words["sections"]
"""Children of <fdm_config>; its <input> and <output> open sockets and write files, and are refused."""
COMPONENTS = _words["components"]
"""Children of <channel>."""
OPERATIONS = _words["operations"]
"""What a function is built from."""
KNOWN: frozenset[str] = SECTIONS | COMPONENTS | OPERATIONS | _words["others"]
OWN_PROPERTIES = _read("jsbsim-properties.txt")[""]
"""The properties JSBSim makes itself, without indices; `python -m harness.plant.catalog` writes the list."""
