// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Keeps a watched page as the file is: hears of each save, and shows the new scene from where the
// old one was seen. While the server is away it asks for it now and then.

const Live = (() => {
  const PATIENCE = 300; // ms before it is said that something is going on
  const LATER = 1000; // ms until an old scene is freed, for which the drawing has to wait
  const AGAIN = 1000; // ms between two attempts to reach the server
  const MOST = 300; // attempts until the page asks no more by itself
  const KEPT = () => `flexact ${location.pathname}`;
  const GONE = "The server has ended: the page stays as it is, and goes on when flexact watch "
    + "is started again.";
  const GIVEN_UP = "The server has ended, and the page looks for it no more.";

  function hexadecimal(bytes) {
    return Array.from(new Uint8Array(bytes), (byte) => byte.toString(16).padStart(2, "0")).join("");
  }

  function chance() {
    return hexadecimal(crypto.getRandomValues(new Uint8Array(16)));
  }

  class Live {
    constructor(root) {
      this.root = root;
      this.bar = this.part("live");
      this.scene = this.part("live-scene");
      this.revision = Number(this.bar.dataset.revision);
      this.start = this.bar.dataset.start;
      this.key = this.bar.dataset.key;
      this.attempts = 0;
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
      const { mount } = typeof Layouts === "object" ? Layouts : Main;
      this.mounted = mount(this.scene, this.mounted);
      window.drawings = this.mounted.viewers;
      window.flexact = this.mounted.viewers[0] || null;
      this.root.dispatchEvent(new CustomEvent("flexact-renewed", { detail: this.mounted }));
    }

    /** The view survives a reload of the page. */
    keep() {
      try {
        const kept = JSON.parse(sessionStorage.getItem(KEPT()));
        if (kept) this.mounted.restore(kept);
      } catch { /* nothing was kept, or nothing may be */ }
      window.addEventListener("pagehide", () => {
        try {
          sessionStorage.setItem(KEPT(), JSON.stringify(this.mounted.view()));
        } catch { /* it may not be kept */ }
      });
    }

    listen() {
      clearTimeout(this.later);
      if (this.line) this.line.close();
      this.line = this.attempt = null;
      if (!document.hidden && this.attempts < MOST) this.reach();
    }

    /** Reach the server. Whoever has its port now is told nothing before it has shown that it is ours,
     * nor is anything that it says believed: see watching/guard.py. */
    async reach() {
      const attempt = this.attempt = {};
      const number = chance();
      let line = null;
      try {
        const first = chance();
        const answer = await fetch(`/alive?start=${this.start}&number=${first}`, { cache: "no-store" });
        const { start, proof } = await answer.json();
        if (proof !== await this.proof("server", first, start)) throw new Error("another server");
        const ours = await this.proof("page", number, start);
        const theirs = await this.proof("events", number, start);
        if (this.attempt !== attempt) return;
        line = this.line = new EventSource(
          `/events?start=${this.start}&number=${number}&proof=${ours}&seen=${this.revision}`);
        let isOurs = false;
        const hear = (kind, act) => line.addEventListener(kind, ({ data }) => {
          if (isOurs) act(JSON.parse(data));
        });
        line.addEventListener("proof", ({ data }) => {
          isOurs = JSON.parse(data).proof === theirs;
          if (isOurs) this.find();
        });
        hear("secrets", (secrets) => this.goOn(secrets));
        hear("scene", (state) => this.show(state));
        hear("work", (state) => this.work(state));
        line.addEventListener("error", () => this.lose(attempt, line));
      } catch {
        this.lose(attempt, line);
      }
    }

    /** What nobody can say of these words, and this port, but the server and its pages. */
    async proof(...words) {
      const bytes = (text) => new TextEncoder().encode(text);
      const how = { name: "HMAC", hash: "SHA-256" };
      const key = await crypto.subtle.importKey("raw", bytes(this.key), how, false, ["sign"]);
      const said = bytes([...words, location.port || "80"].join(" "));
      return hexadecimal(await crypto.subtle.sign("HMAC", key, said));
    }

    /** The server was started anew: its address is another one. */
    goOn({ start, key, token }) {
      Object.assign(this, { start, key });
      history.replaceState(null, "", `/${token}/`);
    }

    find() {
      this.attempts = 0;
      this.bar.classList.remove("lost");
      this.part("live-lost").hidden = true;
      this.part("live-lost").textContent = "";
    }

    lose(attempt, line) {
      if (line) line.close();
      if (this.attempt !== attempt) return;
      this.line = this.attempt = null;
      this.attempts += 1;
      const isGivenUp = this.attempts >= MOST, place = this.part("live-lost");
      if (this.attempts === 1 || isGivenUp) {
        this.bar.classList.add("lost");
        place.hidden = false;
        place.textContent = isGivenUp ? GIVEN_UP : GONE;
        this.work({ work: "", seconds: 0 });
      }
      if (isGivenUp) place.append(" ", this.again());
      else this.later = setTimeout(() => this.listen(), AGAIN);
    }

    again() {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = "Look again";
      button.addEventListener("click", () => {
        this.attempts = 0;
        this.listen();
      });
      return button;
    }

    /** Whether there is a scene that is kept while the file has errors. */
    get hasScene() {
      return this.mounted.shows || this.mounted.viewers.length > 0;
    }

    /** Whether the server is not known to be there, so that nothing is to be sent to its port. */
    get isLost() {
      return this.bar.classList.contains("lost");
    }

    /** A new state of the file; a scene that stays is left alone. */
    show(state) {
      const isSame = state.completes && state.completes === this.revision;
      const fresh = this.revision !== 0 && !isSame;
      this.revision = state.revision;
      document.title = state.title;
      if (isSame && this.complete(state.body)) return;
      if (!state.broken || !this.hasScene) this.renew(state.body);
      this.tell(state);
      this.root.dispatchEvent(new CustomEvent("flexact-told", { detail: state }));
      if (!fresh) return;
      this.bar.classList.remove("fresh");
      void this.bar.offsetWidth; // the light begins anew
      this.bar.classList.add("fresh");
    }

    /** Take the motions of a scene that is otherwise the same, once they were followed; whether
        they are those that are there. */
    complete(body) {
      const made = document.createElement("template");
      made.innerHTML = body;
      const datas = Array.from(made.content.querySelectorAll(".viewer"), PageData.read);
      const { viewers } = this.mounted;
      const titles = ({ movements }) => movements.map(({ title }) => title).join("\n");
      if (viewers.length !== datas.length
        || viewers.some(({ data }, k) => titles(data) !== titles(datas[k]))) return false;
      viewers.forEach((viewer, k) => viewer.take(datas[k].movements));
      return true;
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
      const isKept = broken && this.hasScene;
      this.bar.classList.toggle("errs", Boolean(broken));
      this.bar.classList.toggle("alone", Boolean(broken) && !isKept);
      errors.hidden = !isKept;
      errors.innerHTML = isKept ? broken : "";
      const wrong = typeof Layouts === "object" ? "cannot be read" : "cannot be analysed";
      const words = isKept ? `${wrong}; below is the last good scene` : broken ? wrong : changed;
      this.part("live-words").textContent = saved ? `${saved} ${words || "watching"}` : "";
      this.part("live-which").textContent = which || "";
    }

    /** What is going on, and for how long. */
    work({ work, seconds }) {
      clearInterval(this.ticking);
      clearTimeout(this.soon);
      // Where the processor draws, it has the analysis to do first.
      for (const { stage } of this.mounted.viewers) stage.seldom = stage.software && Boolean(work);
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
