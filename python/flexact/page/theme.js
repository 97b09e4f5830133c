// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Light or dark: as the system has it, until somebody switches.

const Theme = (() => {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");

  function isDark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : dark.matches;
  }

  /**
   * Make the switch within the root work, where there is one; `changed` is called whenever the
   * page gets light or dark, until the signal.
   */
  function listen(root, changed, signal) {
    const button = root.querySelector("#theme");
    const show = () => {
      if (button) button.setAttribute("aria-pressed", String(isDark()));
      changed();
    };
    if (button) {
      button.hidden = false;
      button.addEventListener("click", () => {
        document.documentElement.dataset.theme = isDark() ? "light" : "dark";
        show();
      });
    }
    dark.addEventListener("change", show, { signal });
    show();
  }

  return { isDark, listen };
})();
