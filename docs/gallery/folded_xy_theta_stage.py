# XY-theta stage on three folded sheets
import flexact

model = flexact.Model(name="XY-theta stage on three folded sheets")
model.fix(model.node(0.1, -0.05, 0, name="clamp"))
model.folded_sheet("clamp", (0.1, 0, 0), (0.05, 0, 0), name="folded sheet")
model.body([(0, 0, 0), (0.05, 0, 0)], name="stage")
model.pattern(3, axis="z", names="{} {}")
model.independent("stage", "x", "y", "rz")
