"""What to fly: the model of a mission, its reader, and its checks."""
