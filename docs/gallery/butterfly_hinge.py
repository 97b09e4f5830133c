# Butterfly hinge
import flexact

model = flexact.Model(name="butterfly hinge")
near, far = [(-0.01, 0, 0.006), (-0.01, 0, -0.006)], [(0.01, 0, 0.006), (0.01, 0, -0.006)]
left = model.cross_hinge([(-0.05, 0, 0.03), (-0.05, 0, -0.03)], near, name="left")
right = model.cross_hinge(far, [(0.05, 0, 0.03), (0.05, 0, -0.03)], name="right")
model.body([left.body, *right.ground], name="intermediate body")
model.fix(*left.ground)
model.independent("intermediate body", "ry")
model.independent("right body", "ry")
