// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts a page of its own.

window.mounted = Main.mount(document.body);
// For whoever looks at the drawings by hand, and for tests: the first, and all.
window.drawings = window.mounted.viewers;
window.flexact = window.drawings[0] || null;
