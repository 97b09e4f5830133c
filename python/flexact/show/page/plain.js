// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Starts a page without a drawing.

Theme.listen(document.body, () => {});
Printing.listen(document.body, []);
if (typeof Finder === "object") Finder.listen(document.body);
Terms.explain(document.body);
