// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts the page: its drawings where there is WebGL, else the still pictures stay. Several are
// seen from the same side, and play in step.

const Main = (() => {
  const MANY = 1000; // members

  function start() {
    const roots = Array.from(document.querySelectorAll(".viewer"));
    const found = roots.map((root) => ({ root, data: PageData.read(root) }))
      .map(({ root, data }) => ({ root, data, context: contextOf(root, data) }));
    const viewers = found.every(({ context }) => context) ? found.map(make) : [];
    if (viewers.length) show(viewers);
    Theme.listen(() => viewers.forEach((viewer) => viewer.dress()));
    Printing.listen(viewers);
    return viewers;
  }

  function contextOf(root, data) {
    // To smooth edges while drawing takes as long again.
    const antialias = data.members.names.length < MANY;
    return root.querySelector(".canvas").getContext("webgl2", { alpha: true, antialias });
  }

  function make({ root, data, context }) {
    root.classList.add("live");
    root.querySelector(".still").hidden = true;
    root.querySelector(".interactive").hidden = root.querySelector(".choices").hidden = false;
    return new Viewer.Viewer(root, data, context);
  }

  function show(viewers) {
    for (const each of document.querySelectorAll(".shared")) each.hidden = false;
    viewers.slice(1).forEach((each) => viewers[0].join(each));
    const toolbar = new Controls.Toolbar(viewers);
    const calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    // What is beside the drawings is linked with the first.
    const nearest = (part) => part.closest(".viewer") || viewers[0].root;
    for (const viewer of viewers) {
      viewer.player.playing = !calm;
      viewer.choices = new Controls.Choices(viewer);
      viewer.changed = () => [viewer.choices, toolbar].forEach((each) => each.refresh());
      link(viewer, (part) => nearest(part) === viewer.root);
    }
    for (const viewer of viewers) {
      viewer.showStress(-1);
      viewer.stage.look("iso");
      for (const [name, value] of viewer.data.first) viewer.choices.choose(name, value);
    }
  }

  /** Let the drawing and the tables light each other. */
  function link(viewer, owns) {
    const links = new Links.Links(owns,
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
    const tip = viewer.part("tip");
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

// For whoever looks at the drawings by hand, and for tests: the first, and all.
window.drawings = Main.start();
window.flexact = window.drawings[0] || null;
