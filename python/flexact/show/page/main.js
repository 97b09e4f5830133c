// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts what a root holds, the body of a page or any other element or shadow root: its drawings
// where there is WebGL, else the still pictures stay. Several drawings of a root are seen from the
// same side, and play in step.

const Main = (() => {
  const MANY = 1000; // members

  /**
   * Start the drawings of a root. What it returns: its `viewers`; `view()`, what a person has
   * chosen, as plain data; `restore(view)`, which chooses it again in another scene as far as
   * it is there; `dispose()`, which frees what the drawings hold. Where a scene takes the place of
   * one that was mounted before, it draws on its canvases.
   */
  function mount(root, before = null) {
    const ending = new AbortController();
    const found = Array.from(root.querySelectorAll(".viewer"))
      .map((each, k) => opened(each, before && before.viewers[k]));
    const viewers = found.every(({ context }) => context) ? found.map(make) : [];
    const toolbar = viewers.length ? show(root, viewers, ending.signal) : null;
    Theme.listen(root, () => viewers.forEach((viewer) => viewer.dress()), ending.signal);
    Printing.listen(root, viewers, ending.signal);
    Terms.explain(root, ending.signal);
    const dispose = () => {
      ending.abort();
      for (const { stage } of viewers) stage.dispose();
    };
    return { viewers, dispose, ...Views.of(root, viewers, toolbar) };
  }

  /** A drawing that is about to start: its data, and its context, if there can be one. */
  function opened(root, before = null) {
    const data = PageData.read(root), own = root.querySelector(".canvas");
    // To smooth edges while drawing takes as long again.
    const antialias = data.members.names.length < MANY;
    if (!before || !before.stage.canLeave(antialias)) {
      return { root, data, context: own.getContext("webgl2", { alpha: true, antialias }) };
    }
    const { stage } = before, { canvas } = stage;
    stage.leave();
    for (const { name, value } of own.attributes) canvas.setAttribute(name, value);
    own.replaceWith(canvas);
    return { root, data, context: stage.renderer.getContext(), stage };
  }

  function make({ root, data, context, stage }) {
    root.classList.add("live");
    root.querySelector(".still").hidden = true;
    root.querySelector(".interactive").hidden = root.querySelector(".choices").hidden = false;
    return new Viewer.Viewer(root, data, context, stage);
  }

  function show(root, viewers, signal) {
    for (const each of root.querySelectorAll(".shared")) each.hidden = false;
    viewers.slice(1).forEach((each) => viewers[0].join(each));
    const toolbar = new Controls.Toolbar(viewers, root);
    const calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    // What is beside the drawings is linked with the first.
    const nearest = (part) => part.closest(".viewer") || viewers[0].root;
    for (const viewer of viewers) {
      viewer.player.playing = !calm;
      viewer.choices = new Controls.Choices(viewer);
      viewer.changed = () => [viewer.choices, toolbar].forEach((each) => each.refresh());
      link(root, viewer, (part) => nearest(part) === viewer.root, signal);
    }
    for (const viewer of viewers) {
      viewer.showStress(-1);
      viewer.stage.look("iso");
      for (const [name, value] of viewer.data.first) viewer.choices.choose(name, value);
      viewer.choices.picked.clear();
    }
    return toolbar;
  }

  /** Let the drawing and the tables light each other. */
  function link(root, viewer, owns, signal) {
    const links = new Links.Links(root, owns,
      (target) => viewer.mark(target), (target) => hold(target), (target) => viewer.visit(target));
    const hold = (target) => {
      viewer.hold(target);
      links.hold(target);
    };
    root.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      hold(null);
      viewer.pointing.clear();
    }, { signal });
    viewer.pointing = new Pointing.Pointing(viewer.stage, viewer, (found) => {
      const target = found ? viewer.targetOf(found) : null;
      viewer.mark(target || {});
      links.light(target);
      tell(viewer, found);
    });
    viewer.pointing.clicked = (found) => {
      const target = found ? { ...viewer.targetOf(found), kind: found.kind } : {};
      const told = { detail: target, bubbles: true, composed: true };
      hold(found ? viewer.targetOf(found) : null);
      viewer.root.dispatchEvent(new CustomEvent("flexact-click", told));
    };
    viewer.pointing.doubled = (found) => found && viewer.visit(viewer.targetOf(found));
  }

  /** The wheel scrolls past a drawing, until somebody has clicked on the drawing. */
  function scrollPast({ stage: { canvas, controls } }) {
    controls.enableZoom = false;
    canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
    canvas.addEventListener("focus", () => { controls.enableZoom = true; });
    canvas.addEventListener("blur", () => { controls.enableZoom = false; });
    // Two fingers zoom at once.
    canvas.addEventListener("pointerdown", ({ pointerType }) => {
      if (pointerType === "touch") controls.enableZoom = true;
    }, true);
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

  return { mount, opened, make, link, scrollPast };
})();
