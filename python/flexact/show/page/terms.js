// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Words of the field in the page: each is marked where a section has it first, and tells its
// sentence where it is pointed at, focused or tapped.

const Terms = (() => {
  const SENTENCES = {/* terms */};
  const SKIPPED = "button, a, label, summary, script, style, code, pre, svg, .deck, .name, .origin,"
    + " .tip, .term, .term-tip, .on-paper, .keys";
  const BLOCK = "section, header, .mode, .shown";
  const words = Object.keys(SENTENCES).sort((a, b) => b.length - a.length);
  const escaped = words.map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  const pattern = new RegExp(`(?<![\\w-])(?:${escaped.join("|")})(?:e?s)?(?![\\w-])`, "gi");

  /** The sentence of a word, also in the plural or with a capital. */
  function sentence(word) {
    const small = word.toLowerCase();
    const key = [small, small.replace(/s$/, ""), small.replace(/es$/, "")]
      .find((each) => Object.hasOwn(SENTENCES, each));
    return key === undefined ? null : { key, text: SENTENCES[key] };
  }

  /** Mark terms below an element, each once a section. */
  function mark(root) {
    const told = new Map();
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    const found = [];
    while (walker.nextNode()) {
      const parent = walker.currentNode.parentElement;
      if (parent && !parent.closest(SKIPPED)) found.push(walker.currentNode);
    }
    for (const node of found) {
      const block = node.parentElement.closest(BLOCK);
      if (!told.has(block)) told.set(block, new Set());
      split(node, told.get(block));
    }
  }

  function split(node, told) {
    const text = node.data, pieces = [];
    let behind = 0;
    for (const { 0: word, index } of text.matchAll(pattern)) {
      const known = sentence(word);
      if (!known || told.has(known.key)) continue;
      told.add(known.key);
      pieces.push(text.slice(behind, index), term(word, known));
      behind = index + word.length;
    }
    if (pieces.length) node.replaceWith(...pieces, text.slice(behind));
  }

  function term(word, { key, text }) {
    const made = document.createElement("span");
    Object.assign(made, { className: "term", tabIndex: 0, textContent: word });
    made.dataset.term = key;
    made.setAttribute("role", "note");
    made.setAttribute("aria-description", text);
    return made;
  }

  /** Mark what a root holds, and tell sentences until the signal. */
  function explain(root, signal) {
    mark(root);
    const tip = document.createElement("div");
    Object.assign(tip, { className: "term-tip", hidden: true });
    tip.setAttribute("role", "tooltip");
    root.append(tip);
    if (signal) signal.addEventListener("abort", () => tip.remove());
    const at = ({ target }) => (target instanceof Element ? target.closest(".term") : null);
    const listen = (event, act) => root.addEventListener(event, act, { signal });
    const hide = () => { tip.hidden = true; };
    for (const event of ["pointerover", "focusin", "click"]) {
      listen(event, (told) => (at(told) ? show(tip, at(told)) : event === "click" && hide()));
    }
    listen("pointerout", (event) => {
      if (event.pointerType === "mouse" && at(event)) hide();
    });
    listen("focusout", hide);
    listen("keydown", ({ key }) => key === "Escape" && hide());
    window.addEventListener("scroll", hide, { signal, passive: true });
  }

  function show(tip, each) {
    tip.textContent = SENTENCES[each.dataset.term];
    tip.hidden = false;
    const [box] = each.getClientRects();
    const { offsetWidth: wide, offsetHeight: high } = tip;
    const room = document.documentElement.clientWidth;
    const top = box.bottom + 6 + high > window.innerHeight ? box.top - high - 6 : box.bottom + 6;
    tip.style.left = `${Math.max(8, Math.min(box.left, room - wide - 8))}px`;
    tip.style.top = `${Math.max(4, top)}px`;
  }

  return { mark, explain, SENTENCES };
})();
