"""The mathematical pilot: phases, procedures, checklists, modes and controllers. Knows nothing of JSBSim."""
