// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts a page from disk.

// For whoever looks at the drawings by hand, and for tests: all, and the first.
window.drawings = Main.mount(document.body).viewers;
window.flexact = window.drawings[0] || null;
