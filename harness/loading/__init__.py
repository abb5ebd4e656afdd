"""What is put on board: where it may be, what it weighs, and what that does to the aircraft's balance."""
