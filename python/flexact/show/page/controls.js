// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The controls: what a viewer shows, and what plays and looks in all viewers of the page.

const Controls = (() => {
  const STEP = Math.PI / 24;

  /** What one viewer shows. */
  class Choices {
    constructor(viewer) {
      Object.assign(this, { viewer, root: viewer.root });
      this.picked = new Map(); // what a person has chosen, by its words
      const act = {
        movement: (value) => viewer.showMovement(value === "" ? -1 : Number(value)),
        stress: (value) => viewer.showStress(value === "" ? -1 : Number(value)),
        quantity: (value) => viewer.showQuantity(value),
        space: (value) => viewer.showSpace(value === "" ? -1 : Number(value)),
      };
      for (const [name, show] of Object.entries(act)) {
        for (const input of this.inputs(name)) {
          input.addEventListener("change", () => {
            this.picked.set(name, this.words(input));
            show(input.value);
          });
        }
      }
      this.error = this.root.querySelector(".misaligned input");
      if (this.error) {
        this.error.addEventListener("input", ({ target }) => {
          const size = Number(target.value);
          // It has colours of its own.
          if (viewer.stress) this.choose("stress", "");
          viewer.misalign(size);
        });
      }
      for (const button of this.root.querySelectorAll("button[data-show]")) {
        button.addEventListener("click", () => {
          const [name, value] = button.dataset.show.split(" ");
          this.choose(name, value);
          viewer.part("drawing").scrollIntoView({ block: "nearest" });
        });
      }
    }

    inputs(name) {
      return Array.from(this.root.querySelectorAll(`input[data-choice="${name}"]`));
    }

    choose(name, value) {
      const input = this.inputs(name).find((each) => each.value === value);
      if (!input) return;
      input.checked = true;
      input.dispatchEvent(new Event("change", { bubbles: true }));
    }

    words(input) {
      return input.title || input.parentElement.textContent;
    }

    /** Choose again what has the same words. */
    restore(picked) {
      for (const [name, words] of Object.entries(picked)) {
        const input = this.inputs(name).find((each) => this.words(each) === words);
        if (input) this.choose(name, input.value);
      }
    }

    /** Fit what can be chosen to what is shown. */
    refresh() {
      const { stress, quantity, quantities } = this.viewer;
      for (const input of this.inputs("quantity")) {
        input.disabled = !stress || !quantities.includes(input.value);
        input.checked = Boolean(stress) && input.value === quantity;
      }
      if (this.error) this.tellError();
    }

    /** What the misalignment does, in words. */
    tellError() {
      const { error, misaligned: { measure, rest, peak, used }, data } = this.viewer;
      const { unit, name, hertz } = data.misaligned;
      const size = unit === "rad" ? `${Words.number(1e3 * error)} mrad` : `${Words.number(1e6 * error)} \u00b5m`;
      const part = `${Math.round((100 * measure) / rest)} %`;
      const falls = hertz ? `${Words.number(measure)} Hz (${part})` : part;
      const share = used === null ? "" : `, ${Words.number(100 * used)} % of the strength`;
      this.error.value = error;
      this.error.nextElementSibling.textContent =
        `${size}: ${name} ${measure > 1e-6 * rest ? falls : "0: it buckles"}, up to ${Words.number(peak)} MPa${share}`;
    }
  }

  /** What acts on all viewers: what plays, from where it is seen, what else is drawn; keys. */
  class Toolbar {
    constructor(viewers, root) {
      Object.assign(this, { viewers, root });
      for (const name of ["play", "amplitude", "speed", "fit", "centre"]) {
        this[name] = root.querySelector(`.toolbar .${name}`);
      }
      this.layers = Array.from(root.querySelectorAll("input[data-layer]"));
      for (const { dataset, checked } of this.layers) {
        for (const viewer of viewers) viewer.layers[dataset.layer] = checked;
      }
      this.listenToPlayer();
      this.listenToView();
      for (const viewer of viewers) this.listenToKeys(viewer);
    }

    /** What has been set, as plain data. */
    view() {
      const layers = this.layers.map(({ dataset, checked }) => [dataset.layer, checked]);
      const { amplitude, speed } = this;
      const values = { amplitude: amplitude.value, speed: speed.value };
      const cycle = this.viewers[0].player.cycle;
      const playing = this.viewers[0].player.playing;
      return { layers: Object.fromEntries(layers), ...values, playing, cycle };
    }

    /** Set it again. */
    restore({ layers, amplitude, speed, playing, cycle }) {
      for (const input of this.layers) {
        const on = layers[input.dataset.layer];
        if (on === undefined || on === input.checked) continue;
        input.checked = on;
        input.dispatchEvent(new Event("change", { bubbles: true }));
      }
      for (const [input, value] of [[this.amplitude, amplitude], [this.speed, speed]]) {
        input.value = value;
        input.dispatchEvent(new Event("input", { bubbles: true }));
      }
      for (const viewer of this.viewers) {
        viewer.player.cycle = cycle;
        viewer.play(playing);
      }
    }

    get playing() {
      return this.viewers.some(({ movement, player }) => movement && player.playing);
    }

    playOrPause() {
      const on = !this.playing;
      for (const viewer of this.viewers) viewer.play(on);
    }

    listenToPlayer() {
      const { viewers } = this;
      this.play.addEventListener("click", () => this.playOrPause());
      this.amplitude.addEventListener("input", ({ target }) => {
        for (const viewer of viewers) viewer.amplify(Number(target.value) / 100);
      });
      this.speed.addEventListener("input", ({ target }) => {
        for (const { player } of viewers) player.speed = Number(target.value);
      });
    }

    listenToView() {
      const { viewers } = this;
      // The others are seen from the same side; of cards there may be none for a while.
      const first = (act) => viewers.slice(0, 1).forEach(({ stage }) => act(stage));
      for (const button of this.root.querySelectorAll("button[data-view]")) {
        button.addEventListener("click", () => first((stage) => stage.look(button.dataset.view)));
      }
      this.fit.addEventListener("click", () => first((stage) => stage.fit()));
      this.centre.addEventListener("click", () => this.bringHeld());
      for (const input of this.layers) {
        input.addEventListener("change", () => {
          for (const viewer of viewers) viewer.layer(input.dataset.layer, input.checked);
        });
      }
    }

    /** Bring what was clicked into the middle. */
    bringHeld() {
      const holding = this.viewers.find(({ held }) => held);
      if (holding) holding.visit();
    }

    listenToKeys({ stage }) {
      const act = {
        ArrowLeft: () => stage.turn(STEP, 0),
        ArrowRight: () => stage.turn(-STEP, 0),
        ArrowUp: () => stage.turn(0, STEP),
        ArrowDown: () => stage.turn(0, -STEP),
        "shift ArrowLeft": () => stage.shift(-0.06, 0),
        "shift ArrowRight": () => stage.shift(0.06, 0),
        "shift ArrowUp": () => stage.shift(0, 0.06),
        "shift ArrowDown": () => stage.shift(0, -0.06),
        "+": () => stage.zoom(1.2),
        "=": () => stage.zoom(1.2),
        "-": () => stage.zoom(1 / 1.2),
        "0": () => stage.look("iso"),
        " ": () => this.playOrPause(),
        c: () => this.bringHeld(),
        C: () => this.bringHeld(),
      };
      stage.canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const shifted = event.shiftKey && event.key.startsWith("Arrow") ? "shift " : "";
        const found = act[shifted + event.key];
        if (!found) return;
        event.preventDefault();
        found();
      }, { signal: stage.ending.signal });
    }

    /** Fit what can be pressed to what is shown. */
    refresh() {
      const moves = this.viewers.some(({ movement }) => movement);
      this.centre.disabled = !this.viewers.some(({ held }) => held);
      this.play.textContent = this.playing ? "Pause" : "Play";
      for (const each of [this.play, this.amplitude, this.speed]) each.disabled = !moves;
      const diagram = this.layers.find(({ dataset }) => dataset.layer === "diagram");
      if (!diagram) return;
      diagram.disabled = !this.viewers.some(
        ({ stress, quantity, data }) => stress && quantity in data.bending);
    }
  }

  return { Choices, Toolbar };
})();
