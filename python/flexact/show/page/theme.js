// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Light or dark: as the system has it, until somebody switches.

const Theme = (() => {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");

  /** Where light or dark stands: on the page, or on the host of a tree of its own. */
  const ownerOf = (part) => part.getRootNode().host || document.documentElement;

  function isDark(part) {
    const chosen = ownerOf(part).dataset.theme;
    return chosen ? chosen === "dark" : dark.matches;
  }

  /**
   * Make the switch within the root work, where there is one; `changed` is called whenever the
   * page gets light or dark, until the signal.
   */
  function listen(root, changed, signal) {
    const button = root.querySelector("#theme");
    const show = () => {
      if (button) button.setAttribute("aria-pressed", String(isDark(root)));
      changed();
    };
    if (button && !root.host) {
      button.hidden = false;
      button.addEventListener("click", () => {
        document.documentElement.dataset.theme = isDark(root) ? "light" : "dark";
        show();
      });
    }
    dark.addEventListener("change", show, { signal });
    show();
  }

  return { isDark, listen, ownerOf };
})();
