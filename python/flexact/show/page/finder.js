// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Chooses and sorts the cards of an index. What was chosen stands in the address behind #, so that
// it can be linked and comes again when a page is left and returned to.

const Finder = (() => {
  const words = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" });

  function listen(root) {
    const bar = root.querySelector(".finder");
    const list = root.querySelector(".cards");
    const cards = Array.from(list.children).map((card) => ({ card, text: null }));
    const find = bar.querySelector("#find");
    const sort = bar.querySelector("#sort");
    const down = bar.querySelector("#down");
    const found = bar.querySelector("#found");
    const kinds = Array.from(bar.querySelectorAll('input[name="kind"]'));
    const first = sort.options[0].value;
    let order = "";

    const isDown = () => down.getAttribute("aria-pressed") === "true";
    const press = (on) => down.setAttribute("aria-pressed", String(on));
    const textOf = (each) => (each.text ??= each.card.textContent.toLowerCase());

    function apply() {
      const wanted = kinds.filter((box) => box.checked).map((box) => box.value);
      const parts = find.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const each of cards) {
        const isShown = (!wanted.length || wanted.includes(each.card.dataset.kind))
          && parts.every((part) => textOf(each).includes(part));
        if (each.card.hidden === isShown) each.card.hidden = !isShown;
        shown += isShown;
      }
      arrange();
      const all = cards.length;
      found.textContent = shown === all ? `${all} shown`
        : shown ? `${shown} of ${all} shown` : "No deck is like this.";
      bar.querySelector("#all").disabled = shown === all && !order;
    }

    function arrange() {
      const wanted = `${sort.value}${isDown() ? " down" : ""}`;
      if (wanted === (order || first)) return;
      const sign = isDown() ? -1 : 1;
      const key = ({ card }) => card.dataset[sort.value];
      const compare = sort.value === "name" ? (a, b) => words.compare(key(a), key(b))
        : (a, b) => Math.sign(Number(key(a)) - Number(key(b))) || 0;
      cards.sort((a, b) => sign * compare(a, b) || a.card.dataset.place - b.card.dataset.place);
      list.append(...cards.map(({ card }) => card));
      order = wanted === first ? "" : wanted;
    }

    /** What is chosen, as it stands in the address. */
    function written() {
      const state = new URLSearchParams();
      const wanted = kinds.filter((box) => box.checked).map((box) => box.value);
      if (wanted.length) state.set("show", wanted.join(","));
      if (find.value.trim()) state.set("find", find.value.trim());
      if (sort.value !== first) state.set("sort", sort.value);
      if (isDown()) state.set("reverse", "1");
      return state.toString().replaceAll("%2C", ",");
    }

    function take() {
      const state = new URLSearchParams(window.location.hash.slice(1));
      const wanted = (state.get("show") || "").split(",");
      for (const box of kinds) box.checked = wanted.includes(box.value);
      find.value = state.get("find") || "";
      const sorted = state.get("sort");
      sort.value = Array.from(sort.options).some(({ value }) => value === sorted) ? sorted : first;
      press(state.get("reverse") === "1");
      apply();
    }

    function changed() {
      apply();
      const state = written();
      const { pathname, search } = window.location;
      window.history.replaceState(null, "", state ? `#${state}` : pathname + search);
    }

    function clear() {
      for (const box of kinds) box.checked = false;
      find.value = "";
      sort.value = first;
      press(false);
      changed();
    }

    /** Go with the arrow keys from card to card. */
    function move(event) {
      const steps = { ArrowRight: 1, ArrowDown: across(), ArrowLeft: -1, ArrowUp: -across() };
      const links = seen().map(({ card }) => card.querySelector("a")).filter(Boolean);
      const at = links.indexOf(document.activeElement);
      if (at < 0) return;
      const to = event.key === "Home" ? 0 : event.key === "End" ? links.length - 1
        : steps[event.key] ? at + steps[event.key] : -1;
      if (!links[to]) return;
      event.preventDefault();
      links[to].focus();
    }

    const seen = () => cards.filter(({ card }) => !card.hidden);

    /** How many cards stand beside each other. */
    function across() {
      return getComputedStyle(list).gridTemplateColumns.split(" ").length;
    }

    bar.hidden = false;
    const summary = root.querySelector(".index .about");
    if (summary) summary.hidden = true;
    bar.addEventListener("change", changed);
    find.addEventListener("input", changed);
    down.addEventListener("click", () => {
      press(!isDown());
      changed();
    });
    bar.querySelector("#all").addEventListener("click", clear);
    list.addEventListener("keydown", move);
    window.addEventListener("hashchange", take);
    document.addEventListener("keydown", (event) => {
      const inField = event.target.matches("input:not([type=checkbox]), select, textarea");
      if (event.key === "/" && !inField && !event.ctrlKey && !event.metaKey) {
        event.preventDefault();
        find.focus();
      }
      if (event.key === "Escape" && event.target === find) {
        find.value = "";
        changed();
      }
    });
    take();
  }

  return { listen };
})();
