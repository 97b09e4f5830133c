# Straight guide on five folded sheets
import flexact

model = flexact.Model(name="straight guide on five folded sheets")
model.folded_sheet((0, 0.06, 0.08), (0, 0.06, 0.03), (0, 0.02, 0.03), name="upper sheet")
model.fix((0, 0.06, 0.08))
model.body([(0, 0, 0), (0, 0.02, 0.03)], name="cylinder")
model.pattern(3, axis="z", names="{} {}")
model.folded_sheet((0.06, 0, -0.08), (0.06, 0, -0.03), (0.02, 0, -0.03), name="lower sheet 1")
model.folded_sheet((0, 0.06, -0.08), (0, 0.06, -0.03), (0, 0.02, -0.03), name="lower sheet 2")
model.fix((0.06, 0, -0.08), (0, 0.06, -0.08))
model.body(["cylinder", (0.02, 0, -0.03), (0, 0.02, -0.03)])
model.independent("cylinder", "z")
