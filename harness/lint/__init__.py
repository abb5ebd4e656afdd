"""An aircraft's files, looked at before JSBSim sees them: it aborts on some faults and flies on with others."""
