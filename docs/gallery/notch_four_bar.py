# Four-bar on notch hinges
import flexact

model = flexact.Model(name="four-bar on notch hinges")
corners = [(0, 0, 0), (0, 0, 0.05), (0.1, 0, 0.05), (0.1, 0, 0)]
notches = [model.notch(at, "y", name=f"notch {k}") for k, at in enumerate(corners, 1)]
model.body([notches[0].q, notches[1].p], name="left arm")
model.body([notches[1].q, notches[2].p], name="coupler")
model.body([notches[2].q, notches[3].p], name="right arm")
model.fix(notches[0].p, notches[3].q)
model.independent("coupler", "x")
