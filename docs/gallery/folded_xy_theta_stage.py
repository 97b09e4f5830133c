# XY-theta stage on three folded sheets
import flexact

model = flexact.Model(name="XY-theta stage on three folded sheets")
model.folded_sheet((0.1, -0.05, 0), (0.1, 0, 0), (0.05, 0, 0), name="folded sheet")
model.fix((0.1, -0.05, 0))
model.body([(0, 0, 0), (0.05, 0, 0)], name="stage")
model.pattern(3, axis="z", names="{} {}")
model.independent("stage", "x", "y", "rz")
