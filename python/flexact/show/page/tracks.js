// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Where everything is in a movement, at any phase of its cycle from -1 to 1: places of nodes and
// stations, cross-sections there as quaternions (w, x, y, z), axes of hinges. And what plays it.

const Tracks = (() => {
  /** A state that is the reference: arrays by what they are of. */
  function reference(data) {
    const made = {};
    for (const [name, packed] of Object.entries(data.reference)) {
      made[name] = PageData.array(packed).slice();
    }
    return made;
  }

  /** Write a movement at a phase into `state`, of which all that does not move stays. */
  function move(state, data, movement, phase) {
    const last = movement.phases - 1;
    const place = Math.max(0, Math.min(last, ((phase + 1) / 2) * last));
    const before = Math.min(Math.floor(place), last - 1);
    const share = place - before;
    for (const [name, { rows, unit, change }] of Object.entries(movement.tracks)) {
      const moved = PageData.array(rows), values = PageData.array(change);
      const still = PageData.array(data.reference[name]), now = state[name];
      const width = name === "section" ? 4 : 3, size = width * moved.length;
      for (let i = 0, at = before * size; i < moved.length; i++) {
        for (let k = width * moved[i]; k < width * (moved[i] + 1); k++, at++) {
          now[k] = still[k] + unit * ((1 - share) * values[at] + share * values[at + size]);
        }
      }
    }
  }

  const START = 0.75; // of a cycle: in the reference, on the way to the largest displacement

  class Player {
    /** `show(phase)` is called with a phase from -1 to 1 whenever it changes. */
    constructor(show) {
      this.show = show;
      this.amplitude = 1;
      this.speed = 0.5; // cycles a second
      this.playing = false;
      this.cycle = START;
      this.last = null; // when the last step was [ms]
    }

    get phase() {
      return this.amplitude * Math.cos(2 * Math.PI * this.cycle);
    }

    /** Begin in the reference; where nothing plays, stand as far out as before. */
    begin() {
      if (this.playing) this.cycle = START;
      this.last = null;
      this.show(this.phase);
    }

    /** Go on to a time [ms]; whether there will be more. */
    step(time) {
      if (!this.playing) {
        this.last = null;
        return false;
      }
      // After a pause, or in the background, it goes on from where it was.
      const passed = this.last === null ? 0 : Math.min(time - this.last, 100);
      this.last = time;
      this.cycle = (this.cycle + (this.speed * passed) / 1000) % 1;
      this.show(this.phase);
      return true;
    }
  }

  return { reference, move, Player };
})();
