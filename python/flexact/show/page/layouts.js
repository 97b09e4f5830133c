// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Cards of layouts. The drawings that are in sight are alive, are seen from the same side and play
// in step; the others leave a still. A card opens the whole page of its deck in the place of all.

const Layouts = (() => {
  const MOST = 8; // that are alive at once: of WebGL contexts a browser has some sixteen a page
  const MARGIN = "150px"; // of the window, in which drawings are woken before they are seen
  const LIT = 1600; // ms for which the card that somebody went to is lit

  /** Start the cards of a root, and take over drawings of cards that were there before; a root
   * without cards is as any other. What it returns is as of Main.mount. */
  function mount(root, before = null) {
    if (!root.querySelector("main.layouts")) return Main.mount(root);
    return new Cards(root, before instanceof Cards ? before : null);
  }

  class Cards {
    constructor(root, before) {
      this.root = root;
      this.ending = new AbortController();
      this.main = root.querySelector("main.layouts");
      this.one = root.querySelector(".one");
      this.cards = Array.from(root.querySelectorAll(".card.layout"));
      this.viewers = []; // of the cards that are alive, the longest first
      this.alive = new Map(); // by their cards
      this.fresh = new Map(); // drawings as they were before they were alive
      this.plays = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
      this.spaces = Array.from(this.main.querySelectorAll("input[data-space]"));
      this.toolbar = new Controls.Toolbar(this.viewers, this.main);
      this.begin(before);
    }

    /** Whether there is something to be seen. */
    get shows() {
      return true;
    }

    begin(before) {
      const { signal } = this.ending;
      if (before) this.inherit(before);
      this.main.querySelector(".moving").hidden = false;
      this.toolbar.play.addEventListener("click", () => { this.plays = this.toolbar.playing; });
      for (const each of this.spaces) each.addEventListener("change", () => this.showSpaces());
      this.plot = new Plot.Plot(this.main, this.cards, (number) => this.go(number));
      this.main.addEventListener("flexact-found", () => this.found());
      this.main.addEventListener("click", (event) => this.follow(event));
      Finder.listen(this.main, signal);
      Theme.listen(this.root, () => this.viewers.forEach((each) => each.dress()), signal);
      Printing.listen(this.root, this.viewers, signal);
      Terms.explain(this.root, signal);
      for (const card of this.cards) this.furnish(card);
      this.nearness = new IntersectionObserver((entries) => {
        for (const { target, isIntersecting } of entries) {
          target.near = isIntersecting;
          if (isIntersecting) this.wake(target);
        }
      }, { rootMargin: MARGIN });
      for (const card of this.cards) this.nearness.observe(card);
      window.addEventListener("hashchange", () => this.route(), { signal });
      this.route();
    }

    /** Buttons that take what a card has, and what plays where drawing takes long. */
    furnish(card) {
      for (const part of card.querySelectorAll(".text")) {
        const content = () => part.querySelector("pre").textContent;
        const copy = part.querySelector(".copy"), save = part.querySelector(".save");
        if (navigator.clipboard) {
          copy.hidden = false;
          copy.addEventListener("click", async () => {
            await navigator.clipboard.writeText(content());
            copy.textContent = "Copied";
            setTimeout(() => { copy.textContent = "Copy"; }, LIT);
          });
        }
        if (save) {
          save.hidden = false;
          save.addEventListener("click", () => keep(part.dataset.file, content()));
        }
      }
      for (const event of ["pointerenter", "focusin"]) {
        card.addEventListener(event, () => this.attend(card));
      }
    }

    // Drawings

    wake(card) {
      const root = card.querySelector(".viewer");
      if (!root || this.alive.has(card) || card.hidden || this.main.hidden) return;
      if (this.viewers.length >= MOST) this.sleep(this.farthest());
      if (!this.fresh.has(card)) this.fresh.set(card, root.cloneNode(true));
      const opened = Main.opened(root);
      if (!opened.context) return;
      const viewer = Main.make(opened), [first] = this.viewers;
      viewer.ending = new AbortController();
      viewer.choices = new Controls.Choices(viewer);
      viewer.stage.apart = true;
      viewer.layers.arrows = false;
      Main.link(root, viewer, () => true, viewer.ending.signal);
      Main.scrollPast(viewer);
      viewer.stage.canvas.style.touchAction = "pan-y"; // a finger scrolls past it
      this.toolbar.listenToKeys(viewer);
      this.take(card, viewer);
      const others = this.viewers.some((each) => each !== viewer && each.player.playing);
      viewer.player.playing = this.plays && (!viewer.stage.software || !others);
      viewer.amplify(Number(this.toolbar.amplitude.value) / 100);
      viewer.player.speed = Number(this.toolbar.speed.value);
      viewer.showStress(-1);
      if (viewer.data.movements.length) viewer.showMovement(0);
      viewer.choices.choose("movement", "0");
      if (card.picked) viewer.choices.restore(card.picked);
      viewer.choices.picked.clear();
      viewer.stage.look("iso");
      if (first) {
        viewer.stage.adopt(first.stage);
        viewer.player.cycle = first.player.cycle;
      }
      viewer.dress();
      this.showSpaces();
      this.toolbar.refresh();
    }

    /** Have a viewer among those that are seen from the same side. */
    take(card, viewer) {
      for (const each of this.viewers) viewer.join(each);
      this.viewers.push(viewer);
      this.alive.set(card, viewer);
      viewer.changed = () => [viewer.choices, this.toolbar].forEach((each) => each.refresh());
    }

    /** Take a viewer out of those. */
    leave(card) {
      const viewer = this.alive.get(card);
      this.alive.delete(card);
      this.viewers.splice(this.viewers.indexOf(viewer), 1);
      for (const each of this.viewers) {
        each.peers = each.peers.filter((other) => other !== viewer);
        each.stage.peers = each.stage.peers.filter((other) => other !== viewer.stage);
      }
      viewer.peers = [];
      viewer.stage.peers = [];
      return viewer;
    }

    /** Leave a still picture of what is seen, and give the context back. */
    sleep(card) {
      const viewer = this.leave(card), root = this.fresh.get(card).cloneNode(true);
      card.picked = Object.fromEntries(viewer.choices.picked);
      Printing.draw(viewer);
      root.querySelector(".on-paper").replaceWith(viewer.part("on-paper"));
      root.classList.add("live", "asleep");
      root.querySelector(".still").hidden = true;
      root.querySelector(".interactive").hidden = false;
      viewer.root.replaceWith(root);
      this.free(viewer);
    }

    free(viewer) {
      viewer.ending.abort();
      viewer.player.playing = false;
      viewer.stage.dispose();
    }

    /** The one that is alive and out of sight, else the longest alive. */
    farthest() {
      const cards = [...this.alive.keys()];
      return cards.find((card) => !card.near) || cards[0];
    }

    /** Where drawing takes long only what is looked at plays. */
    attend(card) {
      const viewer = this.alive.get(card);
      if (!viewer || !viewer.stage.software || !this.plays || viewer.player.playing) return;
      for (const each of this.viewers) each.play(each === viewer);
    }

    showSpaces() {
      const shown = this.spaces.filter(({ checked }) => checked).map(({ dataset }) => Number(dataset.space));
      for (const viewer of this.viewers) {
        viewer.spaces.show(...shown);
        viewer.stage.refit();
        viewer.stage.request();
      }
    }

    /** Take over the drawings of cards that stay as they are. */
    inherit(before) {
      this.plays = before.plays;
      for (const [card, viewer] of [...before.alive]) {
        const own = this.cards.find(({ dataset }) => dataset.key === card.dataset.key);
        const place = own && own.querySelector(".viewer");
        if (!place) continue;
        before.leave(card);
        this.fresh.set(own, before.fresh.get(card));
        place.replaceWith(viewer.root);
        const others = this.viewers.some(({ player }) => player.playing);
        this.take(own, viewer);
        viewer.player.playing = this.plays && (!viewer.stage.software || !others);
        viewer.stage.request();
      }
    }

    // From place to place

    /** What was found and sorted is the same in the table and in the plot. */
    found() {
      const list = this.main.querySelector(".cards"), shown = Array.from(list.children);
      const rows = new Map(Array.from(this.main.querySelectorAll("tr[data-number]"),
        (each) => [each.dataset.number, each]));
      for (const card of shown) {
        const line = rows.get(card.dataset.number);
        line.hidden = card.hidden;
        line.parentElement.append(line);
        if (!card.hidden && card.near) this.wake(card);
      }
      this.plot.draw();
    }

    /** Links to cards and to whole pages; what was found stays in the address. */
    follow(event) {
      const link = event.target.closest("a[href^='#']");
      if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
      const [, kind, number] = link.getAttribute("href").match(/^#(card-|layout=)(\d+)$/) || [];
      if (!kind) return;
      event.preventDefault();
      if (kind === "card-") this.go(number);
      else window.location.hash = `layout=${number}`;
    }

    /** Bring a card into sight. */
    go(number) {
      const card = this.cardOf(number);
      if (!card) return;
      card.scrollIntoView({ block: "start" });
      card.querySelector("h2 a, summary").focus({ preventScroll: true });
      card.classList.add("lit");
      setTimeout(() => card.classList.remove("lit"), LIT);
    }

    cardOf(number) {
      return this.cards.find(({ dataset }) => dataset.number === String(number));
    }

    /** Show what the address says: all cards, or the whole page of one. */
    route() {
      const hash = window.location.hash.slice(1);
      const number = new URLSearchParams(hash).get("layout"), card = this.cardOf(number);
      if (card && card.querySelector(".whole")) this.open(card);
      else if (this.shown && !this.one.querySelector(`[id="${CSS.escape(hash)}"]`)) this.close();
      if (!number) this.last = window.location.hash;
    }

    async open(card) {
      if (this.shown === card) return;
      if (!this.shown) this.scrolled = window.scrollY;
      this.shown = card;
      const body = await Packed.text(card.querySelector(".whole"));
      if (this.shown !== card) return;
      if (this.whole) this.whole.dispose();
      for (const each of [...this.alive.keys()]) this.sleep(each);
      this.main.hidden = this.root.querySelector("header.verdict").hidden = true;
      this.one.hidden = false;
      this.one.innerHTML = body;
      this.one.prepend(this.wayBack(card));
      this.whole = Main.mount(this.one);
      window.scrollTo({ top: 0, behavior: "instant" });
      this.one.querySelector(".back a").focus({ preventScroll: true });
    }

    /** Back to all, and to the neighbours. */
    wayBack(card) {
      const made = document.createElement("nav");
      made.className = "back";
      const link = (words, hash) => {
        const each = document.createElement("a");
        each.href = `#${hash}`;
        each.textContent = words;
        made.append(each, " ");
      };
      link("All layouts", (this.last || "").slice(1));
      const shown = Array.from(card.parentElement.children).filter(({ hidden }) => !hidden);
      const at = shown.indexOf(card);
      if (shown[at - 1]) link("\u2190 before", `layout=${shown[at - 1].dataset.number}`);
      if (shown[at + 1]) link("next \u2192", `layout=${shown[at + 1].dataset.number}`);
      const name = document.createElement("b");
      name.textContent = `${card.dataset.number}  ${card.dataset.name}`;
      made.append(name);
      return made;
    }

    close() {
      const card = this.shown;
      this.shown = null;
      if (this.whole) this.whole.dispose();
      this.whole = null;
      this.one.replaceChildren();
      this.one.hidden = true;
      this.main.hidden = this.root.querySelector("header.verdict").hidden = false;
      window.scrollTo({ top: this.scrolled || 0, behavior: "instant" });
      card.querySelector("h2 a").focus({ preventScroll: true });
      for (const each of this.cards) if (each.near) this.wake(each);
    }

    // As of Main.mount

    view() {
      const whole = this.shown && this.whole ? this.whole.view() : null;
      const open = this.cards.flatMap((card) =>
        Array.from(card.querySelectorAll("details[open] > summary"),
          ({ textContent }) => [card.dataset.key, textContent]));
      const { plays, viewers } = this;
      return {
        open, plays, whole, scroll: [window.scrollX, window.scrollY],
        looks: viewers.length ? viewers[0].stage.looks() : null,
        spaces: this.spaces.map(({ checked }) => checked),
        axes: this.plot.axes(),
      };
    }

    restore(view) {
      if (!view || !view.spaces) return;
      this.plays = view.plays;
      this.spaces.forEach((each, k) => { each.checked = view.spaces[k]; });
      this.showSpaces();
      this.plot.choose(view.axes);
      for (const [key, words] of view.open) {
        const card = this.cards.find(({ dataset }) => dataset.key === key);
        for (const each of card ? card.querySelectorAll("summary") : []) {
          if (each.textContent === words) each.parentElement.open = true;
        }
      }
      if (this.viewers.length && view.looks) this.viewers[0].stage.lookAgain(view.looks);
      window.scrollTo(...view.scroll);
    }

    dispose() {
      this.ending.abort();
      this.nearness.disconnect();
      if (this.whole) this.whole.dispose();
      for (const card of [...this.alive.keys()]) this.free(this.leave(card));
    }
  }

  /** Have the browser save a text as a file. */
  function keep(name, text) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), LIT);
  }

  return { mount };
})();
