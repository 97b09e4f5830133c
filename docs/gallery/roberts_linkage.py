# Roberts linkage on flexures
import flexact

model = flexact.Model(name="Roberts linkage on flexures")
foot, top = (0.06, 0, 0), (0.03, 0, 0.06)
model.sheet(foot, top, width="y", name="right leg", reinforced=0.7)
model.fix(foot)
model.mirror("yz", names={"right": "left"})
model.body([(0, 0, 0), top, (-0.03, 0, 0.06)], name="coupler")
model.independent("coupler", "x")
