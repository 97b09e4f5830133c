// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The axes and the scale, in a strip below the canvas: no view of the mechanism reaches there.

const Gauges = (() => {
  const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];
  const LEFT = 40, LENGTH = 17, LETTER = 9; // pixels
  const END_ON = 0.12; // of an axis; one that is seen shorter points at the eye
  const LONGEST = 110; // pixels of the scale

  /** Draw both; `write` keeps what they cover. */
  function draw(context, stage, size, colour, keep) {
    context.strokeStyle = context.fillStyle = colour;
    context.font = "600 12px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 1.5;
    keep("tripod", tripod(context, stage));
    keep("scale", scale(context, stage, size));
  }

  /** The axes, in the middle of the strip whichever way they point. */
  function tripod(context, stage) {
    const e = stage.camera.matrixWorldInverse.elements;
    const axes = (stage.planar ? AXES.slice(0, 2) : AXES)
      .map(([name, [x, y, z]]) => [name, e[0] * x + e[4] * y + e[8] * z,
        -(e[1] * x + e[5] * y + e[9] * z)])
      .filter(([, dx, dy]) => Math.hypot(dx, dy) > END_ON);
    const reach = LENGTH + LETTER;
    const across = [0, ...axes.map(([, dx]) => reach * dx)];
    const down = [0, ...axes.map(([, , dy]) => reach * dy)];
    const box = [Math.min(...across), Math.min(...down), Math.max(...across), Math.max(...down)];
    const x0 = LEFT - (box[0] + box[2]) / 2;
    const y0 = stage.height + stage.foot / 2 - (box[1] + box[3]) / 2;
    for (const [name, dx, dy] of axes) {
      context.beginPath();
      context.moveTo(x0, y0);
      context.lineTo(x0 + LENGTH * dx, y0 + LENGTH * dy);
      context.stroke();
      context.fillText(name, x0 + reach * dx, y0 + reach * dy);
    }
    return [x0 + box[0] - 5, y0 + box[1] - 6, x0 + box[2] + 5, y0 + box[3] + 6];
  }

  /** A bar of a round length, in a unit that suits it. */
  function scale(context, stage, size) {
    const metres = LONGEST * stage.pixel * size;
    const power = 10 ** Math.floor(Math.log10(metres));
    const round = [5, 2, 1].find((each) => each * power <= metres) * power;
    const width = round / (stage.pixel * size);
    const right = stage.width - 16, y = stage.height + stage.foot / 2 + 8;
    context.beginPath();
    context.moveTo(right - width, y - 4);
    context.lineTo(right - width, y);
    context.lineTo(right, y);
    context.lineTo(right, y - 4);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    const text = inUnits(round), half = Math.max(width, context.measureText(text).width) / 2;
    const middle = Math.min(right - width / 2, stage.width - 4 - half);
    context.fillText(text, middle, y - 12);
    return [middle - half, y - 20, middle + half, y + 2];
  }

  function inUnits(metres) {
    const units = [[1, "m"], [1e-3, "mm"], [1e-6, "\u00b5m"], [1e-9, "nm"]];
    const [size, unit] = metres >= 1e4 ? [1e3, "km"]
      : units.find(([each]) => metres >= each * 0.999) || units[3];
    return `${Number((metres / size).toPrecision(3))} ${unit}`;
  }

  return { draw };
})();
