"""The super-modes SPD, HP and VP: always active, each in exactly one sub-mode (AIAA 2010-7777 Figs. 8, 9, 11)."""
