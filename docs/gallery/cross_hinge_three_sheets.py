# Cross hinge of three sheets
import flexact

model = flexact.Model(name="cross hinge of three sheets")
hinge = model.cross_hinge(
    [(-0.03, -0.02, 0), (0.03, 0, 0), (-0.03, 0.02, 0)],
    [(0.03, -0.02, 0.08), (-0.03, 0, 0.08), (0.03, 0.02, 0.08)],
)
model.fix(*hinge.ground)
model.independent("body", "ry")
