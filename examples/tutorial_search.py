"""Which four-bar draws the straightest line? The best ten of 200 000, and the best one drawn."""

import matplotlib.pyplot as plt
import numpy as np

import assur
from assur import metric

# A coupler point P off the line B-C; the crank is 1 m long, and all other lengths are searched.
drawing = assur.FourBar(crank=1.0, coupler=3.0, rocker=2.5, ground=3.0, point=(1.5, 1.0))
names = ["coupler.length", "rocker.length", "ground.D.x", "coupler.P.x", "coupler.P.y"]
lengths = np.random.default_rng(1).uniform(1.0, 4.0, (5, 200_000))
found = assur.sweep(
    drawing,
    dict(zip(names, lengths, strict=True)),
    np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False),
    # Over the best half turn, relative to the line's length; poor transmission is left out.
    metrics={"off": metric.deviation("P", shape="line", part=0.5, relative=True)},
    where=[metric.min_transmission_angle("C") > np.radians(40.0)],
)
best = np.argsort(found["off"])[:10]  # NaN sorts to the end
for design in best:
    print(f"design {design}: {100.0 * found['off'][design]:.3f} % of its length off the line")
motion = found.designs(best[0]).solve(np.linspace(0.0, 2.0 * np.pi, 361))
motion.plot("P")
plt.savefig("straightest.png")
