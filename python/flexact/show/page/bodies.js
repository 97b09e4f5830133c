// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Rigid bodies as solids: each moves with one of its members, whose frame holds its corners.

const Bodies = (() => {
  const { BufferAttribute, DoubleSide, LineSegments, Mesh } = THREE;

  class Bodies {
    constructor(data, members) {
      const { bodies } = data;
      Object.assign(this, { data, members, count: bodies.names.length });
      this.group = new THREE.Group();
      this.local = PageData.array(bodies.corner);
      this.localNormal = PageData.array(bodies.normal);
      this.counts = PageData.array(bodies.count);
      this.corner = new BufferAttribute(new Float32Array(this.local.length), 3);
      this.normal = new BufferAttribute(new Float32Array(this.local.length), 3);
      for (const each of [this.corner, this.normal]) each.setUsage(THREE.DynamicDrawUsage);
      this.triangles = PageData.array(bodies.triangles);
      this.edges = PageData.array(bodies.edges);
      this.bodyOf = new Map(bodies.rows.flatMap((rows, b) => rows.map((row) => [row, b])));
      this.solids = [];
      this.makeSolids();
      this.makeMarks();
    }

    /** (per corner) what writes (per body) gives, as a colour of 8 bits. */
    painted(colour, opacity) {
      const made = new Uint8Array(4 * (this.local.length / 3));
      for (let b = 0, at = 0; b < this.count; b++) {
        for (let c = 0; c < this.counts[b]; c++, at += 4) {
          made.set(colour.subarray(3 * b, 3 * b + 3), at);
          made[at + 3] = Math.round(255 * opacity[b]);
        }
      }
      return new BufferAttribute(made, 4, true);
    }

    makeSolids() {
      const { bodies, planar } = this.data;
      const opacity = PageData.array(bodies.opacity), owner = PageData.array(bodies.owner);
      const attributes = {
        position: this.corner, color: this.painted(PageData.array(bodies.colour), opacity),
        ...(planar ? {} : { normal: this.normal }),
      };
      for (const translucent of [false, true]) {
        const chosen = Array.from(owner.keys()).filter(
          (t) => opacity[owner[t]] > 0 && opacity[owner[t]] < 1 === translucent);
        if (!chosen.length) continue;
        const index = chosen.flatMap((t) => Array.from(this.triangles.subarray(3 * t, 3 * t + 3)));
        const material = new THREE.MeshLambertMaterial({
          vertexColors: true, flatShading: planar, transparent: translucent,
          depthWrite: !translucent, ...(planar ? { side: DoubleSide } : {}),
          polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        });
        const mesh = new Mesh(Members.indexed(attributes, index), material);
        mesh.body = chosen.map((t) => owner[t]);
        this.solids.push(Members.added(this.group, mesh, translucent ? 2 : 0));
      }
      const lines = new THREE.LineBasicMaterial({ vertexColors: true });
      const own = { position: this.corner, color: this.painted(PageData.array(bodies.edge), opacity) };
      const seen = this.corners(this.edges, 2, (b) => opacity[b] > 0);
      Members.added(this.group, new LineSegments(Members.indexed(own, seen), lines), 1);
    }

    /** Of indices of corners, so many together, those of some bodies. */
    corners(index, size, chosen) {
      const first = [0];
      for (const count of this.counts) first.push(first[first.length - 1] + count);
      const made = [];
      for (let i = 0, b = 0; i < index.length; i += size) {
        while (index[i] >= first[b + 1]) b++;
        if (chosen(b)) made.push(...index.subarray(i, i + size));
      }
      return made;
    }

    makeMarks() {
      const over = { transparent: true, depthTest: false, depthWrite: false };
      const faces = new THREE.MeshBasicMaterial({ ...over, opacity: 0.5, side: DoubleSide });
      const lines = new THREE.LineBasicMaterial(over);
      const at = () => Members.indexed({ position: this.corner }, []);
      this.marks = [
        Members.added(this.group, new Mesh(at(), faces), 8),
        Members.added(this.group, new LineSegments(at(), lines), 9),
      ];
      this.mark(-1);
    }

    /** Mark a body; none by -1. */
    mark(body) {
      [[this.triangles, 3], [this.edges, 2]].forEach(([index, size], k) => {
        this.marks[k].geometry.setIndex(this.corners(index, size, (b) => b === body));
        this.marks[k].visible = body >= 0;
      });
    }

    dress({ mark, ghost }) {
      for (const each of this.marks) each.material.color.setRGB(...mark);
      for (const each of this.ghost.children) each.material.color.setRGB(...ghost);
    }

    /** Compute the corners from the present shapes of the members. */
    move() {
      const { plan, shape } = this.members;
      const { rows, carrier } = this.data.bodies;
      const turned = (out, local, at, f, k) => out + local[at] * shape.frame[f + k]
        + local[at + 1] * shape.frame[f + 3 + k] + local[at + 2] * shape.frame[f + 6 + k];
      for (let b = 0, at = 0; b < this.count; b++) {
        const [row, end] = carrier ? carrier[b] : [rows[b][0], 0];
        if (row < 0) {
          this.stand(at, this.counts[b]);
          at += 3 * this.counts[b];
          continue;
        }
        const station = plan.station[row] + (end ? plan.stations[row] - 1 : 0);
        const f = 9 * station, o = 3 * station;
        for (let c = 0; c < this.counts[b]; c++, at += 3) {
          for (let k = 0; k < 3; k++) {
            this.corner.array[at + k] = turned(shape.centre[o + k], this.local, at, f, k);
            this.normal.array[at + k] = turned(0, this.localNormal, at, f, k);
          }
        }
      }
      this.corner.needsUpdate = this.normal.needsUpdate = true;
    }

    /** Of a body that moves with no member the corners are where they are. */
    stand(at, count) {
      this.corner.array.set(this.local.subarray(at, at + 3 * count), at);
      this.normal.array.set(this.localNormal.subarray(at, at + 3 * count), at);
    }

    /** Keep the present places as the ghost. */
    keepGhost() {
      const position = new BufferAttribute(this.corner.array.slice(), 3);
      const pale = { transparent: true, depthWrite: false };
      const lines = new THREE.LineBasicMaterial({ ...pale, opacity: 0.75 });
      const faces = new THREE.MeshBasicMaterial({ ...pale, opacity: 0.12, side: DoubleSide });
      const edges = Members.indexed({ position }, Array.from(this.edges));
      const whole = Members.indexed({ position }, Array.from(this.triangles));
      this.ghost = new THREE.Group();
      this.ghost.visible = false;
      Members.added(this.ghost, new LineSegments(edges, lines), 3);
      Members.added(this.ghost, new Mesh(whole, faces), 3);
      this.group.add(this.ghost);
    }
  }

  return { Bodies };
})();
