# Table on six sheets
import flexact

model = flexact.Model(name="table on six sheets")
places = [(0.04 * i, 0.06 * j) for i in range(3) for j in range(2)]
for k, (x, y) in enumerate(places, 1):
    model.sheet((x, y, 0), (x, y, 0.05), width="y", name=f"sheet {k}")
    model.fix((x, y, 0))
model.body([(x, y, 0.05) for x, y in places], name="table", shape="box", thickness=0.005)
model.independent("table", "x")
