// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Keeps a watched page as the file is: hears of each save, and shows the new scene from where the
// old one was seen. While the server is away it asks for it now and then.

const Live = (() => {
  const PATIENCE = 300; // ms before it is said that something is going on
  const LATER = 1000; // ms until an old scene is freed, for which the drawing has to wait
  const AGAIN = 1000; // ms between two attempts to reach the server
  const KEPT = `flexact ${location.pathname}`;
  const GONE = "The server has ended: the page stays as it is, and goes on when flexact watch "
    + "is started again.";

  class Live {
    constructor(root) {
      this.root = root;
      this.bar = this.part("live");
      this.scene = this.part("live-scene");
      this.revision = Number(this.bar.dataset.revision);
      const { changed, which } = this.part("live-now").dataset;
      this.mount();
      this.keep();
      this.tell({
        changed_words: changed, which, saved: this.bar.dataset.saved,
        broken: this.part("live-broken").innerHTML,
      });
      // Browsers keep few lines to a server, and none is wasted on what nobody sees.
      document.addEventListener("visibilitychange", () => this.listen());
      this.listen();
    }

    part(name) {
      return this.root.querySelector(`.${name}`);
    }

    mount() {
      this.mounted = Main.mount(this.scene);
      window.drawings = this.mounted.viewers;
      window.flexact = this.mounted.viewers[0] || null;
      this.root.dispatchEvent(new CustomEvent("flexact-renewed", { detail: this.mounted }));
    }

    /** The view survives a reload of the page. */
    keep() {
      try {
        const kept = JSON.parse(sessionStorage.getItem(KEPT));
        if (kept) this.mounted.restore(kept);
      } catch { /* nothing was kept, or nothing may be */ }
      window.addEventListener("pagehide", () => {
        try {
          sessionStorage.setItem(KEPT, JSON.stringify(this.mounted.view()));
        } catch { /* it may not be kept */ }
      });
    }

    listen() {
      clearTimeout(this.later);
      if (this.line) this.line.close();
      this.line = null;
      if (document.hidden) return;
      const line = this.line = new EventSource(`events?seen=${this.revision}`);
      line.addEventListener("open", () => this.lose(false));
      line.addEventListener("scene", ({ data }) => this.show(JSON.parse(data)));
      line.addEventListener("work", ({ data }) => this.work(JSON.parse(data)));
      line.addEventListener("error", () => {
        line.close();
        this.lose(true);
        this.later = setTimeout(() => this.listen(), AGAIN);
      });
    }

    lose(on) {
      this.bar.classList.toggle("lost", on);
      this.part("live-lost").hidden = !on;
      this.part("live-lost").textContent = on ? GONE : "";
      if (on) this.work({ work: "", seconds: 0 });
    }

    /** A new state of the file; a scene that stays is left alone. */
    show(state) {
      const fresh = this.revision !== 0;
      this.revision = state.revision;
      document.title = state.title;
      if (!state.broken || !this.mounted.viewers.length) this.renew(state.body);
      this.tell(state);
      if (!fresh) return;
      this.bar.classList.remove("fresh");
      void this.bar.offsetWidth; // the light begins anew
      this.bar.classList.add("fresh");
    }

    /** Put a new scene in the place of the old one, which is freed when nobody waits for it. */
    renew(body) {
      const old = this.mounted, view = old.view();
      for (const { player } of old.viewers) player.playing = false;
      const scene = document.createElement("div");
      scene.className = "live-scene";
      scene.innerHTML = body;
      this.scene.replaceWith(scene);
      this.scene = scene;
      this.mount();
      this.mounted.restore(view);
      setTimeout(() => old.dispose(), LATER);
    }

    tell({ changed_words: changed, which, saved, broken }) {
      const errors = this.part("live-errors");
      const isKept = broken && this.mounted.viewers.length > 0;
      this.bar.classList.toggle("errs", Boolean(broken));
      this.bar.classList.toggle("alone", Boolean(broken) && !isKept);
      errors.hidden = !isKept;
      errors.innerHTML = isKept ? broken : "";
      const words = isKept ? "cannot be analysed; below is the last good scene"
        : broken ? "cannot be analysed" : changed;
      this.part("live-words").textContent = saved ? `${saved} ${words || "watching"}` : "";
      this.part("live-which").textContent = which || "";
    }

    /** What is going on, and for how long. */
    work({ work, seconds }) {
      clearInterval(this.ticking);
      clearTimeout(this.soon);
      const place = this.part("live-work");
      place.hidden = true;
      if (!work) return;
      const began = performance.now() - 1000 * seconds;
      const say = () => {
        const past = Math.floor((performance.now() - began) / 1000);
        place.hidden = false;
        place.textContent = `${work}${past ? ` (${past} s)` : ""} ...`;
      };
      this.soon = setTimeout(() => {
        say();
        this.ticking = setInterval(say, 1000);
      }, PATIENCE);
    }
  }

  return { Live };
})();

window.live = new Live.Live(document.body);
