"""A lesson: class III and IV, a five-bar, an excavator, and a four-bar that falls."""

import numpy as np

import assur

for mechanism in (assur.examples.triad(), assur.examples.loom()):  # class III, class IV
    assemblies = mechanism.assemblies(mechanism.q0)
    print(mechanism.structure, "\n", mechanism.limits())
    print(len(assemblies), "real assemblies of", assemblies.complex_count, "complex ones")

five_bar = assur.examples.five_bar()  # two cranks, two drivers
for q, _ in five_bar.find("P", five_bar.joints["P"]):  # the inverse question
    print("both cranks at", np.degrees(q).round(3), "degrees")
reached = five_bar.workspace("P").contains([(0.05, 0.1), (0.05, 0.3), (0.05, 0.9)])
print("P reaches these points:", reached)

excavator = assur.examples.excavator()  # three cylinders drive it
motion = excavator.solve(excavator.q0, order=1)
print("bucket's tip, m per m of each cylinder:", motion.joint("tip").d1.round(3), sep="\n")

lengths = {"crank": 0.2, "coupler": 0.5, "rocker": 0.4}
four_bar = assur.FourBar(0.2, 0.5, 0.4, ground=0.5)
bodies = {name: assur.Body(mass=length, at=(length / 2, 0)) for name, length in lengths.items()}
machine = assur.Machine(four_bar, bodies=bodies, loads=[assur.Gravity()])
run = machine.run(t_end=2.0, q0=1.5, speed0=0.0)  # it falls from rest
print(run, run.energy, sep="\n")
print("fastest:", np.abs(run.speed).max().round(3), "rad/s; energy kept to", run.energy.error)
