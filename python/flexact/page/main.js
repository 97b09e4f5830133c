// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Brings a page, or a part of one, to life: its drawings where there is WebGL, else the still
// pictures stay. Several are seen from the same side, and play in step.

const Main = (() => {
  const MANY = 1000; // members

  /**
   * Bring to life what is within an element or a shadow root.
   *
   * `view()` tells what somebody has chosen as plain values, which `restore` takes again;
   * `dispose()` gives everything back, and leaves the page as it looks.
   */
  function mount(root) {
    const roots = Array.from(root.querySelectorAll(".viewer"));
    const ending = new AbortController(), theme = new Theme.Theme(root);
    const found = roots.map((root) => ({ root, data: PageData.read(root) }))
      .map(({ root, data }) => ({ root, data, context: contextOf(root, data) }));
    const viewers = found.every(({ context }) => context) ? found.map((each) => make(each, theme)) : [];
    const toolbar = viewers.length ? show(root, viewers) : null;
    theme.listen(() => viewers.forEach((viewer) => viewer.dress()), ending.signal);
    Printing.listen(root, theme, viewers, ending.signal);
    return {
      viewers,
      view: () => ({ viewers: viewers.map((each) => each.view()), ...(toolbar && toolbar.view()) }),
      restore(view) {
        if (toolbar) toolbar.restore(view);
        viewers.forEach((each, k) => view.viewers[k] && each.restore(view.viewers[k]));
      },
      dispose() {
        ending.abort();
        for (const each of viewers) each.dispose();
      },
    };
  }

  function contextOf(root, data) {
    // To smooth edges while drawing takes as long again.
    const antialias = data.members.names.length < MANY;
    return root.querySelector(".canvas").getContext("webgl2", { alpha: true, antialias });
  }

  function make({ root, data, context }, theme) {
    root.classList.add("live");
    root.querySelector(".still").hidden = true;
    root.querySelector(".interactive").hidden = root.querySelector(".choices").hidden = false;
    return new Viewer.Viewer(root, data, context, theme);
  }

  function show(root, viewers) {
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
      link(root, viewer, (part) => nearest(part) === viewer.root);
    }
    for (const viewer of viewers) {
      viewer.showStress(-1);
      viewer.stage.look("iso");
      for (const [name, value] of viewer.data.first) viewer.choices.choose(name, value);
    }
    return toolbar;
  }

  /** Let the drawing and the tables light each other. */
  function link(root, viewer, owns) {
    const links = new Links.Links(root, owns,
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

  return { mount };
})();
