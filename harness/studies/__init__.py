"""Studies: one mission flown many times with factors varied, on all cores or a cluster, into one table."""
