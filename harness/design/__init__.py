"""Generators of committed engineering data: each is run by hand, and a test proves that its output is what is committed."""
