"use strict";
// Plays a movement as a full cosine cycle.

const Player = (() => {
  const START = 0.75; // of a cycle: in the reference, on the way to the largest displacement

  class Player {
    /** `show(phase)` is called with a phase from -1 to 1 whenever it changes. */
    constructor(show) {
      this.show = show;
      this.amplitude = 1;
      this.speed = 0.5; // cycles a second
      this.playing = false;
      this.cycle = 0;
    }

    get phase() {
      return this.amplitude * Math.cos(2 * Math.PI * this.cycle);
    }

    /** Begin in the reference; stand at the largest displacement where nothing is to move. */
    begin() {
      this.cycle = this.playing ? START : 0;
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

  return { Player };
})();
