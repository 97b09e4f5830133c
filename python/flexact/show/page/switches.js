// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Edit and see: what was clicked is offered with switches, and a server says what comes of it.
// Nothing is analysed here.

const Switches = (() => {
  const HINT = "Click a sheet, a wire, a body, a hinge, a clamp or a point in the drawing, "
    + "or find it by its name.";
  const BROKEN = "The file has errors: once they are mended, parts can be switched again.";
  const SOON = "The file is still being analysed.";

  class Panel {
    /** `send(request)` asks the server, and promises its answer or an error in words. */
    constructor(send) {
      this.send = send;
      this.told = null;
      this.shown = null; // what the card is about
      this.target = null; // how it was asked for
      this.saving = null; // the save that was asked for last
      this.focus = "";
      this.section = this.make();
      this.listening = (event) => this.hear(event);
      this.section.addEventListener("focusin", ({ target: { dataset } }) => {
        this.focus = dataset.key || "";
      });
      // What is taken away with a scene comes back with the next.
      this.section.addEventListener("focusout", () => setTimeout(() => {
        const active = this.section.getRootNode().activeElement;
        if (this.section.isConnected && !this.section.contains(active)) this.focus = "";
      }));
      this.keys = (event) => this.key(event);
      document.addEventListener("keydown", this.keys);
    }

    /** Take a place in a scene: in the side of its first viewer; nowhere in a page without. */
    mount(root, viewers = []) {
      if (this.root) this.leave();
      Object.assign(this, { root, viewers });
      const side = root.querySelector(".side");
      if (side) side.prepend(this.section);
      for (const name of ["flexact-click", "click"]) root.addEventListener(name, this.listening);
      this.offerSteps();
      this.refocus();
      this.renew();
    }

    /** Buttons that do the steps of the advice; what was before one may be hidden. */
    offerSteps() {
      const steps = this.root.querySelectorAll("li[data-step]");
      steps.forEach((each, k) => {
        const { step } = each.dataset;
        const act = button("Try", () => this.ask({ do: "try", step }, "undo"), "try");
        act.setAttribute("aria-label", `Try: ${step}`);
        act.dataset.key = `try ${k + 1}`;
        each.append(" ", act);
      });
      // Single changes are here, with buttons.
      const singles = steps.length && this.root.querySelector("#remedies .folded");
      if (singles) singles.remove();
      if (!this.isChosen) this.part("singles").open = !steps.length;
      const pair = this.root.querySelector(".tried");
      if (!pair) return;
      pair.querySelector(".after-side .which").append(button("Undo", () => this.ask({ do: "undo" })));
      pair.querySelector(".before-side .which").append(
        button("Hide", () => pair.classList.add("alone")));
    }

    /** Leave the scene, which is renewed or goes. */
    leave() {
      for (const name of ["flexact-click", "click"]) {
        this.root.removeEventListener(name, this.listening);
      }
      this.section.remove();
      this.root = null;
    }

    dispose() {
      if (this.root) this.leave();
      document.removeEventListener("keydown", this.keys);
    }

    /** Ask what there is to be shown. */
    async renew() {
      const answer = await this.send({ do: "tell" });
      if (answer.told) this.tell(answer.told);
    }

    /** Show what the server tells of the session. */
    tell(told) {
      this.told = told;
      if (told.said && told.said.length) this.say(told.said.join(" "));
      const is = (name, value) => { this.part(name).disabled = !value; };
      is("undo", told.undo);
      is("redo", told.redo);
      is("reset", told.edits.length);
      this.part("names").replaceChildren(...(told.names || []).map(({ words }) => {
        const made = element("option");
        made.value = words;
        return made;
      }));
      this.verdict(told);
      this.proposals(told.proposals || []);
      this.edits(told);
      if (this.target) this.look(this.target, true);
      else this.card(null);
      this.refocus();
    }

    /** Light what is named in the drawing. */
    mark(target) {
      for (const viewer of this.viewers || []) viewer.mark(target);
    }

    // What was clicked ------------------------------------------------------------

    hear(event) {
      if (event.type === "flexact-click") {
        const { element: number, node, body } = event.detail || {};
        if (body !== undefined) this.look({ name: body });
        else if (number !== undefined && number !== null) this.look({ element: number });
        else if (node !== undefined && node !== null) this.look({ node });
        return;
      }
      const link = event.target.closest && event.target.closest("button.link");
      if (!link || this.section.contains(link)) return;
      const { element: number, node } = link.dataset;
      if (number !== undefined) this.look({ element: Number(number) });
      else if (node !== undefined) this.look({ node: Number(node) });
    }

    key(event) {
      const typing = event.target.closest && event.target.closest("input[type=text], textarea");
      if (!this.root || typing || !(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      const what = key === "z" ? (event.shiftKey ? "redo" : "undo") : key === "y" ? "redo" : "";
      if (!what || this.part(what).disabled) return;
      event.preventDefault();
      this.ask({ do: what });
    }

    /** Ask for what is offered of a part or a point. */
    async look(target, again = false) {
      this.target = target;
      const answer = await this.send({ do: "look", ...target });
      if (this.target !== target) return;
      if (answer.error) {
        if (again) this.target = null;
        this.card(null);
        if (!again) this.say(answer.error, true);
        return;
      }
      // A name is looked up once.
      const { element: number, node, body } = answer.panel;
      this.target = number === undefined ? { node } : { element: number };
      // Read from CAD again, a part may have another number.
      if (body !== undefined || answer.panel.kept) this.target = { name: answer.panel.name };
      this.card(answer.panel);
      if (again) return this.refocus();
      this.say("");
      // So far that it is seen that there is something, and the drawing stays in sight.
      this.part("card").firstChild.scrollIntoView({ block: "nearest" });
    }

    /** Ask for a change; the scene and what is told come with the next event. */
    async ask(request, key = "") {
      this.focus = key;
      this.section.setAttribute("aria-busy", "true");
      const answer = await this.send(request);
      this.section.removeAttribute("aria-busy");
      this.say(answer.error || "", Boolean(answer.error));
      if (answer.told) this.tell(answer.told);
      if (answer.error && this.target) this.look(this.target, true);
      return answer;
    }

    // What is shown ------------------------------------------------------------------

    part(name) {
      return this.section.querySelector(`[data-part="${name}"]`);
    }

    say(words, bad = false) {
      const said = this.part("said");
      said.textContent = words;
      said.hidden = !words;
      said.classList.toggle("bad", bad);
    }

    verdict({ verdict, kind, margin, is }) {
      const part = this.part("verdict");
      part.hidden = !verdict;
      part.className = `now ${kind || ""}`;
      if (verdict && verdict !== this.before) {
        const first = this.before ? `${this.before} \u2192 ` : "";
        this.words = first ? first + verdict.toLowerCase() : verdict;
        this.before = verdict;
      }
      const words = [element("b", this.words || "", "says"), ` ${margin || ""}`];
      // Said again it would be read out again.
      if (part.textContent !== `${this.words}${words[1]}`) part.replaceChildren(...words);
      const off = is === "none" || is === "broken";
      for (const name of ["find", "card", "singles"]) this.part(name).hidden = off;
      this.part("off").hidden = !off;
      this.part("off").textContent = is === "broken" ? BROKEN : off ? SOON : "";
    }

    refocus() {
      if (!this.focus || !this.root) return;
      const active = this.section.getRootNode().activeElement;
      if (active && active !== document.body && active.dataset.key !== this.focus) return;
      const found = Array.from(this.section.querySelectorAll("[data-key]"))
        .find((each) => each.dataset.key === this.focus);
      if (found) found.focus({ preventScroll: true });
    }

    card(panel) {
      this.shown = panel;
      const card = this.part("card");
      if (!panel) {
        card.replaceChildren(element("p", HINT, "note"));
        return;
      }
      const head = element("h3", panel.title);
      const about = element("p", `${panel.kind} \u00b7 ${panel.about}`, "note");
      const near = panel.near.length ? element("p", "Beside it:", "note near") : "";
      panel.near.forEach((each, k) => near.append(this.jump(each, `near ${k}`)));
      card.replaceChildren(head, about, ...panel.groups.map((each) => this.group(each)), near);
    }

    group({ title, rows }) {
      const made = element("div", "", "switch-group");
      made.append(element("h4", title), ...rows.map((row) => this.row(row)));
      return made;
    }

    /** The states of a deformation or a coordinate, of which one holds. */
    row(row) {
      const key = keyOf(row.place);
      const made = element("fieldset", "", row.now === row.before ? "switch" : "switch edited");
      const legend = element("legend", row.words);
      if (row.now !== row.before) legend.append(element("span", ` was ${row.before}`, "was"));
      made.append(legend);
      for (const state of row.states) {
        const label = element("label", "", "chip");
        const input = element("input");
        Object.assign(input, { type: "radio", name: key, value: state });
        input.checked = state === row.now;
        input.dataset.key = `${key} ${state}`;
        const words = element("span", state);
        if (row.proposed.includes(state)) {
          label.classList.add("proposed");
          label.title = "The advice proposes this.";
          words.append(element("span", " (proposed)", "unseen"));
        }
        input.addEventListener("change", () => this.ask(
          { do: "set", set: [{ ...row.place, to: state }] }, input.dataset.key));
        label.append(input, words);
        made.append(label);
      }
      return made;
    }

    proposals(groups) {
      const made = groups.map(({ head, items, more }) => {
        const part = element("div", "", "proposal");
        const list = element("ul");
        for (const { words, place, choices } of items) {
          const item = element("li");
          const key = keyOf(place);
          const actions = element("span", "", "actions");
          for (const { word, set } of choices) {
            const act = button(capital(word), () => this.ask({ do: "set", set }, "undo"));
            act.setAttribute("aria-label", `${capital(word)}: ${words}`);
            act.dataset.key = `proposed ${key} ${word}`;
            actions.append(act);
          }
          item.append(this.jump({ words, ...target(place) }, `of ${key}`), actions);
          list.append(item);
        }
        if (more) list.append(element("li", "\u2026", "note"));
        part.append(element("h4", head), list);
        return part;
      });
      this.part("proposals").replaceChildren(...made);
      this.part("singles").hidden = !made.length;
    }

    jump({ words, element: number, node }, key) {
      const what = number === undefined ? { node } : { element: number };
      const made = button(words, () => this.look(what), "link");
      made.dataset.key = key;
      for (const event of ["pointerenter", "focusin"]) {
        made.addEventListener(event, () => this.mark(what));
      }
      for (const event of ["pointerleave", "focusout"]) {
        made.addEventListener(event, () => this.mark({}));
      }
      return made;
    }

    edits({ edits, lines, calls, copy, note, save, is }) {
      this.part("made").hidden = !edits.length;
      this.part("edits").replaceChildren(...edits.map(({ words, place }) => {
        const item = element("li");
        if (!place) {
          item.append(element("span", words));
          return item;
        }
        const away = button("Remove", () => this.ask(
          { do: "set", set: [{ ...place, to: "given" }] }, "undo"));
        away.setAttribute("aria-label", `Remove: ${words}`);
        away.dataset.key = `remove ${keyOf(place)}`;
        item.append(this.jump({ words, ...target(place) }, `edit ${keyOf(place)}`), away);
        return item;
      }));
      const count = edits.length;
      this.part("count").textContent = count === 1 ? "1 change" : `${count} changes`;
      this.part("how").textContent = is === "deck" ? "In the deck" : "In Python";
      // Of CAD there are neither lines nor calls.
      const none = !(lines || []).length && !(calls || []).length;
      for (const name of ["how", "lines", "copy"]) this.part(name).hidden = none;
      this.part("lines").replaceChildren(...(lines || []).flatMap(lineOf),
        ...(calls || []).map((call) => element("div", call, "plus")));
      this.part("note").textContent = note || "";
      this.part("note").hidden = !note;
      this.copied = copy || "";
      const name = this.part("name");
      if (!name.value || name.value === this.offered) name.value = save || "";
      this.offered = save || "";
    }

    // What can be done ---------------------------------------------------------------

    async copy() {
      try {
        await navigator.clipboard.writeText(this.copied);
        this.say("Copied.");
      } catch {
        const box = this.part("to-copy");
        box.hidden = false;
        box.value = this.copied;
        box.focus();
        box.select();
        this.say("This browser does not let the page copy: press Ctrl+C.");
      }
    }

    async save(over = false) {
      const name = this.part("name").value;
      this.part("over").hidden = true;
      // Answers may come in another order than what they answer: the newest is told.
      const asked = this.saving = {};
      const answer = await this.send({ do: "save", name, over });
      if (this.saving !== asked) return;
      if (answer.status === 409) {
        this.part("over").hidden = false;
        this.part("there").textContent = `${capital(answer.error)}. Write over it?`;
        this.part("over").querySelector("button").focus();
        return;
      }
      this.say(answer.error ? capital(answer.error) : `Written to ${answer.saved}.`,
        Boolean(answer.error));
      if (!answer.error) this.part("name").focus();
    }

    make() {
      const made = element("section", "", "switches");
      made.setAttribute("aria-labelledby", "switches-head");
      const parts = {
        head: element("h2", "Edit and see"),
        tools: element("div", "", "tools"),
        verdict: element("p", "", "now"),
        said: element("p", "", "said"),
        off: element("p", "", "note"),
        find: element("form", "", "find"),
        card: element("div", "", "card-of-part"),
        made: this.makeEdits(),
        singles: element("details"),
      };
      const proposals = part("div", "proposals", "proposals");
      const summary = element("summary", "Single changes");
      summary.addEventListener("click", () => { this.isChosen = true; });
      parts.singles.append(summary, proposals);
      parts.head.id = "switches-head";
      for (const [name, part] of Object.entries(parts)) part.dataset.part = name;
      for (const [name, words] of [["undo", "Undo"], ["redo", "Redo"], ["reset", "Reset all"]]) {
        const each = button(words, () => this.ask({ do: name }, name));
        each.dataset.part = each.dataset.key = name;
        each.disabled = true;
        parts.tools.append(each);
      }
      for (const part of [parts.verdict, parts.said]) {
        part.setAttribute("role", "status");
        part.setAttribute("aria-live", "polite");
        part.hidden = true;
      }
      this.fillFind(parts.find);
      made.append(...Object.values(parts));
      return made;
    }

    fillFind(form) {
      const label = element("label", "Part, support or node ");
      const input = element("input");
      Object.assign(input, { type: "text", autocomplete: "off", spellcheck: false });
      input.setAttribute("list", "switches-names");
      input.dataset.key = "find";
      const names = element("datalist");
      names.id = "switches-names";
      names.dataset.part = "names";
      const show = button("Show", () => {});
      show.type = "submit";
      label.append(input);
      form.append(label, names, show);
      const find = () => { if (input.value.trim()) this.look({ name: input.value.trim() }); };
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        find();
      });
      // A name that is chosen from the list needs no button.
      input.addEventListener("input", (event) => {
        if (event.inputType === undefined || event.inputType === "insertReplacementText") find();
      });
    }

    makeEdits() {
      const made = element("div", "", "edits-made");
      const heading = part("h3", "count");
      const how = part("h4", "how");
      const lines = part("pre", "lines");
      lines.tabIndex = 0;
      lines.setAttribute("aria-label", "What does it");
      const box = part("textarea", "to-copy");
      Object.assign(box, { readOnly: true, hidden: true, rows: 4 });
      box.setAttribute("aria-label", "To copy");
      box.dataset.key = "to copy";
      const copy = button("Copy", () => this.copy());
      copy.dataset.key = copy.dataset.part = "copy";
      const form = element("form", "", "save");
      const label = element("label", "Save as a new deck ");
      const name = part("input", "name");
      Object.assign(name, { type: "text", autocomplete: "off", spellcheck: false });
      name.dataset.key = "save as";
      label.append(name);
      const save = button("Save", () => {});
      save.type = "submit";
      save.dataset.key = "save";
      form.append(label, save);
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        this.save();
      });
      const over = part("div", "over");
      over.hidden = true;
      const back = () => {
        over.hidden = true;
        name.focus();
      };
      const write = button("Write over it", () => this.save(true));
      const cancel = button("Cancel", back);
      write.dataset.key = "write over";
      cancel.dataset.key = "do not write over";
      over.append(part("p", "there"), write, cancel);
      over.setAttribute("role", "alert");
      made.append(heading, part("ul", "edits"), how, lines, part("p", "note", "note"), copy, box,
        form, over);
      return made;
    }
  }

  /** A line of a deck that goes, and the one in its place. */
  function lineOf({ line, old, new: now }) {
    const made = [];
    const of = (sign, words, kind, told) => {
      const each = element("div", "", kind);
      const mark = element("span", sign, "sign-of-line");
      mark.setAttribute("aria-hidden", "true");
      each.append(mark, element("span", told, "unseen"), element("span", words, "statement"));
      return each;
    };
    const where = line ? `line ${line}` : "a line";
    if (old) made.push(of(`${line || ""} \u2212`, old, "minus", `instead of ${where}: `));
    if (now) made.push(of("+", now, "plus", "new: "));
    return made;
  }

  /** What is looked at to see a place. */
  function target({ element: number, node }) {
    return number === undefined ? { node } : { element: number };
  }

  function keyOf({ element: number, deformation, node, coordinate, part: name, what }) {
    if (name !== undefined) return `${name} ${what}`;
    return number === undefined ? `node ${node} ${coordinate}` : `element ${number} ${deformation}`;
  }

  function capital(words) {
    return words.slice(0, 1).toUpperCase() + words.slice(1);
  }

  function button(words, act, kind = "") {
    const made = element("button", words, kind);
    made.type = "button";
    made.addEventListener("click", act);
    return made;
  }

  function part(kind, name, className = "") {
    const made = element(kind, "", className);
    made.dataset.part = name;
    return made;
  }

  function element(kind, text = "", className = "") {
    const made = document.createElement(kind);
    if (text) made.textContent = text;
    if (className) made.className = className;
    return made;
  }

  const GONE = "The server does not answer: is flexact watch still running?";

  /** Ask the server of the page; what is refused is told in words. */
  async function send(request) {
    // Whoever has its port then is not told where it was.
    if (window.live && window.live.isLost) return { status: 0, error: GONE };
    try {
      const answer = await fetch("edit", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify(request),
      });
      const words = await answer.text();
      try {
        return { status: answer.status, ...JSON.parse(words) };
      } catch {
        return { status: answer.status, error: words.trim() || GONE };
      }
    } catch {
      return { status: 0, error: GONE };
    }
  }

  /** Go along with a page that is watched. */
  function start(root) {
    const panel = new Panel(send);
    root.addEventListener("flexact-renewed", ({ detail: { viewers } }) => {
      panel.mount(root.querySelector(".live-scene"), viewers);
    });
    root.addEventListener("flexact-told", ({ detail }) => {
      if (detail.broken) panel.renew();
    });
    return panel;
  }

  return { Panel, start };
})();

window.switches = Switches.start(document.body);
