"""The central slider-crank of the papers: exact motion, cosine series, continued fraction.

The crank angle φ is measured from the outer dead point, and so is the stroke s; the slider's
coordinate x = crank + rod − s is measured from the crank's pivot. k = rod / crank, λ = 1/k.

References
----------
O. M. Chernysh, M. G. Berezovyi, V. V. Yaremenko, M. M. Kruhlii, *Analytical studies of the
kinematic parameters of planar lever mechanisms* (2021). R. V. Ambarcumyanc, M. I. Subbotina,
*Concerning the research of kinematics of central crank gear and slider mechanism* (2017).
"""

from assur.papers.slider_crank.figures import (
    plot_contour,
    plot_convergence,
    plot_deviation,
    plot_motion,
    plot_positions,
)
from assur.papers.slider_crank.theory import (
    Deviation,
    Extreme,
    contour,
    coordinate,
    deviation,
    fourier,
    greatest_acceleration,
    greatest_speed,
    rod_angle,
    rod_point,
    stroke,
)

__all__ = [
    "Deviation",
    "Extreme",
    "contour",
    "coordinate",
    "deviation",
    "fourier",
    "greatest_acceleration",
    "greatest_speed",
    "plot_contour",
    "plot_convergence",
    "plot_deviation",
    "plot_motion",
    "plot_positions",
    "rod_angle",
    "rod_point",
    "stroke",
]
