"""The theory that papers have of their own."""
