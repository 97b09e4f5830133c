// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts a page without a drawing.

(() => {
  const { signal } = new AbortController();
  const theme = new Theme.Theme(document.body);
  theme.listen(() => {}, signal);
  Printing.listen(document.body, theme, [], signal);
})();
