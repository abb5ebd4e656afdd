"""Take-off performance from flights: the paper's Fig. 14, and what a performance engineer needs besides."""
