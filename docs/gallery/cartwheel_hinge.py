# Cartwheel hinge
import flexact

model = flexact.Model(name="cartwheel hinge")
ground, moving = [(-0.02, 0, 0), (0.02, 0, 0)], [(0.02, 0, 0.06), (-0.02, 0, 0.06)]
hinge = model.cartwheel(ground, moving)
model.fix(*hinge.ground)
model.independent("body", "ry")
