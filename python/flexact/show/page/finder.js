// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Chooses and sorts the cards of an index. What was chosen stands in the address behind #, so that
// it can be linked and comes again when a page is left and returned to.

const Finder = (() => {
  const words = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" });

  /** Have the cards of a root chosen and sorted, until the signal, where there is one. */
  function listen(root, signal) {
    const bar = root.querySelector(".finder");
    const list = root.querySelector(".cards");
    const cards = Array.from(list.children).map((card) => ({ card, text: null }));
    const find = bar.querySelector("#find");
    const sort = bar.querySelector("#sort");
    const down = bar.querySelector("#down");
    const found = bar.querySelector("#found");
    const boxes = Array.from(bar.querySelectorAll("input[type=checkbox][name]"));
    const facets = [...new Set(boxes.map(({ name }) => name))];
    const ranges = Array.from(bar.querySelectorAll("input[data-range]"));
    const { what } = bar.dataset;
    const first = sort.options[0].value;
    let order = "", isBegun = false;

    const isDown = () => down.getAttribute("aria-pressed") === "true";
    const press = (on) => down.setAttribute("aria-pressed", String(on));
    const textOf = (each) => (each.text ??= (each.card.querySelector(".said") || each.card).textContent.toLowerCase());

    function apply() {
      const wanted = facets.map((name) => [name, chosen(name)]).filter(([, values]) => values.length);
      const bounds = ranges.filter(({ value }) => value.trim() && !Number.isNaN(Number(value)));
      const parts = find.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const each of cards) {
        const { dataset } = each.card;
        const isShown = wanted.every(([name, values]) => values.includes(dataset[name]))
          && bounds.every((bound) => isWithin(dataset[bound.dataset.range], bound))
          && parts.every((part) => textOf(each).includes(part));
        if (each.card.hidden === isShown) each.card.hidden = !isShown;
        shown += isShown;
      }
      arrange();
      list.dispatchEvent(new CustomEvent("flexact-found", { bubbles: true }));
      const all = cards.length;
      found.textContent = shown === all ? `${all} shown`
        : shown ? `${shown} of ${all} shown` : `No ${what} is like this.`;
      bar.querySelector("#all").disabled = shown === all && !order;
    }

    /** Values of a facet that are chosen. */
    const chosen = (name) => boxes.filter((box) => box.name === name && box.checked)
      .map((box) => box.value);

    /** Whether a datum is on the right side of a bound, which is in the unit that is shown. */
    function isWithin(datum, { value, dataset: { end, factor } }) {
      const there = Number(datum) * Number(factor), bound = Number(value);
      const near = 5e-3 * Math.abs(bound); // as many digits as are shown
      return end === "least" ? there >= bound - near : there <= bound + near;
    }

    function arrange() {
      const wanted = `${sort.value}${isDown() ? " down" : ""}`;
      if (wanted === (order || first)) return;
      const name = sort.value.replace("-", "");
      const sign = isDown() === (name !== sort.value) ? 1 : -1;
      const key = ({ card }) => card.dataset[name];
      const compare = name === "name" ? (a, b) => sign * words.compare(key(a), key(b))
        : (a, b) => without(a) - without(b) || sign * (Number(key(a)) - Number(key(b))) || 0;
      const without = (each) => Number(Number.isNaN(Number(key(each))));
      cards.sort((a, b) => compare(a, b) || a.card.dataset.place - b.card.dataset.place);
      list.append(...cards.map(({ card }) => card));
      order = wanted === first ? "" : wanted;
    }

    const inAddress = (name) => (name === "kind" ? "show" : name);

    /** What is chosen, as it stands in the address. */
    function written() {
      const state = new URLSearchParams();
      for (const name of facets) {
        if (chosen(name).length) state.set(inAddress(name), chosen(name).join(","));
      }
      for (const { value, dataset: { range, end } } of ranges) {
        if (value.trim()) state.set(`${end} ${range}`, value.trim());
      }
      if (find.value.trim()) state.set("find", find.value.trim());
      if (sort.value !== first) state.set("sort", sort.value);
      if (isDown()) state.set("reverse", "1");
      return state.toString().replaceAll("%2C", ",");
    }

    function take() {
      const state = new URLSearchParams(window.location.hash.slice(1));
      // Behind the page of one of them the cards stay as they are.
      if (state.has("layout") && isBegun) return;
      isBegun = true;
      for (const box of boxes) {
        box.checked = (state.get(inAddress(box.name)) || "").split(",").includes(box.value);
      }
      for (const each of ranges) {
        each.value = state.get(`${each.dataset.end} ${each.dataset.range}`) || "";
      }
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
      for (const box of boxes) box.checked = false;
      for (const each of ranges) each.value = "";
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
    window.addEventListener("hashchange", take, { signal });
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
    }, { signal });
    take();
  }

  return { listen };
})();
