// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Freedom and constraint spaces of a body: lines, faces that shine through, arrows; wires to add.

const Spaces = (() => {
  const { BufferAttribute, CylinderGeometry, DoubleSide, Mesh, Vector3 } = THREE;
  const LINE = 0.0035, BOLD = 0.007, WIRE = 0.008, ARROW = 0.008; // thicknesses
  const OVER = 7; // arrows and wires are seen through what is before them
  const SECOND = 0.84; // where the second head of a couple is, along its arrow
  const OPACITY = 0.17;
  const start = new Vector3(), way = new Vector3();

  class Spaces {
    constructor(data) {
      this.group = new THREE.Group();
      this.painted = []; // materials, and colours that they have on a light page
      this.groups = data.spaces.map((space) => this.made(space, data.colours));
      for (const each of this.groups) this.group.add(each);
      this.show(-1);
    }

    made(space, colours) {
      const group = new THREE.Group();
      group.ways = [];
      const colour = colours[space.freedom ? "freedom space" : "constraint space"];
      this.addFaces(group, space, colour);
      const thick = space.bold ? BOLD : LINE;
      this.addSticks(group, PageData.array(space.lines), thick, colour, 0);
      const seen = PageData.inCss(colour);
      eachPair(PageData.array(space.lines), (_, length) => group.ways.push({
        at: start.clone().addScaledVector(way, length / 2).toArray(), way: way.toArray(),
        turn: space.freedom, colour: seen }));
      eachPair(PageData.array(space.arrows), (_, length) => group.ways.push({
        at: start.toArray(), way: way.toArray(), turn: !space.freedom, colour: seen }));
      this.addArrows(group, PageData.array(space.arrows), space.freedom ? [1] : [1, SECOND], colour);
      this.addSticks(group, PageData.array(space.wires), WIRE, colours["new wire"], OVER);
      return group;
    }

    addFaces(group, space, colour) {
      const position = new BufferAttribute(PageData.array(space.corners), 3);
      const geometry = Members.indexed({ position }, Array.from(PageData.array(space.triangles)));
      const material = new THREE.MeshBasicMaterial({
        transparent: true, opacity: OPACITY, depthWrite: false, side: DoubleSide,
      });
      if (position.count) Members.added(group, new Mesh(geometry, material), 6);
      this.painted.push([material, colour]);
    }

    /** Straight pieces between pairs of points. */
    addSticks(group, ends, thick, colour, order) {
      const rod = new CylinderGeometry(0.5, 0.5, 1, 8).translate(0, 0.5, 0);
      const sticks = new Symbols.Copies(rod, ends.length / 6, colour);
      eachPair(ends, (i, length) => sticks.set(i, start, way, thick, length));
      sticks.done();
      this.keep(group, [sticks], colour, order);
    }

    /** Arrows with heads at some parts of their lengths. */
    addArrows(group, ends, parts, colour) {
      const count = ends.length / 6;
      const arrows = new Symbols.Arrows(count * parts.length, colour, ARROW);
      parts.forEach((part, k) => eachPair(ends, (i, length) =>
        arrows.set(k * count + i, start, way, part * length)));
      arrows.done(count * parts.length);
      this.keep(group, [arrows.shafts, arrows.heads], colour, OVER);
    }

    keep(group, copies, colour, order) {
      for (const { mesh } of copies) {
        mesh.renderOrder = order;
        // What is drawn late lies over the rest only where it counts as translucent.
        Object.assign(mesh.material, { transparent: order > 0, depthTest: order === 0 });
        group.add(mesh);
        this.painted.push([mesh.material, colour]);
      }
    }

    /** Axes and arrows of what is shown. */
    endOn() {
      return this.groups.filter(({ visible }) => visible).flatMap(({ ways }) => ways);
    }

    show(...which) {
      this.groups.forEach((group, k) => { group.visible = which.includes(k); });
    }

    /** On a dark page the colours are lighter. */
    dress({ lighter }) {
      for (const [material, colour] of this.painted) {
        material.color.setRGB(...colour.map((part) => part + lighter * (1 - part)));
      }
    }
  }

  /** Call `act(i, length)` for each pair of points, with `start` and the unit vector `way` set. */
  function eachPair(ends, act) {
    for (let i = 0; i < ends.length / 6; i++) {
      start.fromArray(ends, 6 * i);
      way.fromArray(ends, 6 * i + 3).sub(start);
      const length = way.length();
      way.divideScalar(length || 1);
      act(i, length);
    }
  }

  return { Spaces };
})();
