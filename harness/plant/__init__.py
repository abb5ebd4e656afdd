"""The aircraft and the air it flies in: JSBSim behind `State` and `Commands`."""
