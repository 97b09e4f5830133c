"use strict";
// Starts a page without a scene.

Theme.listen(() => {});
Printing.listen(null);
