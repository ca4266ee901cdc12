"""What users would write without `assur`, each for one linkage."""
