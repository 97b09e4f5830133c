# Cross hinge of two sheets
import flexact

model = flexact.Model(name="cross hinge of two sheets")
hinge = model.cross_hinge(
    [(-0.03, -0.01, 0), (0.03, 0.01, 0)], [(0.03, -0.01, 0.08), (-0.03, 0.01, 0.08)]
)
model.fix(*hinge.ground)
model.independent("body", "ry")
