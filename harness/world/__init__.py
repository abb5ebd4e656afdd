"""The air and the Earth the aircraft flies in and over: pure functions of their arguments."""
