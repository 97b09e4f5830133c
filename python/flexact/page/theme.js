// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Light or dark: as the system has it, until somebody switches; or as the host of a part says.

const Theme = (() => {
  const system = window.matchMedia("(prefers-color-scheme: dark)");

  class Theme {
    /** The theme of a page, or of a shadow tree, whose host has it. */
    constructor(root) {
      this.root = root;
      this.owner = root.host || document.documentElement;
    }

    isDark() {
      const chosen = this.owner.dataset.theme;
      return chosen ? chosen === "dark" : system.matches;
    }

    /** Make the switch work; `changed` is called whenever the page gets light or dark. */
    listen(changed, signal) {
      const button = this.root.querySelector("#theme");
      const show = () => {
        if (button) button.setAttribute("aria-pressed", String(this.isDark()));
        changed();
      };
      if (button && !this.root.host) {
        button.hidden = false;
        button.addEventListener("click", () => {
          this.owner.dataset.theme = this.isDark() ? "light" : "dark";
        }, { signal });
      }
      const watched = new MutationObserver(show);
      watched.observe(this.owner, { attributeFilter: ["data-theme"] });
      signal.addEventListener("abort", () => watched.disconnect());
      system.addEventListener("change", show, { signal });
      show();
    }
  }

  return { Theme };
})();
