// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Names beside what they name: each finds a free place round its point, led there by a line where
// it is far; one that finds none is left out.

const Labels = (() => {
  const MOST = 1500; // labels looked at in a frame
  const HIGH = 15, GAP = 3, NEAR = 14; // pixels
  const WAYS = [[0, -1], [1, 0], [-1, 0], [0, 1], [0.8, -0.8], [-0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]];
  const REACHES = [11, 26, 44, 66];
  const CHOICES = REACHES.flatMap((reach) => WAYS.map(([x, y]) => [reach * x, reach * y]));

  class Labels {
    constructor(context, stage) {
      Object.assign(this, { context, stage });
      this.chosen = new Map(); // the place that each had last, so that none jumps without need
      this.begin();
    }

    /** Forget what has been placed. */
    begin() {
      this.boxes = [];
      this.cells = new Map();
    }

    /** Write [key, text, x, y, z] of some in a colour, on a ground. */
    write(every, colour, ground, font = "600 12px system-ui, sans-serif") {
      const { context, stage } = this;
      Object.assign(context, { font, textAlign: "center", textBaseline: "middle", lineJoin: "round" });
      let looked = 0;
      for (const [key, text, ...at] of every) {
        if (++looked > MOST) break;
        const [x, y] = stage.project(...at);
        if (x < 0 || y < 0 || x > stage.width || y > stage.height) continue;
        const half = context.measureText(text).width / 2 + 2;
        const found = this.place(key, x, y, half);
        if (!found) continue;
        const [left, top, right, bottom] = found;
        const middle = [(left + right) / 2, (top + bottom) / 2];
        const ends = [Math.max(left, Math.min(x, right)), Math.max(top, Math.min(y, bottom))];
        context.fillStyle = colour;
        if (Math.hypot(ends[0] - x, ends[1] - y) > NEAR) this.lead(x, y, ends, colour);
        context.strokeStyle = ground;
        context.lineWidth = 3;
        context.strokeText(text, ...middle);
        context.fillText(text, ...middle);
      }
    }

    lead(x, y, [endX, endY], colour) {
      const { context } = this;
      Object.assign(context, { strokeStyle: colour, lineWidth: 0.8 });
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(endX, endY);
      context.stroke();
    }

    /** The box [left, top, right, bottom] of a label; null where there is no room. */
    place(key, x, y, half) {
      const last = this.chosen.get(key);
      const order = last === undefined ? CHOICES.keys() : [last, ...CHOICES.keys()];
      for (const choice of order) {
        const [dx, dy] = CHOICES[choice];
        const middle = x + dx + Math.sign(dx) * half, level = y + dy;
        const box = [middle - half, level - HIGH / 2, middle + half, level + HIGH / 2];
        if (!this.isFree(box)) continue;
        this.take(box);
        this.chosen.set(key, choice);
        return box;
      }
      this.chosen.delete(key);
      return null;
    }

    isFree([left, top, right, bottom]) {
      const { width, height } = this.stage;
      if (left < 0 || top < 0 || right > width || bottom > height) return false;
      for (const cell of this.cellsOf([left, top, right, bottom])) {
        for (const [l, t, r, b] of this.cells.get(cell) || []) {
          if (left < r + GAP && right > l - GAP && top < b && bottom > t) return false;
        }
      }
      return true;
    }

    take(box) {
      this.boxes.push(box);
      for (const cell of this.cellsOf(box)) {
        if (!this.cells.has(cell)) this.cells.set(cell, []);
        this.cells.get(cell).push(box);
      }
    }

    *cellsOf([left, top, right, bottom]) {
      for (let i = Math.floor((left - GAP) / 64); i <= Math.floor((right + GAP) / 64); i++) {
        for (let j = Math.floor(top / 32); j <= Math.floor(bottom / 32); j++) yield 1000 * i + j;
      }
    }
  }

  return { Labels };
})();
