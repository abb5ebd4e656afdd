"""Objective tests of an aircraft, in the style of a flight simulator's qualification test guide."""
