"""The parser of TOML: Python's own, or before 3.11 the package that became it."""

import sys

if sys.version_info >= (3, 11):
    from tomllib import loads
else:
    from tomli import loads

__all__ = ["loads"]
