"""What libxml2's schema validator says, retold in the house's words."""

import re

from harness.errors import did_you_mean, shorten

_MISSING_ATTRIBUTE = re.compile(r"Element '([^']*)': The attribute '([^']*)' is required but missing")
_MISSING_CHILD = re.compile(r"Element '([^']*)': Missing child element\(s\)\. Expected is \( (.*) \)")
_ENUMERATION = re.compile(
    r"Element '[^']*', attribute '([^']*)': \[facet 'enumeration'\] "
    r"The value '(.*)' is not an element of the set \{(.*)\}",
    re.DOTALL,
)
_FACET = re.compile(r"Element '[^']*', attribute '([^']*)': \[facet '(minLength|maxLength|pattern)'\]")
_FACETS = {
    "minLength": ("is empty", ""),
    "maxLength": ("is too long", ""),
    "pattern": (
        "has characters that do not belong there",
        "letters and digits, joined by . _ -, on one line",
    ),
}
_TEXT = re.compile(r"Element '([^']*)': (?:Character content|The element content|Element content)")
_ECHO = re.compile(r"Element '[^']*', attribute '[^']*': '.*' is not a valid value of the", re.DOTALL)


def retold(message: str) -> tuple[str, str, str] | None:
    """(what is wrong, what would be right, the attribute) of a finding; None if it repeats another."""
    if _ECHO.match(message):
        return None
    if found := _MISSING_ATTRIBUTE.match(message):
        return f'<{found[1]}> lacks its "{found[2]}"', f'add {found[2]}="..."', ""
    if found := _MISSING_CHILD.match(message):
        return f"<{found[1]}> is empty", f"add at least one <{found[2]} .../>", ""
    if found := _ENUMERATION.match(message):
        allowed = re.findall(r"'([^']*)'", found[3])
        return f'{found[1]}="{shorten(found[2])}" is not known', did_you_mean(found[2], allowed), found[1]
    if found := _FACET.match(message):
        what, remedy = _FACETS[found[2]]
        return f"{found[1]} {what}", remedy, found[1]
    if found := _TEXT.match(message):
        return (
            f"<{found[1]}> has text inside, where none belongs",
            "values are attributes; delete the text",
            "",
        )
    return shorten(message, 200), "", ""
