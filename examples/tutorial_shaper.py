"""A course project: a shaper, from its structure to flywheel, joint forces and a table."""

import numpy as np

import assur

shaper = assur.examples.shaper()
print(shaper.structure)
q = np.radians(np.arange(0, 360, 30))  # twelve positions of the crank
omega = 6.0  # rad/s
motion = shaper.solve(q, order=2)
print("ram, m:", motion.slide("bed").value.round(3))
print("m/s:", motion.slide("bed").velocity(omega).round(3))
print("m/s²:", motion.slide("bed").acceleration(omega).round(2))
motion.to_excel("shaper.xlsx", speed=omega, degrees=True, moving=True)

lever = assur.Body(mass=20.0, inertia=0.3, at=(0.2, 0.0))
rod, ram = assur.Body(mass=5.0, inertia=0.01, at=(0.075, 0.0)), assur.Body(mass=40.0)
cut = assur.Force("F", (1500.0, 0.0), on="ram", while_="backward", over="bed")
bodies = {"lever": lever, "rod": rod, "ram": ram}
machine = assur.Machine(shaper, bodies=bodies, loads=[assur.Gravity(), cut])
flywheel = machine.flywheel(fluctuation=1 / 30, mean_speed=omega)
print("flywheel:", round(flywheel.inertia, 2), "kg·m²; coefficient:", round(flywheel.delta, 4))
forces = machine.reactions(q, omega)
print("crank pin, N:", np.hypot(*forces.joint("A", on="crank").T).round(0))
forces.to_excel("forces.xlsx")
