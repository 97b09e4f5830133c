# Straight guide on six folded sheets
import flexact

model = flexact.Model(name="straight guide on six folded sheets")
model.fix(model.node(0, 0.06, 0.08, name="upper clamp"))
model.folded_sheet("upper clamp", (0, 0.06, 0.03), (0, 0.02, 0.03), name="upper sheet")
model.body([(0, 0, 0), (0, 0.02, 0.03)], name="cylinder")
model.pattern(3, axis="z", names="{} {}")
model.mirror("xy", names={"upper": "lower"})
model.independent("cylinder", "z")
