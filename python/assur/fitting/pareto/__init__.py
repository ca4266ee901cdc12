"""Several goals at once: the designs of which none is better in all of them."""
