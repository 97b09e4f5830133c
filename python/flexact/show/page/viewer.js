// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The viewer: puts the parts together, and shows movements and self-stresses.

const Viewer = (() => {
  const HEAVY = 300; // members
  const CHROME = {
    light: { ghost: [0.45, 0.48, 0.53], lighter: 0 },
    dark: { ghost: [0.62, 0.66, 0.72], lighter: 0.4 },
  };

  class Viewer {
    /** A viewer of some data in the part of the page that is its root. */
    constructor(root, data, context, before = null) {
      Object.assign(this, { root, data });
      this.peers = []; // viewers that look from the same side, and play in step
      this.changed = () => {}; // called when something else is shown
      this.held = null; // what was clicked: its mark stays
      this.error = 0; // size of the misalignment that is shown [m, rad]
      this.pose = Tracks.reference(data);
      this.movement = this.stress = this.space = null;
      this.quantity = "";
      this.layers = { solids: true, diagram: false, ghost: true, arrows: true, presses: true, symbols: true };
      this.stage = new Stage.Stage(this.part("canvas"), context, data, before);
      this.members = new Members.Members(data);
      this.bodies = new Bodies.Bodies(data, this.members);
      this.hinges = new Symbols.Hinges(data);
      this.supports = new Symbols.Supports(data);
      this.joints = new Symbols.Joints(data);
      this.freedoms = new Symbols.Freedoms(data);
      this.displacements = new Symbols.Displacements(data.colours.arrow);
      this.presses = new Symbols.Presses(data);
      this.spaces = new Spaces.Spaces(data);
      this.nodeMark = new Symbols.NodeMark();
      this.diagram = new Diagram.Diagram(this.members);
      this.overlay = new Overlay.Overlay(this.part("overlay"), this.stage, data, this);
      this.player = new Tracks.Player((phase) => this.movePhase(phase));
      this.assemble();
      this.index();
    }

    /** A part of the page that belongs to the drawing. */
    part(name) {
      return this.root.querySelector(`.${name}`);
    }

    assemble() {
      const { stage } = this;
      for (const part of [this.members, this.bodies, this.hinges, this.supports, this.joints,
        this.freedoms, this.displacements, this.presses, this.diagram, this.spaces]) {
        stage.scene.add(part.group);
      }
      stage.scene.add(this.nodeMark.mesh);
      Shadow.Shadow.cast(...this.members.solids, ...this.bodies.solids, this.hinges.group,
        this.supports.group, this.joints.group);
      stage.before.push((time) => this.player.step(time));
      stage.before.push(() => this.diagram.isPassed(stage.towards) && this.drawDiagram());
      stage.after.push(() => this.overlay.draw());
      stage.heavy = this.members.plan.count > HEAVY;
      stage.slow = stage.heavy && stage.software;
      stage.lightened = (on) => this.lighten(on);
      this.follow();
      this.members.keepGhost();
      this.bodies.keepGhost();
      this.landmarks = this.landmarksNow();
      stage.swing = (look) => this.swing(look);
      stage.look("iso");
    }

    /** Leave out what takes long to draw, or draw it again. */
    lighten(on) {
      this.members.lighten(on);
      this.showLayers();
      if (!on) return;
      this.members.ghost.visible = this.bodies.ghost.visible = false;
      this.supports.group.visible = this.joints.group.visible = false;
    }

    /** Call `look` in the reference and at both ends of the movement. */
    swing(look) {
      for (const phase of this.movement ? [0, -1, 1] : [0]) {
        this.movePhase(phase);
        look();
      }
      if (this.movement) this.movePhase(this.player.phase);
    }

    /** Rows of the drawing by the numbers of elements and nodes. */
    index() {
      const rows = (packed) => new Map(Array.from(PageData.array(packed), (n, i) => [n, i]));
      this.memberOf = rows(this.data.members.number);
      this.hingeOf = rows(this.data.hinges.number);
      this.nodeOf = rows(this.data.nodes.number);
      this.heldOf = new Map(); // what holds a body, by its elements, or its node
      for (const held of this.data.held) {
        for (const number of held.own) this.heldOf.set(number, held);
        if (!held.own.length) this.heldOf.set(`node ${held.node}`, held);
      }
    }

    /** What holds the body of an element, or a point, by their numbers; undefined of others. */
    holding({ element, node }) {
      return this.heldOf.get(element === undefined ? `node ${node}` : element);
    }

    /** Draw everything in the present pose. */
    follow() {
      this.members.move(this.pose);
      this.bodies.move();
      for (const part of [this.hinges, this.supports, this.joints, this.freedoms, this.presses,
        this.nodeMark]) {
        part.move(this.pose);
      }
      this.drawDiagram();
      this.stage.request();
    }

    movePhase(phase) {
      if (this.movement) Tracks.move(this.pose, this.data, this.movement, phase);
      this.follow();
    }

    showMovement(which) {
      this.pose = Tracks.reference(this.data);
      this.movement = this.data.movements[which] || null;
      this.showLayers();
      if (this.movement) {
        this.pointArrows();
        for (const { player } of [this, ...this.peers]) player.begin();
      } else this.follow();
      this.stage.refit();
      this.refresh();
    }

    /** Take the same movements in other shapes; the one that is shown plays on. */
    take(movements) {
      const shown = this.data.movements.indexOf(this.movement);
      this.data.movements = movements;
      if (shown < 0) return;
      this.pose = Tracks.reference(this.data);
      this.movement = movements[shown];
      this.pointArrows();
      this.movePhase(this.player.phase);
      this.refresh();
    }

    /** Arrows from the reference to the largest displacement: of nodes, and of bent members. */
    pointArrows() {
      Tracks.move(this.pose, this.data, this.movement, 1);
      this.members.move(this.pose);
      this.displacements.show(this.landmarks, this.landmarksNow());
    }

    landmarksNow() {
      const { plan } = this.members;
      const made = [];
      for (const node of PageData.array(this.data.nodes.placed)) {
        made.push(...this.place(node));
      }
      for (let m = 0; m < plan.count; m++) {
        if (plan.stations[m] > 2) made.push(...this.members.middle(m));
      }
      return made;
    }

    /** Show the stress of a misalignment of a size [m, rad]; of none what was shown before. */
    misalign(size) {
      this.error = size;
      this.paint();
      this.refresh();
    }

    /** What the misalignment does at its size, and at most; stresses in MPa by rows of members.

        Where strengths are given the colours end at them: of one for all in MPa, else in percent. */
    get misaligned() {
      const { elements, peaks, values, measure, strengths } = this.data.misaligned, last = values.length - 1;
      const at = Math.max(1, values.findIndex((each) => each >= this.error));
      const share = (this.error - values[at - 1]) / (values[at] - values[at - 1]);
      const most = Math.max(...peaks) * 1e-6, error = Math.abs(this.error);
      const isOne = strengths && strengths.every((each) => each === strengths[0]);
      const scale = (k) => (strengths && !isOne ? 100 / strengths[k] : 1e-6);
      const stress = new Float32Array(2 * this.members.plan.count);
      elements.forEach((number, k) => {
        const row = this.memberOf.get(number), own = peaks[k] * scale(k) * error;
        if (row !== undefined) stress.fill(own, 2 * row, 2 * row + 2);
      });
      return {
        stress, peak: most * error,
        largest: strengths ? strengths[0] * scale(0) : most * Math.max(-values[0], values[last]),
        unit: strengths && !isOne ? "% of the strength" : "MPa",
        used: strengths ? Math.max(...peaks.map((peak, k) => (peak * error) / strengths[k])) : null,
        measure: measure[at - 1] + share * (measure[at] - measure[at - 1]), rest: measure[values.indexOf(0)],
      };
    }

    showStress(which) {
      this.error = 0;
      this.stress = this.data.stresses[which] || null;
      this.showLayers();
      this.presses.move(this.pose);
      this.stage.refit();
      this.showQuantity(this.stress ? this.stress.dominant : this.quantity);
    }

    showSpace(which) {
      this.space = this.data.spaces[which] || null;
      this.spaces.show(which);
      this.stage.refit();
      this.stage.request();
      this.refresh();
    }

    showQuantity(quantity) {
      this.quantity = quantity;
      this.paint();
      this.refresh();
    }

    values() {
      const packed = this.stress && this.stress.members[this.quantity];
      return packed ? PageData.array(packed) : null;
    }

    paint() {
      const { stress, quantity } = this;
      if (this.error) {
        const { stress: values, largest } = this.misaligned;
        this.members.paintValues(values, largest);
        this.hinges.paintOwn();
      } else if (!stress) {
        this.members.paintOwn();
        this.hinges.paintOwn();
      } else {
        const largest = stress.largest[quantity];
        const none = new Float32Array(2 * this.members.plan.count);
        this.members.paintValues(this.values() || none, largest);
        const packed = stress.hinges[quantity];
        this.hinges.paintValues(packed && PageData.array(packed), largest, this.data.stops);
      }
      this.drawDiagram();
      this.legend();
      this.stage.request();
    }

    drawDiagram() {
      const { stress, quantity } = this;
      const values = this.layers.diagram && this.values();
      const largest = stress ? stress.largest[quantity] : 0;
      this.diagram.show(values ? quantity : "", values, largest, this.stage.towards);
    }

    legend() {
      const { stress, quantity, data } = this;
      const stops = this.error ? data.stops.slice((data.stops.length - 1) / 2) : data.stops;
      this.part("legend").hidden = !stress && !this.error;
      this.part("legend-bar").style.background = PageData.gradient(stops);
      this.part("legend-low").nextElementSibling.hidden = Boolean(this.error);
      if (this.error) {
        const { unit, largest, used } = this.misaligned, ends = used === null ? "" : "; the colours end at the strength";
        this.part("legend-name").textContent = `largest normal stress [${unit}]`;
        this.part("legend-low").textContent = "0";
        this.part("legend-high").textContent = Words.number(largest);
        this.part("legend-note").textContent = `in proportion to the misalignment${ends}`;
        return;
      }
      if (!stress) return;
      const largest = stress.largest[quantity] || 0;
      this.part("legend-name").textContent = quantity
        ? `${data.names[quantity]} [${Words.unitOf(data, quantity)}]` : "";
      this.part("legend-low").textContent = largest ? Words.number(-largest) : "";
      this.part("legend-high").textContent = largest ? Words.number(largest) : "";
      this.part("legend-note").textContent = data.sides[quantity];
    }

    play(on) {
      this.player.playing = on;
      this.stage.request();
      this.refresh();
    }

    amplify(amplitude) {
      this.player.amplitude = amplitude;
      // At rest it is the size itself that is looked at.
      if (!this.player.playing) this.player.cycle = 0;
      this.movePhase(this.player.phase);
    }

    layer(name, on) {
      this.layers[name] = on;
      if (name === "elements") this.elementLabels = on;
      if (name === "nodes") this.nodeLabels = on;
      this.showLayers();
      this.presses.move(this.pose);
      this.drawDiagram();
      this.stage.refit();
      this.stage.request();
    }

    showLayers() {
      const ghost = Boolean(this.movement && this.layers.ghost);
      this.members.ghost.visible = this.bodies.ghost.visible = ghost;
      this.displacements.group.visible = Boolean(this.movement && this.layers.arrows);
      this.presses.show(this.layers.presses ? this.stress : null);
      this.joints.group.visible = true;
      this.bodies.group.visible = this.layers.solids;
      this.supports.group.visible = this.layers.symbols;
      // They may lie along one line with what presses.
      this.freedoms.group.visible = this.layers.symbols && !this.presses.group.visible;
    }

    /** Keep the mark of an element or a node, until another is clicked; null lets go. */
    hold(target) {
      this.held = target;
      this.mark(target || {});
      this.refresh();
    }

    /** Mark an element or a node by its number; without either what is held. */
    mark(target) {
      const named = ["element", "node", "body"].some((key) => target[key] !== undefined);
      const { element, node, body: solid } = named ? target : this.held || {};
      const row = this.memberOf.get(element);
      const body = solid === undefined ? this.bodies.bodyOf.get(row)
        : this.data.bodies.names.indexOf(solid);
      const held = this.holding({ element, node });
      const by = held ? held.by.map((number) => this.memberOf.get(number)) : [];
      this.members.mark([...by, ...(body === undefined ? [row] : [])]
        .filter((each) => each !== undefined));
      this.bodies.mark(body === undefined ? -1 : body);
      this.nodeMark.node = this.placeOf(element, node);
      this.nodeMark.move(this.pose);
      this.stage.request();
    }

    /** The position node where a hinge or a node stands, by its number; -1 where none is known. */
    placeOf(element, node) {
      const hinge = this.hingeOf.get(element), index = this.nodeOf.get(node);
      if (hinge !== undefined) return PageData.array(this.data.hinges.node)[hinge];
      return index === undefined ? -1 : PageData.array(this.data.nodes.place)[index];
    }

    /** Where a position node is in the present pose. */
    place(node) {
      return this.pose.position.subarray(3 * node, 3 * node + 3);
    }

    /** Bring what is held, or another element or node, into the middle. */
    visit({ element, node } = this.held || {}) {
      const row = this.memberOf.get(element);
      const place = this.placeOf(element, node);
      if (row !== undefined) this.stage.centre(...this.members.middle(row));
      else if (place >= 0) this.stage.centre(...this.place(place));
    }

    /** Lines about what is pointed at. */
    describe(found) {
      const { kind, row } = found, held = this.holding(this.targetOf(found));
      const lines = kind === "node" ? Words.node(this.data, row, this.pose, this.movement)
        : Words[kind](this.data, row, this.stress);
      return held ? [...lines, held.words] : lines;
    }

    /** The number by which the tables know what is pointed at. */
    targetOf({ kind, row }) {
      const { nodes, members, hinges, bodies } = this.data;
      if (kind === "body") {
        const [first] = bodies.rows[row];
        // What is no member of the model is known by its name.
        if (first === undefined) return { body: bodies.names[row] };
        return this.targetOf({ kind: "member", row: first });
      }
      const { number } = { node: nodes, member: members, hinge: hinges }[kind];
      const key = kind === "node" ? "node" : "element", found = PageData.array(number)[row];
      const held = this.holding({ [key]: found });
      // A body is known by its first element.
      return { [key]: held ? held[key] : found };
    }

    /** The page has become light or dark. */
    dress() {
      const look = CHROME[Theme.isDark(this.root) ? "dark" : "light"];
      const chrome = { ...look, mark: this.data.colours.mark };
      this.members.dress(chrome);
      this.bodies.dress(chrome);
      this.spaces.dress(chrome);
      this.presses.dress(chrome);
      this.nodeMark.dress(chrome);
      this.stage.request();
    }

    refresh() {
      const shown = this.part("shown"), caption = this.caption();
      if (shown.textContent !== caption) {
        shown.textContent = caption;
        Terms.mark(shown);
      }
      this.changed();
    }

    /** The quantities that the self-stress which is shown has. */
    get quantities() {
      const { stress } = this;
      return stress ? Object.keys(stress.members).concat(Object.keys(stress.hinges)) : [];
    }

    /** Look from the same side as another viewer, and play in step with it. */
    join(other) {
      for (const [one, two] of [[this, other], [other, this]]) {
        one.peers.push(two);
        one.stage.peers.push(two.stage);
      }
    }

    caption() {
      const { movement, stress, quantity, space, data } = this;
      const parts = [];
      if (space) parts.push(space.title);
      if (movement) parts.push(`${movement.title}. ${movement.note}`);
      if (stress) parts.push(`${stress.title}: ${data.meaning[quantity]}. ${stress.presses.note}`.trim());
      return parts.join(" ") || "The reference configuration.";
    }
  }

  return { Viewer };
})();
