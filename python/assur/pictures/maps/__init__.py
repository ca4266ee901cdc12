"""Maps of designs, configuration curves, workspaces."""
