// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// What is written over the drawing: numbers of elements and nodes, the axes, and a scale.

const Overlay = (() => {
  const MOST = 4000; // numbers looked at in a frame
  const CELL = 18; // pixels; one number in each at most
  const AXES = [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]];

  class Overlay {
    constructor(canvas, stage, data, state) {
      Object.assign(this, { canvas, stage, data, state });
      this.context = canvas.getContext("2d");
      this.style = getComputedStyle(canvas);
    }

    colour(name) {
      return this.style.getPropertyValue(name);
    }

    draw() {
      const { canvas, stage, context } = this;
      const ratio = stage.renderer.getPixelRatio();
      const width = Math.round(stage.width * ratio), height = Math.round(stage.height * ratio);
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, stage.width, stage.height);
      this.taken = new Set();
      this.drawAxes();
      this.drawScale();
      if (this.state.nodeLabels) this.numbers("--node", this.nodes());
      if (this.state.elementLabels) this.numbers("--ink", this.elements());
    }

    drawAxes() {
      const { context, stage } = this;
      const x0 = 38, y0 = stage.height - 38, length = 26;
      context.font = "600 12px system-ui, sans-serif";
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.lineWidth = 1.5;
      const matrix = stage.camera.matrixWorldInverse.elements;
      for (const [name, [x, y, z]] of stage.planar ? AXES.slice(0, 2) : AXES) {
        const dx = matrix[0] * x + matrix[4] * y + matrix[8] * z;
        const dy = matrix[1] * x + matrix[5] * y + matrix[9] * z;
        if (Math.hypot(dx, dy) < 0.12) continue; // seen from its end
        context.strokeStyle = context.fillStyle = this.colour("--soft");
        context.beginPath();
        context.moveTo(x0, y0);
        context.lineTo(x0 + length * dx, y0 - length * dy);
        context.stroke();
        context.fillText(name, x0 + (length + 9) * dx, y0 - (length + 9) * dy);
      }
    }

    /** A bar of a round length, in a unit that suits it. */
    drawScale() {
      const { context, stage } = this;
      const metres = 110 * stage.pixel * this.data.size;
      const power = 10 ** Math.floor(Math.log10(metres));
      const round = [5, 2, 1].find((each) => each * power <= metres) * power;
      const width = round / (stage.pixel * this.data.size);
      const right = stage.width - 16, y = stage.height - 18;
      context.strokeStyle = context.fillStyle = this.colour("--soft");
      context.lineWidth = 1.5;
      context.beginPath();
      context.moveTo(right - width, y - 4);
      context.lineTo(right - width, y);
      context.lineTo(right, y);
      context.lineTo(right, y - 4);
      context.stroke();
      context.font = "12px system-ui, sans-serif";
      context.textAlign = "center";
      context.fillText(inUnits(round), right - width / 2, y - 11);
    }

    *elements() {
      const { members, hinges } = this.data;
      const number = PageData.array(members.number);
      for (let m = 0; m < number.length; m++) {
        yield [String(number[m]), ...this.state.members.middle(m)];
      }
      const nodes = PageData.array(hinges.node), numbers = PageData.array(hinges.number);
      for (let h = 0; h < numbers.length; h++) {
        if (nodes[h] >= 0) yield [String(numbers[h]), ...this.state.place(nodes[h])];
      }
    }

    *nodes() {
      const number = PageData.array(this.data.nodes.number);
      for (const node of PageData.array(this.data.nodes.placed)) {
        yield [String(number[node]), ...this.state.place(node)];
      }
    }

    numbers(colour, labels) {
      const { context } = this;
      context.font = "600 12px system-ui, sans-serif";
      context.textAlign = "center";
      context.lineWidth = 3;
      context.lineJoin = "round";
      context.strokeStyle = this.colour("--paper");
      context.fillStyle = this.colour(colour);
      let looked = 0;
      for (const [text, ...at] of labels) {
        if (++looked > MOST) break;
        const [x, y] = this.stage.project(...at);
        const cell = `${Math.round(x / (1.6 * CELL))} ${Math.round(y / CELL)}`;
        if (this.taken.has(cell)) continue;
        this.taken.add(cell);
        context.strokeText(text, x, y - 9);
        context.fillText(text, x, y - 9);
      }
    }
  }

  function inUnits(metres) {
    const units = [[1, "m"], [1e-3, "mm"], [1e-6, "\u00b5m"], [1e-9, "nm"]];
    const [size, unit] = metres >= 1e4 ? [1e3, "km"]
      : units.find(([each]) => metres >= each * 0.999) || units[3];
    return `${Number((metres / size).toPrecision(3))} ${unit}`;
  }

  return { Overlay };
})();
