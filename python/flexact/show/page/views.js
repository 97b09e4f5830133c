// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// What a person has chosen, as plain data that another scene takes again: from where it is seen,
// what is shown, what else is drawn, what plays, what is open, how far it is scrolled.

const Views = (() => {
  /** `view()` and `restore(view)` of the viewers of a root. */
  function of(root, viewers, toolbar) {
    const details = () => Array.from(root.querySelectorAll("details"));
    const key = (each) => each.id || each.querySelector("summary")?.textContent || "";
    return {
      view: () => ({
        looks: viewers.length ? viewers[0].stage.looks() : null,
        picked: viewers.map(({ choices }) => Object.fromEntries(choices.picked)),
        toolbar: toolbar ? toolbar.view() : null,
        open: details().filter(({ open }) => open).map(key),
        scroll: [window.scrollX, window.scrollY],
      }),
      restore: (view) => {
        if (toolbar && view.toolbar) toolbar.restore(view.toolbar);
        viewers.forEach(({ choices }, k) => choices.restore((view.picked || [])[k] || {}));
        if (viewers.length && view.looks) viewers[0].stage.lookAgain(view.looks);
        for (const each of details()) each.open = each.open || view.open.includes(key(each));
        window.scrollTo(...view.scroll);
      },
    };
  }

  return { of };
})();
