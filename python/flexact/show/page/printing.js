// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// On paper: a still of the drawing in place of the canvas, in the colours of the light page,
// and every table open.

const Printing = (() => {
  const RATIO = 2; // pixels of the still for one of the canvas

  /** Until the signal, where there is one. */
  function listen(root, viewers, signal) {
    const { dataset } = Theme.ownerOf(root);
    let closed = [];
    let theme = null;
    window.addEventListener("beforeprint", () => {
      theme = dataset.theme;
      dataset.theme = "light";
      closed = Array.from(root.querySelectorAll("details:not([open])"));
      for (const each of closed) each.open = true;
      for (const each of viewers) draw(each);
    }, { signal });
    window.addEventListener("afterprint", () => {
      for (const each of closed) each.open = false;
      if (theme) dataset.theme = theme;
      else delete dataset.theme;
      for (const each of viewers) each.dress();
    }, { signal });
  }

  /** Leave a still of what is seen. */
  function draw(viewer) {
    const still = viewer.part("on-paper");
    const { stage } = viewer;
    const { renderer } = stage;
    const ratio = renderer.getPixelRatio();
    viewer.dress();
    renderer.setPixelRatio(RATIO);
    stage.draw();
    still.width = stage.width * RATIO;
    still.height = (stage.height + stage.foot) * RATIO;
    const context = still.getContext("2d");
    context.drawImage(stage.canvas, 0, 0, still.width, stage.height * RATIO);
    context.drawImage(viewer.overlay.canvas, 0, 0, still.width, still.height);
    renderer.setPixelRatio(ratio);
    stage.draw();
  }

  return { listen, draw };
})();
