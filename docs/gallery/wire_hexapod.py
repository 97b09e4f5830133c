# Hexapod of six wires
import flexact

model = flexact.Model(name="hexapod of six wires")
hexapod = model.hexapod(base=0.1, platform=0.06, height=0.1, spread=20)
model.fix(*hexapod.ground)
