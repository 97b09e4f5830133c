// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts a page of layouts; one without any has the drawings of their freedom.

window.mounted = Layouts.mount(document.body);
// For whoever looks at the drawings by hand, and for tests.
window.drawings = window.mounted.viewers;
