# Straight guide on five folded sheets
import flexact

model = flexact.Model(name="straight guide on five folded sheets")
model.fix(model.node(0, 0.06, 0.08, name="upper clamp"))
model.folded_sheet("upper clamp", (0, 0.06, 0.03), (0, 0.02, 0.03), name="upper sheet")
model.body([(0, 0, 0), (0, 0.02, 0.03)], name="cylinder")
model.pattern(3, axis="z", names="{} {}")
model.fix(model.node(0, 0.06, -0.08, name="lower clamp"))
lower = model.folded_sheet("lower clamp", (0, 0.06, -0.03), (0, 0.02, -0.03), name="lower sheet")
model.pattern(2, axis="z", degrees=-90, parts=[lower], names="{} {}")
model.body(["cylinder", (0, 0.02, -0.03), (0.02, 0, -0.03)])
model.independent("cylinder", "z")
