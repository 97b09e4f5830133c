# XY stage with two intermediate bodies
import flexact

model = flexact.Model(name="XY stage with two intermediate bodies")
for limb, degrees in (("x", 0), ("y", 90)):
    with model.frame(degrees=degrees):
        offset, ends = (0.02, 0), [(-0.05, 0.015), (-0.05, -0.015)]
        outer = model.parallel_guide((-0.06, 0.06), (-0.06, 0.03), offset, name=limb, carries=ends)
        model.parallel_guide(ends[0], (-0.02, 0.015), (0, -0.03), name=f"inner {limb}")
    model.fix(*outer.ground)
model.body(["inner x stage", "inner y stage"], name="stage")
model.independent("stage", "x", "y")
