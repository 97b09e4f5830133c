# Compound guide on both sides
import flexact

model = flexact.Model(name="compound guide on both sides")
offset, ends = (0.03, 0, 0), [(0.02, 0, 0.05), (0.03, 0, 0.05)]
outer = model.parallel_guide((0.05, 0, 0), (0.05, 0, 0.05), offset, name="right", carries=ends)
model.parallel_guide(ends[0], (0.02, 0, 0), (0.01, 0, 0), name="inner right", carries=[(0, 0, 0)])
model.rename("inner right stage", "stage")
model.fix(*outer.ground)
model.independent("right stage", "x")
model.mirror("yz", names={"right": "left"})
model.independent("stage", "x")
