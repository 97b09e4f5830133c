// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// A result in a notebook: an element that holds a still picture and its data, and comes to life
// where it is seen. It stands in the document before or behind the viewer, as the notebook likes.

(() => {
  const MOST = 8; // that are alive at once: of WebGL contexts a browser has some sixteen a page
  const MARGIN = "200px"; // of the window, in which they are woken before they are seen
  const { tag, style } = SETTING;

  const every = new Set(); // in the document
  const alive = new Set(); // the longest alive first

  class Output extends HTMLElement {
    connectedCallback() {
      every.add(this);
      // The parser begins an element before it reads what is in it.
      if (document.readyState !== "loading") this.begin();
      else document.addEventListener("DOMContentLoaded", () => this.begin(), { once: true });
    }

    disconnectedCallback() {
      every.delete(this);
      nearness.unobserve(this);
      this.near = false;
      this.sleep();
    }

    begin() {
      if (!this.isConnected || !this.querySelector("script.flexact-data")) return;
      if (!this.shadowRoot) this.furnish();
      this.dress();
      nearness.observe(this);
    }

    /** A tree of its own, with its own styles; at first it shows the still picture. */
    furnish() {
      const tree = this.attachShadow({ mode: "open" });
      tree.innerHTML = `<style>${style}</style>`
        + '<div class="own"><div class="page"><slot></slot></div></div>';
      this.page = tree.querySelector(".page");
      this.addEventListener("pointerenter", () => this.wake());
      tree.addEventListener("keydown", keep);
      tree.addEventListener("click", (event) => this.follow(event));
    }

    /** Light or dark, as the notebook is. */
    dress() {
      const theme = themeAround(this);
      if (this.dataset.theme !== theme) this.dataset.theme = theme;
    }

    async wake() {
      if (this.mounted || this.waking) return;
      this.waking = true;
      try {
        this.body = this.body || await Packed.text(this.querySelector("script.flexact-data"));
      } finally {
        this.waking = false;
      }
      if (!this.near || !this.isConnected || this.mounted) return;
      const [oldest] = alive;
      if (alive.size >= MOST) oldest.sleep();
      this.page.classList.remove("asleep");
      this.page.innerHTML = this.body;
      this.openAgain();
      this.mounted = Main.mount(this.shadowRoot);
      alive.add(this);
      if (this.view) this.restore();
      this.mounted.viewers.forEach(Main.scrollPast);
      if (!this.mounted.viewers.length) this.stand();
    }

    /** Leave a still picture of what is seen, and give the context back. */
    sleep() {
      if (!this.mounted) return;
      alive.delete(this);
      this.opened = Array.from(this.page.querySelectorAll("details"), ({ open }) => open);
      if (this.mounted.viewers.length) {
        this.view = this.mounted.view();
        this.cycles = this.mounted.viewers.map(({ player }) => player.cycle);
        this.mounted.viewers.forEach(Printing.draw);
        this.page.classList.add("asleep");
      }
      this.mounted.dispose();
      this.mounted = null;
    }

    /** What somebody has chosen; the notebook stays where it is. */
    restore() {
      this.mounted.restore({ ...this.view, scroll: [window.scrollX, window.scrollY] });
      this.mounted.viewers.forEach((viewer, k) => {
        viewer.player.cycle = this.cycles[k];
        viewer.movePhase(viewer.player.phase);
      });
    }

    openAgain() {
      const all = this.page.querySelectorAll("details");
      (this.opened || []).forEach((open, k) => { all[k].open = open; });
    }

    /** Without WebGL the still picture is the drawing. */
    stand() {
      const still = this.page.querySelector(".still"), picture = this.querySelector("img");
      if (still && picture) still.prepend(picture.cloneNode());
    }

    /** A link to a place of this result: no address of the notebook is meant. */
    follow(event) {
      const link = event.target.closest("a[href^='#']");
      if (!link) return;
      event.preventDefault();
      const place = this.shadowRoot.getElementById(link.getAttribute("href").slice(1));
      if (!place) return;
      for (const each of [...this.page.querySelectorAll("details")]) {
        each.open = each.open || each.contains(place);
      }
      place.scrollIntoView({ block: "nearest" });
    }
  }

  /** The notebook takes no key that the drawing or a slider takes. */
  function keep(event) {
    if (isOurs(event) && event.target.matches("canvas, input")) event.stopPropagation();
  }

  const isOurs = (event) => !(event.ctrlKey || event.metaKey || event.altKey);

  // JupyterLab listens before all others; it leaves keys to whom this attribute is on.
  window.addEventListener("keydown", (event) => {
    if (every.has(event.target)) {
      event.target.toggleAttribute("data-lm-suppress-shortcuts", isOurs(event));
    }
  }, true);

  const nearness = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      target.near = isIntersecting;
      if (isIntersecting) target.wake();
      else target.sleep();
    }
  }, { rootMargin: MARGIN });

  /** As JupyterLab, VS Code and exported pages tell it; else as the ground is. */
  function themeAround(element) {
    const { jpThemeLight, vscodeThemeKind } = document.body.dataset;
    if (jpThemeLight) return jpThemeLight === "false" ? "dark" : "light";
    if (vscodeThemeKind) {
      return /dark|high-contrast$/.test(vscodeThemeKind) ? "dark" : "light";
    }
    for (let each = element.parentElement; each; each = each.parentElement) {
      const [red, green, blue, alpha = 1] = getComputedStyle(each).backgroundColor
        .match(/[\d.]+/g).map(Number);
      if (alpha > 0.5) return 0.3 * red + 0.6 * green + 0.1 * blue < 110 ? "dark" : "light";
    }
    return "light";
  }

  const dress = new MutationObserver(() => every.forEach((each) => each.dress()));
  const attributeFilter = ["class", "style", "data-jp-theme-light", "data-vscode-theme-kind",
    "data-theme", "data-md-color-scheme"];
  for (const each of [document.documentElement, document.body]) {
    dress.observe(each, { attributeFilter });
  }

  customElements.define(tag, Output);
})();
