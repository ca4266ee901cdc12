"""Bodies, loads, motors and friction of a machine, checked as they are made."""
