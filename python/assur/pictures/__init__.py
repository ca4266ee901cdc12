"""Pictures of mechanisms, their motion and forces: matplotlib, one HTML file, drawings.

`Mechanism.plot`, `Motion.plot` and the like draw with good defaults and return the axes; artists
carry names (`get_gid`): ``link coupler``, ``joint B``, ``slide bore``.
"""
