// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The controls beside the drawing, and the keys of the canvas.

const Controls = (() => {
  const $ = (id) => document.getElementById(id);
  const STEP = Math.PI / 24;

  class Controls {
    constructor(viewer) {
      this.viewer = viewer;
      this.listenToChoices();
      this.listenToPlayer();
      this.listenToView();
      this.listenToKeys($("canvas"));
    }

    choose(name, value) {
      const input = document.querySelector(`input[name="${name}"][value="${value}"]`);
      if (!input) return;
      input.checked = true;
      input.dispatchEvent(new Event("change", { bubbles: true }));
    }

    listenToChoices() {
      const act = {
        movement: (value) => this.viewer.showMovement(value === "" ? -1 : Number(value)),
        stress: (value) => this.viewer.showStress(value === "" ? -1 : Number(value)),
        quantity: (value) => this.viewer.showQuantity(value),
      };
      for (const [name, show] of Object.entries(act)) {
        for (const input of document.querySelectorAll(`input[name="${name}"]`)) {
          input.addEventListener("change", () => show(input.value));
        }
      }
      for (const button of document.querySelectorAll("button[data-show]")) {
        button.addEventListener("click", () => {
          const [name, value] = button.dataset.show.split(" ");
          this.choose(name, value);
          $("drawing").scrollIntoView({ block: "nearest" });
        });
      }
    }

    listenToPlayer() {
      const { viewer } = this;
      $("play").addEventListener("click", () => viewer.play(!viewer.player.playing));
      $("amplitude").addEventListener("input", (event) =>
        viewer.amplify(Number(event.target.value) / 100));
      $("speed").addEventListener("input", (event) => {
        viewer.player.speed = Number(event.target.value);
      });
    }

    listenToView() {
      const { viewer } = this;
      for (const button of document.querySelectorAll("button[data-view]")) {
        button.addEventListener("click", () => viewer.stage.look(button.dataset.view));
      }
      $("fit").addEventListener("click", () => viewer.stage.fit());
      for (const input of document.querySelectorAll("input[data-layer]")) {
        input.addEventListener("change", () => viewer.layer(input.dataset.layer, input.checked));
      }
    }

    listenToKeys(canvas) {
      const { stage } = this.viewer;
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
        " ": () => this.viewer.play(!this.viewer.player.playing),
      };
      canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const shifted = event.shiftKey && event.key.startsWith("Arrow") ? "shift " : "";
        const found = act[shifted + event.key];
        if (!found) return;
        event.preventDefault();
        found();
      });
    }

    /** Fit what can be chosen to what is shown. */
    refresh({ movement, stress, quantities, quantity, bending, playing }) {
      $("play").textContent = movement && playing ? "Pause" : "Play";
      for (const id of ["play", "amplitude", "speed"]) $(id).disabled = !movement;
      for (const input of document.querySelectorAll('input[name="quantity"]')) {
        input.disabled = !stress || !quantities.includes(input.value);
        input.checked = stress && input.value === quantity;
      }
      const diagram = document.querySelector('[data-layer="diagram"]');
      if (diagram) diagram.disabled = !(stress && bending);
    }
  }

  return { Controls };
})();
