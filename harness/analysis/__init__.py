"""What a finished flight tells: numbers and pictures made from its log alone."""
