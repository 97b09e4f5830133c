# Remote centre on three wires
import flexact

model = flexact.Model(name="remote centre on three wires")
model.fix(model.node(flexact.polar(0.06, 0, 0.12), name="clamp"))
model.wire("clamp", flexact.polar(0.03, 0, 0.06), name="wire")
model.body([(0, 0, 0), flexact.polar(0.03, 0, 0.06)], name="tool")
model.pattern(3, axis="z", names="{} {}")
model.independent("tool", "rx", "ry", "rz")
