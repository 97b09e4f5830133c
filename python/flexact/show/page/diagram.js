// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Bending moments as diagrams: beside each member as it is seen, on the stretched side, as
// flexact.drawing.diagrams has them. A member whose moment changes its sign has two.

const Diagram = (() => {
  const END_ON = 0.05; // of a member, seen across the line of sight
  const LEAST = 1e-6; // of the largest moment; smaller ones are not drawn
  const TURNED = 0.9998; // cosine of the turn of the eye from which on they stand elsewhere
  const THROUGH = 0.22; // how much shines through what hides it

  class Diagram {
    constructor(members) {
      const { plan } = members;
      this.members = members;
      this.from = [0, 0, 0]; // the direction to the eye for which they stand as they do
      const count = 2 * plan.station[plan.count];
      this.place = new THREE.BufferAttribute(new Float32Array(6 * count), 3);
      this.paint = new THREE.BufferAttribute(new Uint8Array(6 * count), 3, true);
      this.group = new THREE.Group();
      this.group.visible = false;
      const [faces, lines] = this.indices();
      const attributes = { position: this.place, color: this.paint };
      const { added, indexed } = Members;
      for (const depthTest of [true, false]) {
        const face = new THREE.MeshBasicMaterial({
          vertexColors: true, side: THREE.DoubleSide, depthTest,
          transparent: true, opacity: depthTest ? 0.7 : THROUGH, depthWrite: false,
        });
        const line = new THREE.LineBasicMaterial({
          vertexColors: true, depthTest, transparent: !depthTest, opacity: depthTest ? 1 : 0.4,
        });
        const order = depthTest ? 4 : 6;
        added(this.group, new THREE.Mesh(indexed(attributes, faces), face), order);
        added(this.group, new THREE.LineSegments(indexed(attributes, lines), line), order + 1);
      }
    }

    indices() {
      const { plan } = this.members;
      const faces = [], lines = [];
      for (let m = 0; m < plan.count; m++) {
        const last = plan.stations[m] - 1;
        for (const side of [0, 1]) {
          for (let s = 0; s <= last; s++) {
            const a = 2 * (2 * plan.station[m] + side * (last + 1) + s);
            lines.push(a, a + 1);
            if (s === last) continue;
            lines.push(a + 1, a + 3, a, a + 2);
            faces.push(a, a + 1, a + 3, a, a + 3, a + 2);
          }
        }
      }
      return [faces, lines];
    }

    /** Whether the eye has turned so far that the diagrams stand elsewhere. */
    isPassed(towards) {
      return this.group.visible && dot(this.from, towards) < TURNED;
    }

    /** Draw a quantity, given at p and q, in the present shapes; nothing without one. */
    show(quantity, values, largest, towards) {
      const { data } = this.members;
      const bending = data.bending[quantity];
      this.group.visible = Boolean(bending !== undefined && largest);
      if (!this.group.visible) return;
      this.from = towards;
      const { plan } = this.members;
      const shown = PageData.array(data.members.shown);
      for (let m = 0; m < plan.count; m++) {
        [1, -1].forEach((sign, side) => {
          const first = sign * values[2 * m] / largest, last = sign * values[2 * m + 1] / largest;
          if (shown[m] && Math.max(first, last) > LEAST) {
            this.draw(m, side, [first, last], sign, bending, towards);
          } else this.leave(m, side);
        });
      }
      this.place.needsUpdate = true;
      this.paint.needsUpdate = true;
    }

    /** Draw nothing of a member on one side: all in one point. */
    leave(m, side) {
      const { plan, shape } = this.members;
      const there = shape.centre.subarray(3 * plan.station[m], 3 * plan.station[m] + 3);
      const first = 2 * (2 * plan.station[m] + side * plan.stations[m]);
      for (let i = 0; i < 2 * plan.stations[m]; i++) this.place.array.set(there, 3 * (first + i));
    }

    /** Draw what of a member is on one side, where (linear) parts of the largest are positive. */
    draw(m, side, [first, last], sign, bending, towards) {
      const { plan, data, shape } = this.members;
      const { height, gap } = data.diagram;
      const pieces = plan.stations[m] - 1, own = plan.station[m];
      const zero = first === last ? 0 : first / (first - last);
      const start = first < 0 ? zero : 0, end = last < 0 ? zero : 1;
      const { foot, way } = this.stance(m, sign, bending, towards);
      const rgb = [0, 0, 0];
      for (let s = 0; s <= pieces; s++) {
        const share = start + (end - start) * s / pieces;
        const before = Math.min(Math.floor(share * pieces), pieces - 1);
        const part = share * pieces - before;
        const value = Math.max(0, (1 - share) * first + share * last);
        PageData.diverging(data.stops, sign * value, rgb);
        const at = 6 * (2 * own + side * (pieces + 1) + s);
        for (let k = 0; k < 3; k++) {
          const one = shape.centre[3 * (own + before) + k];
          const other = shape.centre[3 * (own + before + 1) + k];
          const base = one + part * (other - one) + foot[k] + gap * way[k];
          this.place.array[at + k] = base;
          this.place.array[at + 3 + k] = base + height * value * way[k];
          this.paint.array[at + k] = this.paint.array[at + 3 + k] = Math.round(235 * rgb[k]);
        }
      }
    }

    /** From the axis to where a member's diagram stands, and which way it goes. */
    stance(m, sign, bending, towards) {
      const { plan, data, shape } = this.members;
      const middle = 9 * (plan.station[m] + (plan.stations[m] >> 1));
      const axis = (k) => Array.from(shape.frame.subarray(middle + 3 * k, middle + 3 * k + 3));
      const [ex, ey, ez] = [0, 1, 2].map(axis);
      const across = PageData.array(data.members.across);
      const [y, z] = across.subarray(4 * m + 2 * bending, 4 * m + 2 * bending + 2);
      const stretched = sum(ey, sign * y, ez, sign * z);
      let sideways = cross(ex, towards);
      sideways = Math.hypot(...sideways) < END_ON ? stretched : unit(sideways);
      const seen = dot(stretched, sideways);
      const outward = sideways.map((each) => (seen < -1e-9 ? -each : each));
      const depth = unit(sum(stretched, 1, sideways, -seen));
      const away = Math.max(Math.abs(seen), data.diagram.shown);
      const way = unit(sum(outward, away, depth, Math.sqrt(Math.max(0, 1 - away * away))));
      return { foot: this.outermost(m, [ey, ez], outward, stretched), way };
    }

    /** From the axis to the point of the section that is farthest along a direction. */
    outermost(m, axes, outward, stretched) {
      const { plan, data } = this.members;
      const half = PageData.array(data.members.section).subarray(2 * m, 2 * m + 2)
        .map((each) => each / 2);
      const part = axes.map((axis) => dot(outward, axis));
      const size = Math.hypot(half[0] * part[0], half[1] * part[1]) || 1;
      const tie = axes.map((axis) => dot(stretched, axis));
      const [a, b] = [0, 1].map((k) => {
        if (plan.round[m]) return half[k] * half[k] * part[k] / size;
        const way = Math.abs(part[k]) > 1e-9 ? part[k] : Math.round(1e9 * tie[k]);
        return Math.sign(way) * half[k];
      });
      return sum(axes[0], a, axes[1], b);
    }
  }

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const sum = (a, i, b, j) => a.map((each, k) => i * each + j * b[k]);
  const cross = (a, b) =>
    [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);

  function unit(a) {
    const size = Math.hypot(...a);
    return a.map((each) => each / (size || 1));
  }

  return { Diagram };
})();
