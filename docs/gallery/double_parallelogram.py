# Double parallelogram
import flexact

model = flexact.Model(name="double parallelogram")
ends = [(0.03, 0, 0.05), (0.09, 0, 0.05)]
outer = model.parallel_guide((0, 0, 0), (0, 0, 0.05), (0.12, 0, 0), name="outer", carries=ends)
model.parallel_guide((0.03, 0, 0.05), (0.03, 0, 0), (0.06, 0, 0), name="inner")
model.fix(*outer.ground)
model.independent("outer stage", "x")
model.independent("inner stage", "x")
