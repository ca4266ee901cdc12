"""Sizes of symbols."""

# All are px of a screen, 96 to the inch; points of print are 72 to the inch.
POINTS_PER_PX = 0.75

JOINT = 5.0  # radius
PIVOT = 5.5
PIVOT_WIDTH, PIVOT_HEIGHT, PIVOT_BASE = 19.0, 15.0, 30.0
GROUND_SPACING = 6.0
BAR = 3.5
DRIVEN_BAR = 4.5
PLATE = 2.5
PLATE_SPACING = 9.0
OUTLINE = 1.9
BLOCK_LENGTH, BLOCK_WIDTH = 30.0, 19.0
GUIDE = 1.75
GUIDE_SPACING = 7.0
SLEEVE_LENGTH, SLEEVE_GAP = 34.0, 13.0
BARREL = 15.0
ROD = 4.5
PISTON = 3.5
HATCH = 1.0
BRIDGE = 18.0
ARROW_RADIUS, ARROW, ARROW_HEAD, ARROW_HEAD_WIDTH = 24.0, 2.25, 10.0, 9.0
DRIVE_LENGTH, DRIVE_DISTANCE = 30.0, 12.0
# Where links are shorter than this, all symbols shrink, to no less than this fraction.
USUAL_LINK, LEAST_DENSITY = 60.0, 0.6
