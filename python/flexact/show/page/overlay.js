// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// What is drawn over the canvas and below it: names, local axes, what points at the eye, and the
// axes and the scale.

const Overlay = (() => {
  const SHORT = 0.28; // of an arrow; one that is seen shorter points at the eye
  const AXIS = 24; // pixels of a local axis that is seen in full
  const LONG = 28; // letters of a name
  const NAMES = ["x", "y", "z"];

  class Overlay {
    constructor(canvas, stage, data, state) {
      Object.assign(this, { canvas, stage, data, state });
      this.context = canvas.getContext("2d");
      this.style = getComputedStyle(canvas);
      this.labels = new Labels.Labels(this.context, stage);
      this.gauges = {}; // boxes of what stands in the strip
    }

    colour(name) {
      return this.style.getPropertyValue(name);
    }

    draw() {
      const { canvas, stage, context, state } = this;
      const ratio = stage.renderer.getPixelRatio(), high = stage.height + stage.foot;
      const width = Math.round(stage.width * ratio), height = Math.round(high * ratio);
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, stage.width, high);
      this.labels.begin();
      this.drawLine();
      Gauges.draw(context, stage, this.data.size, this.colour("--soft"),
        (name, box) => { this.gauges[name] = box; });
      context.save();
      context.beginPath();
      context.rect(0, 0, stage.width, stage.height);
      context.clip();
      for (const part of [state.displacements, state.freedoms, state.presses, state.spaces]) {
        if (part.group.visible) for (const each of part.endOn()) this.drawEndOn(each);
      }
      const ground = this.colour("--stage");
      if (state.layers.axes) this.drawLocal(ground);
      if (state.nodeLabels) this.labels.write(this.nodes(), this.colour("--node"), ground);
      if (state.elementLabels) this.labels.write(this.elements(), this.colour("--ink"), ground);
      context.restore();
    }

    /** Where the strip begins. */
    drawLine() {
      const { context, stage } = this;
      context.fillStyle = this.colour("--line");
      context.fillRect(0, stage.height, stage.width, 1);
    }

    /** How much of a direction is seen, and whether it comes towards the eye. */
    seen([x, y, z]) {
      const e = this.stage.camera.matrixWorldInverse.elements;
      return [e[0] * x + e[4] * y + e[8] * z, -(e[1] * x + e[5] * y + e[9] * z),
        e[2] * x + e[6] * y + e[10] * z];
    }

    /** An arrow at the eye: a dot in a circle, a cross from behind; a turn: an arc with a head. */
    drawEndOn({ at, way, turn, colour }) {
      const [dx, dy, depth] = this.seen(way);
      if (Math.hypot(dx, dy) > SHORT) return;
      const { context } = this;
      const [x, y] = this.stage.project(...at);
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 2;
      context.beginPath();
      if (turn) return this.drawTurn(x, y, depth > 0);
      context.arc(x, y, 6.5, 0, 2 * Math.PI);
      context.fillStyle = this.colour("--stage");
      context.fill();
      context.stroke();
      context.beginPath();
      context.fillStyle = colour;
      if (depth > 0) {
        context.arc(x, y, 2.3, 0, 2 * Math.PI);
        context.fill();
      } else {
        for (const sign of [1, -1]) {
          context.moveTo(x - 4, y - 4 * sign);
          context.lineTo(x + 4, y + 4 * sign);
        }
        context.stroke();
      }
    }

    drawTurn(x, y, isToEye) {
      const { context } = this;
      const radius = 13, end = isToEye ? -0.25 * Math.PI : 1.25 * Math.PI;
      context.arc(x, y, radius, isToEye ? end + 1.5 * Math.PI : end - 1.5 * Math.PI, end, isToEye);
      context.stroke();
      const forward = end + (isToEye ? -Math.PI / 2 : Math.PI / 2);
      const tip = (along, aside) => [
        x + radius * Math.cos(end) + along * Math.cos(forward) + aside * Math.cos(end),
        y + radius * Math.sin(end) + along * Math.sin(forward) + aside * Math.sin(end)];
      context.beginPath();
      context.moveTo(...tip(8, -1));
      context.lineTo(...tip(-1, 5));
      context.lineTo(...tip(-1, -5));
      context.fill();
    }

    /** Local axes at the middles of members, and p and q near their ends. */
    drawLocal(ground) {
      const { context, data } = this;
      const { plan, shape } = this.state.members;
      const shown = PageData.array(data.members.shown);
      const letters = [], ends = [];
      for (let m = 0; m < plan.count; m++) {
        if (!shown[m]) continue;
        const first = plan.station[m], last = plan.stations[m] - 1;
        const frame = 9 * (first + (plan.stations[m] >> 1));
        const at = this.state.members.middle(m);
        const from = this.stage.project(...at);
        NAMES.slice(0, data.planar ? 2 : 3).forEach((name, k) => {
          const way = Array.from(shape.frame.subarray(frame + 3 * k, frame + 3 * k + 3));
          const [dx, dy] = this.seen(way);
          context.lineWidth = 2;
          context.strokeStyle = this.colour(`--axis-${name}`);
          context.beginPath();
          context.moveTo(from[0], from[1]);
          context.lineTo(from[0] + AXIS * dx, from[1] + AXIS * dy);
          context.stroke();
          const tip = AXIS * this.stage.pixel;
          letters.push([`${m} ${name}`, name, ...at.map((each, i) => each + tip * way[i])]);
        });
        const near = (share) => [0, 1, 2].map((k) =>
          (1 - share) * shape.centre[3 * first + k] + share * shape.centre[3 * (first + last) + k]);
        ends.push([`${m} p`, "p", ...near(0.08)], [`${m} q`, "q", ...near(0.92)]);
      }
      this.labels.write(letters, this.colour("--ink"), ground);
      this.labels.write(ends, this.colour("--accent"), ground, "700 13px system-ui, sans-serif");
    }

    /** Names of parts at their middles, bodies once; of hinges at their nodes. */
    *elements() {
      const { members, hinges } = this.data;
      const numbers = PageData.array(members.number), part = PageData.array(members.part);
      const rows = new Map();
      for (let m = 0; m < numbers.length; m++) {
        if (!rows.has(part[m])) rows.set(part[m], []);
        rows.get(part[m]).push(m);
      }
      for (const [key, every] of rows) {
        const name = members.parts[key];
        const row = every[every.length >> 1];
        const text = every.length > 1 ? name : named(numbers[row], name);
        yield [`part ${key}`, text, ...this.state.members.middle(row)];
      }
      const nodes = PageData.array(hinges.node), hinged = PageData.array(hinges.number);
      for (let h = 0; h < hinged.length; h++) {
        if (nodes[h] < 0) continue;
        yield [`hinge ${h}`, named(hinged[h], hinges.names[h]), ...this.state.place(nodes[h])];
      }
    }

    /** Numbers of the nodes at a place, and its name. */
    *nodes() {
      const { nodes } = this.data;
      const number = PageData.array(nodes.number), place = PageData.array(nodes.place);
      if (!this.atPlace) {
        this.atPlace = new Map();
        place.forEach((each, node) => {
          this.atPlace.set(each, [...(this.atPlace.get(each) || []), number[node]]);
        });
      }
      for (const node of PageData.array(nodes.placed)) {
        const numbers = this.atPlace.get(node) || [number[node]];
        const name = nodes.names[node];
        const text = numbers.slice(0, 3).join(", ") + (name ? ` ${cut(name)}` : "");
        yield [`node ${node}`, text, ...this.state.place(node)];
      }
    }
  }

  const cut = (name) => (name.length > LONG ? `${name.slice(0, LONG - 1)}\u2026` : name);

  /** A number with a name, but "sheet 1" as it is. */
  function named(number, name) {
    if (!name) return String(number);
    return new RegExp(`^\\S+ ${number}$`).test(name) ? name : `${number} ${cut(name)}`;
  }

  return { Overlay, SHORT };
})();
