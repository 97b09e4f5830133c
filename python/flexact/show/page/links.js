// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Links between the page's words and the drawing: rows and buttons that name an element or a node.

const Links = (() => {
  const NAMED = "[data-element], [data-node]";

  class Links {
    /**
     * `marked({element, node})` is called when something is named, `chosen` when it is pressed, `centred`
     * when it is pressed twice;
     * `owns(element)` tells what within the root is meant.
     */
    constructor(root, owns, marked, chosen, centred) {
      Object.assign(this, { marked, chosen });
      this.rows = new Map();
      const named = Array.from(root.querySelectorAll(NAMED)).filter(owns);
      for (const each of named) {
        this.take(each);
        if (!each.matches("button.link")) continue;
        each.addEventListener("click", () => chosen(this.target(each)));
        each.addEventListener("dblclick", () => centred(this.target(each)));
      }
    }

    take(element) {
      const key = this.key(this.target(element));
      if (!this.rows.has(key)) this.rows.set(key, []);
      this.rows.get(key).push(element);
      const on = () => this.marked(this.target(element));
      const off = () => this.marked({});
      for (const event of ["pointerenter", "focusin"]) element.addEventListener(event, on);
      for (const event of ["pointerleave", "focusout"]) element.addEventListener(event, off);
    }

    /** What a part of the page names. */
    target({ dataset }) {
      return "element" in dataset ? { element: Number(dataset.element) }
        : { node: Number(dataset.node) };
    }

    key({ element, node, body }) {
      if (body !== undefined) return `body ${body}`;
      return element === undefined ? `node ${node}` : `element ${element}`;
    }

    /** Show what is held. */
    hold(target) {
      for (const each of this.heldRows || []) each.classList.remove("held");
      this.heldRows = target ? this.rows.get(this.key(target)) || [] : [];
      for (const each of this.heldRows) each.classList.add("held");
    }

    /** Light the rows that name something. */
    light(target) {
      for (const row of this.lit || []) row.classList.remove("lit");
      this.lit = target ? this.rows.get(this.key(target)) || [] : [];
      for (const row of this.lit) row.classList.add("lit");
    }
  }

  return { Links };
})();
