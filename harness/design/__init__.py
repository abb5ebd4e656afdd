"""Generators of committed engineering data: run by hand; a test proves that what they write is what is committed."""
