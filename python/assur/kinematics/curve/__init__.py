"""The configuration curve of a mechanism with one freedom: branches, folds, circuits.

A branch is what an assembly reaches without a dead point of the driver. At a dead point two
branches meet in a fold. Branches joined by folds form a circuit: all positions that can be reached
without taking the mechanism apart (T. R. Chase and J. A. Mirth, J. Mech. Des. 115 (1993) 223).
"""
