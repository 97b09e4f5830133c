// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The members as few large meshes: solid and translucent ones, edges, the ghost of the
// reference, and what is pointed at. All share the corners that Shapes computes.

const Members = (() => {
  const { BufferAttribute, BufferGeometry, DoubleSide, LineSegments, Mesh } = THREE;
  const MANY = 2000; // members; of more than so many edges and thin sides are left out

  function attribute(array, size, normalised = false) {
    const made = new BufferAttribute(array, size, normalised);
    made.setUsage(THREE.DynamicDrawUsage);
    return made;
  }

  function indexed(attributes, index) {
    const geometry = new BufferGeometry();
    for (const [name, each] of Object.entries(attributes)) geometry.setAttribute(name, each);
    geometry.setIndex(index);
    // All of the drawing lies within; nothing is measured anew when it moves.
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 2);
    return geometry;
  }

  function added(group, object, order = 0) {
    object.frustumCulled = false;
    object.renderOrder = order;
    group.add(object);
    return object;
  }

  class Members {
    constructor(data) {
      this.data = data;
      this.members = data.members;
      this.plan = Shapes.layout(data);
      this.shape = Shapes.room(this.plan);
      this.computed = 0; // times that shapes were computed
      this.group = new THREE.Group();
      this.corner = attribute(this.shape.corner, 3);
      this.normal = attribute(this.shape.normal, 3);
      this.paint = attribute(new Uint8Array(4 * this.plan.vertex[this.plan.count]), 4, true);
      this.makeSolids();
      this.makeEdges();
      this.makeMarks();
      this.paintOwn();
    }

    makeSolids() {
      const opacity = PageData.array(this.members.opacity);
      const shown = PageData.array(this.members.shown);
      this.seen = Array.from(opacity.keys()).filter((m) => opacity[m] > 0 && shown[m]);
      const detail = this.seen.length > MANY ? Surfaces.PLAIN : Surfaces.FULL;
      this.solids = [];
      for (const translucent of [false, true]) {
        const chosen = this.seen.filter((m) => opacity[m] < 1 === translucent);
        if (!chosen.length) continue;
        const parts = this.plan.smooth ? [Surfaces.FLAT, Surfaces.ROUND] : [Surfaces.FLAT];
        for (const part of parts) this.solids.push(this.solid(chosen, detail, part, translucent));
      }
    }

    /** A mesh of a part of some members that can be drawn in detail or lightly. */
    solid(rows, detail, part, translucent) {
      const flat = part === Surfaces.FLAT;
      const attributes = { position: this.corner, color: this.paint };
      if (!flat) attributes.normal = this.normal;
      const lighter = detail === Surfaces.PLAIN ? Surfaces.LIGHT : Surfaces.PLAIN;
      const [full, light] = [detail, lighter].map((each) => {
        const { index, owner } = Surfaces.triangles(this.plan, rows, each, part);
        return { geometry: indexed(attributes, index), owner };
      });
      const material = new THREE.MeshLambertMaterial({
        vertexColors: true, flatShading: flat,
        transparent: translucent, depthWrite: !translucent,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      });
      const mesh = added(this.group, new Mesh(full.geometry, material), translucent ? 2 : 0);
      return Object.assign(mesh, { owner: full.owner, full, light });
    }

    /** Draw lightly, or in full detail; no corner is computed anew. */
    lighten(on) {
      for (const mesh of this.solids) {
        const { geometry, owner } = on ? mesh.light : mesh.full;
        Object.assign(mesh, { geometry, owner });
      }
      this.edges.visible = !on;
    }

    makeEdges() {
      this.edgeIndex = this.seen.length > MANY ? [] : Surfaces.edges(this.plan, this.seen);
      const colour = new Uint8Array(3 * this.plan.vertex[this.plan.count]);
      const own = PageData.array(this.members.edge);
      for (let m = 0; m < this.plan.count; m++) {
        for (let v = this.plan.vertex[m]; v < this.plan.vertex[m + 1]; v++) {
          for (let k = 0; k < 3; k++) colour[3 * v + k] = own[3 * m + k];
        }
      }
      const attributes = { position: this.corner, color: new BufferAttribute(colour, 3, true) };
      const material = new THREE.LineBasicMaterial({ vertexColors: true });
      const lines = new LineSegments(indexed(attributes, this.edgeIndex), material);
      this.edges = added(this.group, lines, 1);
    }

    /** What lies over the members that are pointed at, also where others hide them. */
    makeMarks() {
      const over = { transparent: true, depthTest: false, depthWrite: false };
      const faces = new THREE.MeshBasicMaterial({ ...over, opacity: 0.5, side: DoubleSide });
      const lines = new THREE.LineBasicMaterial(over);
      this.marks = [
        added(this.group, new Mesh(indexed({ position: this.corner }, []), faces), 8),
        added(this.group, new LineSegments(indexed({ position: this.corner }, []), lines), 9),
      ];
      this.mark([]);
    }

    /** Mark some members, by their rows. */
    mark(rows) {
      const { index: faces } = Surfaces.triangles(this.plan, rows);
      [faces, Surfaces.edges(this.plan, rows)].forEach((index, k) => {
        this.marks[k].geometry.setIndex(index);
        this.marks[k].visible = rows.length > 0;
      });
    }

    /** Give marks and ghost the colours [r, g, b] of the page's light or dark. */
    dress({ mark, ghost }) {
      for (const each of this.marks) each.material.color.setRGB(...mark);
      this.ghostColour = ghost;
      if (this.ghost) for (const each of this.ghost.children) each.material.color.setRGB(...ghost);
    }

    /** The middle of a member: on its axis where it bends. */
    middle(m) {
      const { plan, shape } = this;
      const first = 3 * plan.station[m], last = first + 3 * (plan.stations[m] - 1);
      const inner = first + 3 * (plan.stations[m] >> 1);
      return plan.stations[m] > 2 ? Array.from(shape.centre.subarray(inner, inner + 3))
        : [0, 1, 2].map((k) => (shape.centre[first + k] + shape.centre[last + k]) / 2);
    }

    /** Compute the corners in a state. */
    move(state) {
      Shapes.compute(this.members, this.plan, state, this.shape);
      this.computed += 1;
      this.corner.needsUpdate = this.normal.needsUpdate = true;
    }

    /** Keep the present shapes as the ghost. */
    keepGhost() {
      const corner = new BufferAttribute(this.shape.corner.slice(), 3);
      const lines = new THREE.LineBasicMaterial({
        transparent: true, opacity: 0.75, depthWrite: false,
      });
      const faces = new THREE.MeshBasicMaterial({
        transparent: true, opacity: 0.12, depthWrite: false, side: DoubleSide,
      });
      const detail = this.seen.length > MANY ? Surfaces.LIGHT : Surfaces.FULL;
      const { index } = Surfaces.triangles(this.plan, this.seen, detail);
      const edges = indexed({ position: corner }, this.edgeIndex);
      this.ghost = new THREE.Group();
      this.ghost.visible = false;
      added(this.ghost, new LineSegments(edges, lines), 3);
      added(this.ghost, new Mesh(indexed({ position: corner }, index), faces), 3);
      this.group.add(this.ghost);
    }

    /** Paint every corner: colourOf(member, rgb, share along it) writes red, green and blue. */
    paintBy(colourOf) {
      const { plan, paint } = this;
      const opacity = PageData.array(this.members.opacity);
      const rgb = [0, 0, 0];
      for (let m = 0; m < plan.count; m++) {
        const last = plan.stations[m] - 1;
        let at = 4 * plan.vertex[m];
        for (let s = 0; s <= last; s++) {
          colourOf(m, rgb, s / last);
          for (let c = 0; c < plan.corners[m]; c++, at += 4) {
            for (let k = 0; k < 3; k++) paint.array[at + k] = Math.round(255 * rgb[k]);
            paint.array[at + 3] = Math.round(255 * opacity[m]);
          }
        }
      }
      paint.needsUpdate = true;
    }

    paintOwn() {
      this.paintBy(PageData.own(PageData.array(this.members.colour)));
    }

    /** Paint values at p and q, (2 a member), on the diverging scale that ends at +-largest. */
    paintValues(values, largest) {
      const { stops } = this.data;
      this.paintBy((m, rgb, share) => {
        const value = (1 - share) * values[2 * m] + share * values[2 * m + 1];
        PageData.diverging(stops, largest ? value / largest : 0, rgb);
      });
    }
  }

  return { Members, added, indexed };
})();
