// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Hinges, supports and arrows: many copies of a few small bodies, each drawn in one go.

const Symbols = (() => {
  const {
    BoxGeometry, ConeGeometry, CylinderGeometry, Matrix4, Quaternion, TorusGeometry, Vector3,
  } = THREE;
  const MOST_ARROWS = 240;
  const MANY_JOINTS = 300;
  const LEAST = 0.06; // of the largest displacement; smaller ones get no arrow
  const UP = new Vector3(0, 1, 0);

  /** Copies of a body whose y axis is its direction: `set` places them one by one. */
  class Copies {
    constructor(geometry, count, colour) {
      this.mesh = new THREE.InstancedMesh(geometry, new THREE.MeshLambertMaterial(), count);
      this.mesh.frustumCulled = false;
      this.mesh.material.color.setRGB(...colour);
      this.mesh.visible = count > 0;
    }

    set(i, place, direction, across, along) {
      turn.setFromUnitVectors(UP, direction);
      matrix.compose(place, turn, size.set(across, along, across));
      this.mesh.setMatrixAt(i, matrix);
    }

    done(count = this.mesh.count) {
      this.mesh.count = count;
      this.mesh.visible = count > 0;
      this.mesh.instanceMatrix.needsUpdate = true;
      this.mesh.boundingSphere = new THREE.Sphere(new Vector3(), 4);
    }
  }

  const matrix = new Matrix4(), turn = new Quaternion(), size = new Vector3();
  const place = new Vector3(), direction = new Vector3(), start = new Vector3();

  const at = (position, node) => place.fromArray(position, 3 * node);

  /** Bodies of a kind of support of size one: x points from the ground to what is held. */
  const SUPPORTS = {
    1: () => [block(1, 1, 0)], // clamp
    2: () => [pyramid(), block(0.28, 1.7, -1)], // pin
    3: () => [cone(1.1, 0.45)], // slide
    4: () => [cone(0.7, 0.4), cone(0.7, 0.4).rotateZ(Math.PI)], // turn
  };

  const block = (thick, wide, below) =>
    new BoxGeometry(thick, wide, wide).translate(below - thick / 2, 0, 0);
  const pyramid = () => faceted(new ConeGeometry(0.75, 1, 4).rotateY(Math.PI / 4)
    .translate(0, -0.5, 0).rotateZ(-Math.PI / 2));
  const cone = (long, wide) => new ConeGeometry(wide, long, 20).translate(0, -long / 2, 0)
    .rotateZ(-Math.PI / 2);

  /** A body whose faces share no corners, so that each is flat. */
  function faceted(geometry) {
    const made = geometry.toNonIndexed();
    made.computeVertexNormals();
    return made;
  }

  class Supports {
    constructor(data) {
      const { node, kind, frame, offset, size: sizes } = data.supports;
      this.group = new THREE.Group();
      const kinds = PageData.array(kind);
      const colour = data.colours.support.map((part) => Math.min(1, 1.35 * part));
      this.sets = Object.keys(SUPPORTS).map(Number).flatMap((each) => {
        const rows = Array.from(kinds.keys()).filter((i) => kinds[i] === each);
        return SUPPORTS[each]().map((geometry) => {
          const copies = new Copies(geometry, rows.length, colour);
          this.group.add(copies.mesh);
          return { copies, rows };
        });
      });
      this.node = PageData.array(node);
      this.frame = PageData.array(frame);
      this.offset = PageData.array(offset);
      this.sizes = PageData.array(sizes);
    }

    /** What can be pointed at. */
    get solids() {
      return this.group.visible ? this.sets.map(({ copies }) => copies.mesh) : [];
    }

    /** The node that a copy in one of the solids holds; undefined of another solid. */
    nodeOf(mesh, copy) {
      const found = this.sets.find(({ copies }) => copies.mesh === mesh);
      return found && this.node[found.rows[copy]];
    }

    move(pose) {
      for (const { copies, rows } of this.sets) {
        rows.forEach((row, i) => {
          const [w, x, y, z] = this.frame.subarray(4 * row, 4 * row + 4);
          start.fromArray(this.offset, 3 * row).add(at(pose.position, this.node[row]));
          matrix.compose(start, turn.set(x, y, z, w),
            size.fromArray(this.sizes, 3 * row));
          copies.mesh.setMatrixAt(i, matrix);
        });
        copies.done();
      }
    }
  }

  /** Balls where members turn freely about their ends. */
  class Joints {
    constructor(data) {
      this.node = PageData.array(data.joints.node);
      this.radius = PageData.array(data.joints.radius);
      const few = this.node.length > MANY_JOINTS;
      const ball = new THREE.SphereGeometry(1, few ? 6 : 20, few ? 4 : 14);
      this.copies = new Copies(ball, this.node.length, [0.55, 0.58, 0.62]);
      this.group = new THREE.Group();
      this.group.add(this.copies.mesh);
    }

    move(pose) {
      this.node.forEach((node, i) => {
        const radius = this.radius[i];
        this.copies.set(i, at(pose.position, node), UP, radius, radius);
      });
      this.copies.done();
    }
  }

  class Hinges {
    constructor(data) {
      const { hinges } = data;
      this.node = PageData.array(hinges.node);
      this.sizes = PageData.array(hinges.size);
      this.colour = PageData.array(hinges.colour);
      this.count = hinges.names.length;
      this.copies = new Copies(new CylinderGeometry(0.5, 0.5, 1, 20), this.count, [1, 1, 1]);
      this.group = new THREE.Group();
      this.group.add(this.copies.mesh);
      this.paintOwn();
    }

    paintOwn() {
      this.paint(PageData.own(this.colour));
    }

    /** Paint values, one a hinge or none at all, on the diverging scale that ends at +-largest. */
    paintValues(values, largest, stops) {
      this.paint((i, rgb) =>
        PageData.diverging(stops, values && largest ? values[i] / largest : 0, rgb));
    }

    paint(colourOf) {
      const colour = new THREE.Color(), rgb = [0, 0, 0];
      for (let i = 0; i < this.count; i++) {
        colourOf(i, rgb);
        this.copies.mesh.setColorAt(i, colour.setRGB(...rgb));
      }
      if (this.count) this.copies.mesh.instanceColor.needsUpdate = true;
    }

    move(pose) {
      for (let i = 0; i < this.count; i++) {
        const node = this.node[i], known = node >= 0 ? 1 : 0; // one that stands nowhere is unseen
        direction.fromArray(pose.axis, 3 * i).normalize();
        this.copies.set(i, at(pose.position, Math.max(node, 0)), direction,
          known * this.sizes[2 * i + 1], known * this.sizes[2 * i]);
      }
      this.copies.done();
    }
  }

  /** Have copies drawn late, over whatever is there; they hide each other as they lie. */
  function inFront(first, ...others) {
    [first, ...others].forEach((mesh, k) => {
      mesh.renderOrder = 7 + (k > 0);
      mesh.material.transparent = true; // what is not is drawn before
    });
    first.onBeforeRender = (renderer) => renderer.clearDepth();
  }

  /** Straight arrows: shafts and heads of a few thicknesses. */
  class Arrows {
    constructor(most, colour, thick) {
      Object.assign(this, { thick, ways: [], colour: PageData.inCss(colour) });
      this.shafts = new Copies(new CylinderGeometry(0.5, 0.5, 1, 10).translate(0, 0.5, 0), most, colour);
      this.heads = new Copies(new ConeGeometry(0.5, 1, 14).translate(0, 0.5, 0), most, colour);
      this.group = new THREE.Group();
      this.group.add(this.shafts.mesh, this.heads.mesh);
      inFront(this.shafts.mesh, this.heads.mesh);
    }

    /** Place arrow i from a point along a unit direction. */
    set(i, from, way, length) {
      this.ways[i] = { at: from.toArray(), way: way.toArray(), colour: this.colour };
      const head = Math.min(4.5 * this.thick, 0.6 * length);
      this.shafts.set(i, from, way, this.thick, length - head);
      place.copy(from).addScaledVector(way, length - head);
      this.heads.set(i, place, way, 2.9 * this.thick, head);
    }

    done(count) {
      this.count = count;
      this.shafts.done(count);
      this.heads.done(count);
    }

    /** Where arrows stand, which way they point and in which colour. */
    endOn() {
      return this.ways.slice(0, this.count);
    }
  }

  /** Arrows from where points are, (3 each), to where they go; the largest ones. */
  class Displacements extends Arrows {
    constructor(colour) {
      super(MOST_ARROWS, colour, 0.0065);
      this.group.visible = false;
    }

    show(from, to) {
      const lengths = Float64Array.from({ length: from.length / 3 }, (_, i) =>
        Math.hypot(...[3 * i, 3 * i + 1, 3 * i + 2].map((k) => to[k] - from[k])));
      const least = LEAST * lengths.reduce((a, b) => Math.max(a, b), 0);
      const chosen = Array.from(lengths.keys()).filter((i) => lengths[i] > least)
        .sort((a, b) => lengths[b] - lengths[a]).slice(0, MOST_ARROWS);
      chosen.forEach((i, row) => {
        start.fromArray(from, 3 * i);
        direction.fromArray(to, 3 * i).sub(start).divideScalar(lengths[i]);
        this.set(row, start, direction, lengths[i]);
      });
      this.done(chosen.length);
    }
  }

  /** What parts press on bodies in a self-stress. */
  class Presses extends Arrows {
    constructor({ colours, stresses }) {
      const counts = stresses.map(({ presses }) => PageData.array(presses.node).length);
      super(Math.max(0, ...counts), colours.press, 0.0075);
      this.tint = colours.press;
      this.show(null);
    }

    show(stress) {
      this.group.visible = Boolean(stress);
      const { node, offset, way } = stress ? stress.presses : {};
      if (stress) Object.assign(this, { node, offset, ways3: way });
    }

    move(pose) {
      if (!this.group.visible) return;
      const node = PageData.array(this.node), offset = PageData.array(this.offset);
      node.forEach((each, i) => {
        direction.fromArray(PageData.array(this.ways3), 3 * i);
        const length = direction.length();
        at(pose.position, each);
        start.fromArray(offset, 3 * i).add(place);
        this.set(i, start, direction.divideScalar(length), length);
      });
      this.done(node.length);
    }

    /** On a dark page it is lighter. */
    dress({ lighter }) {
      for (const { mesh } of [this.shafts, this.heads]) {
        mesh.material.color.setRGB(...this.tint.map((part) => part + lighter * (1 - part)));
      }
    }
  }

  /** Declared degrees of freedom: arrows along, and arcs with a head about, their axes. */
  class Freedoms {
    constructor(data) {
      const { node, direction: way, start: out, turning } = data.arrows;
      this.node = PageData.array(node);
      this.way = PageData.array(way);
      this.out = PageData.array(out);
      const turns = PageData.array(turning);
      const rows = Array.from(turns.keys());
      this.straight = rows.filter((i) => !turns[i]);
      this.turning = rows.filter((i) => turns[i]);
      const colour = data.colours.freedom;
      this.arrows = new Arrows(this.straight.length, colour, 0.009);
      // Three quarters of a circle about y, and a head at its end.
      const arc = new TorusGeometry(0.05, 0.0045, 8, 40, 1.5 * Math.PI).rotateX(Math.PI / 2);
      const head = new ConeGeometry(0.013, 0.035, 14).rotateZ(-Math.PI / 2)
        .translate(0.012, 0, -0.05);
      this.arcs = [arc, head].map((each) => new Copies(each, this.turning.length, colour));
      inFront(...this.arcs.map(({ mesh }) => mesh));
      this.group = new THREE.Group();
      this.group.add(this.arrows.group, ...this.arcs.map((each) => each.mesh));
    }

    endOn() {
      return this.arrows.endOn();
    }

    move(pose) {
      this.straight.forEach((row, i) => {
        direction.fromArray(this.way, 3 * row);
        start.fromArray(pose.position, 3 * this.node[row])
          .addScaledVector(direction, Math.max(this.out[row], 0.012));
        this.arrows.set(i, start, direction, 0.12);
      });
      this.arrows.done(this.straight.length);
      this.turning.forEach((row, i) => {
        direction.fromArray(this.way, 3 * row);
        for (const each of this.arcs) {
          each.set(i, at(pose.position, this.node[row]), direction, 1, 1);
        }
      });
      for (const each of this.arcs) each.done(this.turning.length);
    }
  }

  /** A ball at the node that is pointed at. */
  class NodeMark {
    constructor() {
      const material = new THREE.MeshBasicMaterial({ transparent: true, depthTest: false });
      this.mesh = new THREE.Mesh(new THREE.SphereGeometry(0.011, 20, 12), material);
      this.mesh.renderOrder = 10;
      this.node = -1;
    }

    dress({ mark }) {
      this.mesh.material.color.setRGB(...mark);
    }

    move(pose) {
      this.mesh.visible = this.node >= 0;
      if (this.node >= 0) this.mesh.position.fromArray(pose.position, 3 * this.node);
    }
  }

  return { Copies, Arrows, Supports, Joints, Hinges, Displacements, Presses, Freedoms, NodeMark };
})();
