# Spider of six flat arms
import flexact

model = flexact.Model(name="spider of six flat arms")
centre = model.node(0, 0, 0, name="centre")
spider = model.spider(outer=0.06, inner=0.02, arms=6, carries=[centre])
model.fix(*spider.ground)
model.independent("centre", "z")
