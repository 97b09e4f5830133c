# Lens mount of three tangential sheets
import flexact

model = flexact.Model(name="lens mount of three tangential sheets")
model.fix(model.node(0.04, -0.025, 0, name="clamp"))
model.sheet("clamp", (0.04, 0.005, 0), width="z", name="sheet")
model.body([(0, 0, 0), (0.04, 0.005, 0)], name="lens", shape="disc", thickness=0.008)
model.pattern(3, axis="z", names="{} {}")
