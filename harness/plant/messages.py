"""JSBSim's messages, kept instead of printed: standard output belongs to the harness."""

import jsbsim


class Messages(jsbsim.FGLogger):
    """Collects what JSBSim reports at WARN and above, with file and line where it gives them."""

    def __init__(self) -> None:
        super().__init__()
        self.serious: list[str] = []
        self._level = jsbsim.LogLevel.DEBUG
        self._text = ""

    def set_level(self, level: jsbsim.LogLevel) -> None:
        """Begin a message of this level."""
        self._level = level

    def file_location(self, filename: str, line: int) -> None:
        """Say where in an XML file it comes from."""
        self._text += f"{filename}:{line}: "

    def message(self, message: str) -> None:
        """Add to the message."""
        self._text += message

    def format(self, format: jsbsim.LogFormat) -> None:  # noqa: A002  JSBSim's own name
        """Colours are not kept."""

    def flush(self) -> None:
        """End the message."""
        if self._level >= jsbsim.LogLevel.WARN and self._text.strip():
            self.serious.append(" ".join(self._text.split()))
        self._text = ""
