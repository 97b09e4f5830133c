// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Light or dark: as the system has it, until somebody switches.

const Theme = (() => {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");

  function isDark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : dark.matches;
  }

  /** Make the switch work; `changed` is called whenever the page gets light or dark. */
  function listen(changed) {
    const button = document.getElementById("theme");
    const show = () => {
      button.setAttribute("aria-pressed", String(isDark()));
      changed();
    };
    button.hidden = false;
    button.addEventListener("click", () => {
      document.documentElement.dataset.theme = isDark() ? "light" : "dark";
      show();
    });
    dark.addEventListener("change", show);
    show();
  }

  return { isDark, listen };
})();
