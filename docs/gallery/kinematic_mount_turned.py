# Kinematic mount with its vees turned by 90 degrees
import flexact

model = flexact.Model(name="kinematic mount with its vees turned by 90 degrees")
mount = model.kinematic_mount(radius=0.05, length=0.02, turned=90)
model.fix(*mount.ground)
