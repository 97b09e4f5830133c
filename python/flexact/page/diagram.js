// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Bending moments as a diagram: ordinates from the axis of each member, on the stretched side.

const Diagram = (() => {
  const HEIGHT = 0.12; // of the largest ordinate, in sizes of the drawing

  class Diagram {
    constructor(members) {
      const { plan } = members;
      this.members = members;
      const count = plan.station[plan.count];
      this.place = new THREE.BufferAttribute(new Float32Array(6 * count), 3);
      this.paint = new THREE.BufferAttribute(new Uint8Array(6 * count), 3, true);
      this.group = new THREE.Group();
      this.group.visible = false;
      const [faces, lines] = this.indices();
      const attributes = { position: this.place, color: this.paint };
      const face = new THREE.MeshBasicMaterial({
        vertexColors: true, side: THREE.DoubleSide,
        transparent: true, opacity: 0.62, depthWrite: false,
      });
      const line = new THREE.LineBasicMaterial({ vertexColors: true });
      const { added, indexed } = Members;
      added(this.group, new THREE.Mesh(indexed(attributes, faces), face), 4);
      added(this.group, new THREE.LineSegments(indexed(attributes, lines), line), 5);
    }

    indices() {
      const { plan } = this.members;
      const faces = [], lines = [];
      for (let m = 0; m < plan.count; m++) {
        const last = plan.stations[m] - 1;
        for (let s = 0; s <= last; s++) {
          const a = 2 * (plan.station[m] + s);
          lines.push(a, a + 1);
          if (s === last) continue;
          lines.push(a + 1, a + 3);
          faces.push(a, a + 1, a + 3, a, a + 3, a + 2);
        }
      }
      return [faces, lines];
    }

    /** Draw a quantity, given at p and q, in the present shapes; nothing without one. */
    show(quantity, values, largest) {
      const { data } = this.members;
      const bending = data.bending[quantity];
      this.group.visible = Boolean(bending !== undefined && largest);
      if (!this.group.visible) return;
      const { plan, shape } = this.members;
      const across = PageData.array(data.members.across);
      const shown = PageData.array(data.members.shown);
      const rgb = [0, 0, 0];
      for (let m = 0; m < plan.count; m++) {
        const last = plan.stations[m] - 1;
        const [y, z] = across.subarray(4 * m + 2 * bending, 4 * m + 2 * bending + 2);
        for (let s = 0; s <= last; s++) {
          const share = s / last, station = plan.station[m] + s;
          const there = (1 - share) * values[2 * m] + share * values[2 * m + 1];
          const value = shown[m] ? there / largest : 0;
          PageData.diverging(data.stops, value, rgb);
          for (let k = 0; k < 3; k++) {
            const base = shape.centre[3 * station + k];
            const off = y * shape.frame[9 * station + 3 + k] + z * shape.frame[9 * station + 6 + k];
            const way = HEIGHT * value * off;
            this.place.array[6 * station + k] = base;
            this.place.array[6 * station + 3 + k] = base + way;
            const part = Math.round(235 * rgb[k]);
            this.paint.array[6 * station + k] = part;
            this.paint.array[6 * station + 3 + k] = part;
          }
        }
      }
      this.place.needsUpdate = true;
      this.paint.needsUpdate = true;
    }
  }

  return { Diagram };
})();
