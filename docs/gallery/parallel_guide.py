# Parallel guide of two sheets
import flexact

model = flexact.Model(name="parallel guide")
guide = model.parallel_guide((0, 0, 0), (0.1, 0, 0), offset=(0, 0.05, 0))
model.fix(*guide.ground)
model.independent("stage", "y")
