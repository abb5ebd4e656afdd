"""Radio aids and runways: where they stand and what a receiver shows."""
