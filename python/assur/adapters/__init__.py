"""Mechanisms and machines as functions of other libraries, with exact derivatives.

`assur.adapters.scipy` for optimisers and integrators of SciPy, `assur.adapters.jax` for functions
under ``jax.jit``, ``vmap`` and ``grad``. Neither library is imported before it is used.
"""

from assur.adapters import jax, scipy

__all__ = ["jax", "scipy"]
