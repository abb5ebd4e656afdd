"""JSBSim scripts both ways: any script replayed into a run's folder, any flight of ours handed to stock JSBSim."""
