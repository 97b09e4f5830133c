# Stewart platform on six notched struts
import flexact

model = flexact.Model(name="Stewart platform on six notched struts")
feet, ends = [flexact.polar(0.1, 15), flexact.polar(0.1, 105)], ("universal", "spherical")
for k in (1, 2, 3):
    with model.frame(degrees=120 * k):
        apex = flexact.polar(0.07, 60, 0.12)
        bipod = model.bipod(feet, apex, name=f"bipod {k}", reach=0.85, ends=ends)
    model.fix(*bipod.ground)
model.body([f"bipod {k} body" for k in (1, 2, 3)], name="platform")
