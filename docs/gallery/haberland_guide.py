# Haberland linear guide
import flexact

model = flexact.Model(name="Haberland linear guide")
offset, ends = (0.08, 0, 0), [(-0.04, 0.05, 0), (0.04, 0.05, 0), (-0.06, 0, 0)]
outer = model.parallel_guide((-0.04, 0, 0.05), (-0.04, 0, 0.02), offset, name="outer", carries=ends)
model.parallel_guide(ends[0], (-0.04, 0.02, 0), offset, carries=[(0, 0, 0)])
model.fix(*outer.ground)
model.rename(outer.body, "intermediate body")
model.pattern(2, axis="x")
model.independent("intermediate body", "x")
model.independent("stage", "x")
