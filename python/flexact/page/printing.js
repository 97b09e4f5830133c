// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// On paper: a still of the drawing in place of the canvas, in the colours of the light page,
// and every table open.

const Printing = (() => {
  const RATIO = 2; // pixels of the still for one of the canvas

  function listen(root, theme, viewers, signal) {
    const { dataset } = theme.owner;
    let closed = [];
    let before = null;
    window.addEventListener("beforeprint", () => {
      before = dataset.theme;
      dataset.theme = "light";
      closed = Array.from(root.querySelectorAll("details:not([open])"));
      for (const each of closed) each.open = true;
      for (const each of viewers) draw(each);
    }, { signal });
    window.addEventListener("afterprint", () => {
      for (const each of closed) each.open = false;
      if (before) dataset.theme = before;
      else delete dataset.theme;
      for (const each of viewers) each.dress();
    }, { signal });
  }

  /** A still of the drawing as it is now. */
  function draw(viewer, ratioOfStill = RATIO) {
    const still = viewer.part("on-paper");
    const { stage } = viewer;
    const { renderer } = stage;
    const ratio = renderer.getPixelRatio();
    viewer.dress();
    renderer.setPixelRatio(ratioOfStill);
    stage.draw();
    still.width = stage.width * ratioOfStill;
    still.height = stage.height * ratioOfStill;
    const context = still.getContext("2d");
    context.drawImage(stage.canvas, 0, 0, still.width, still.height);
    context.drawImage(viewer.overlay.canvas, 0, 0, still.width, still.height);
    renderer.setPixelRatio(ratio);
    stage.draw();
  }

  return { listen, draw };
})();
