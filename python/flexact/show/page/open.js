// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Runs three.js and what draws with it, which the page holds compressed. In a browser that cannot
// open them the still pictures stay, and the page says why.

Packed.text(document.querySelector("script.packed")).then((text) => {
  const made = document.createElement("script");
  made.textContent = text;
  document.querySelector("script.packed").replaceWith(made);
}, () => {
  const note = document.createElement("p");
  note.className = "note too-old";
  note.setAttribute("role", "alert");
  note.textContent = "This browser cannot open what draws this page: that takes Chrome or Edge 80, "
    + "Firefox 113, Safari 16.4, or a later one. All else is here.";
  document.body.prepend(note);
  document.querySelector("script.packed").remove();
  Theme.listen(document.body, () => {});
  Printing.listen(document.body, []);
  Terms.explain(document.body);
});
