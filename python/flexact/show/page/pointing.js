// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// What lies under the pointer: a node, else a member, a body or a hinge.

const Pointing = (() => {
  const REACH = 8; // pixels
  const STILL = 4; // pixels that the pointer may move in a click

  class Pointing {
    /** `found({kind, row, x, y})` is called when something else is pointed at; null for nothing. */
    constructor(stage, state, found) {
      Object.assign(this, { stage, state, found });
      this.raycaster = new THREE.Raycaster();
      const { canvas, ending: { signal } } = stage;
      const listen = (kind, act) => canvas.addEventListener(kind, act, { signal });
      listen("pointermove", (event) => {
        if (event.buttons) this.clear();
        else this.later(event);
      });
      this.clicked = () => {}; // called with what is clicked; null for nothing
      this.doubled = () => {}; // and with what is clicked twice
      listen("dblclick", ({ offsetX, offsetY }) =>
        this.doubled(this.look(offsetX, offsetY)));
      listen("pointerdown", ({ offsetX, offsetY }) => {
        this.pressed = [offsetX, offsetY];
      });
      listen("pointerup", (event) => {
        const [x, y] = this.pressed || [Infinity, Infinity];
        this.pressed = null;
        if (Math.hypot(event.offsetX - x, event.offsetY - y) > STILL) return this.later(event);
        const found = this.look(event.offsetX, event.offsetY);
        this.clicked(found);
        this.tell(found);
      });
      // A finger leaves as it lifts; what it tapped stays told.
      listen("pointerleave", ({ pointerType }) => {
        if (pointerType !== "touch") this.clear();
      });
    }

    /** Look once a frame at most. */
    later(event) {
      this.place = [event.offsetX, event.offsetY];
      if (this.waiting) return;
      this.waiting = requestAnimationFrame(() => {
        this.waiting = 0;
        if (this.place) this.tell(this.look(...this.place));
      });
    }

    clear() {
      this.place = null;
      this.tell(null);
    }

    tell(target) {
      if (!target && !this.last) return;
      this.last = target;
      this.found(target);
    }

    look(x, y) {
      return this.nodeAt(x, y) || this.solidAt(x, y);
    }

    nodeAt(x, y) {
      const { stage, state } = this;
      let best = null, least = REACH;
      for (const node of PageData.array(state.data.nodes.placed)) {
        const [nx, ny] = stage.project(...state.place(node));
        const distance = Math.hypot(nx - x, ny - y);
        if (distance < least) {
          least = distance;
          best = { kind: "node", row: node, x, y };
        }
      }
      return best;
    }

    solidAt(x, y) {
      const { stage, state } = this;
      const pointer = new THREE.Vector2(
        (x / stage.width) * 2 - 1, 1 - (y / stage.height) * 2);
      this.raycaster.setFromCamera(pointer, stage.camera);
      const { members, bodies, hinges, supports } = state;
      const around = bodies.group.visible ? bodies.solids : [];
      const solids = [...members.solids, ...around, hinges.copies.mesh, ...supports.solids];
      const [hit] = this.raycaster.intersectObjects(solids, false);
      if (!hit) return this.lineAt(x, y);
      const held = supports.nodeOf(hit.object, hit.instanceId);
      if (held !== undefined) return { kind: "node", row: held, x, y };
      if (hit.object.body) return { kind: "body", row: hit.object.body[hit.faceIndex], x, y };
      const row = hit.object.owner ? hit.object.owner[hit.faceIndex] : hit.instanceId;
      return { kind: hit.object.owner ? "member" : "hinge", row, x, y };
    }

    /** A thin member close by. */
    lineAt(x, y) {
      const { stage, state } = this;
      const { plan, shape } = state.members;
      const shown = PageData.array(state.data.members.shown);
      let best = null, least = REACH;
      for (let m = 0; m < plan.count; m++) {
        if (!shown[m]) continue;
        let before = null;
        for (let s = plan.station[m]; s < plan.station[m + 1]; s++) {
          const place = stage.project(...shape.centre.subarray(3 * s, 3 * s + 3));
          const distance = before ? fromSegment(x, y, before, place) : Infinity;
          if (distance < least) {
            least = distance;
            best = { kind: "member", row: m, x, y };
          }
          before = place;
        }
      }
      return best;
    }
  }

  function fromSegment(x, y, [ax, ay], [bx, by]) {
    const dx = bx - ax, dy = by - ay;
    const square = dx * dx + dy * dy;
    const share = square ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
    return Math.hypot(ax + share * dx - x, ay + share * dy - y);
  }

  return { Pointing };
})();
