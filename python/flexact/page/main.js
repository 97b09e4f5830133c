// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts the page: the drawing where there is WebGL, else the still picture stays.

const Main = (() => {
  const $ = (id) => document.getElementById(id);
  const MANY = 1000; // members

  function start() {
    const data = PageData.read("drawing-data");
    // To smooth edges while drawing takes as long again.
    const antialias = data.members.names.length < MANY;
    const context = $("canvas").getContext("webgl2", { alpha: true, antialias });
    const viewer = context ? show(data, context) : null;
    Theme.listen(() => viewer && viewer.dress());
    Printing.listen(viewer);
    return viewer;
  }

  function show(data, context) {
    $("still").hidden = true;
    $("live").hidden = $("choices").hidden = false;
    document.body.classList.add("live");
    const viewer = new Viewer.Viewer(data, context);
    viewer.controls = new Controls.Controls(viewer);
    link(viewer);
    const calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    viewer.player.playing = !calm;
    viewer.showStress(-1);
    // What the verdict says: a motion, else a self-stress, else a degree of freedom.
    const stressed = data.stresses.length > 0 && !data.motions;
    if (stressed) viewer.controls.choose("stress", "0");
    else if (data.movements.length) viewer.controls.choose("movement", "0");
    return viewer;
  }

  /** Let the drawing and the tables light each other. */
  function link(viewer) {
    const links = new Links.Links(
      (target) => viewer.mark(target), (target) => viewer.visit(target));
    viewer.pointing = new Pointing.Pointing(viewer.stage, viewer, (found) => {
      const target = found ? viewer.targetOf(found) : null;
      viewer.mark(target || {});
      links.light(target);
      tell(viewer, found);
    });
  }

  /** Words beside the pointer. */
  function tell(viewer, found) {
    const tip = $("tip");
    tip.hidden = !found;
    if (!found) return;
    const [head, ...lines] = viewer.describe(found);
    tip.replaceChildren(element("b", head), ...lines.map((line) => element("div", line)));
    const { width, height } = viewer.stage;
    const left = Math.min(found.x + 14, width - tip.offsetWidth - 4);
    const top = found.y + 18 + tip.offsetHeight > height ? found.y - tip.offsetHeight - 10
      : found.y + 18;
    tip.style.left = `${Math.max(4, left)}px`;
    tip.style.top = `${Math.max(4, top)}px`;
  }

  function element(kind, text) {
    const made = document.createElement(kind);
    made.textContent = text;
    return made;
  }

  return { start };
})();

// For whoever looks at the drawing by hand, and for tests.
window.flexact = Main.start();
