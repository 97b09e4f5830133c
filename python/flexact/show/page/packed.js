// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// What a page or an output of a notebook holds compressed.

const Packed = (() => {
  /** The text that an element holds compressed and written in letters. */
  async function text({ textContent }) {
    const bytes = Uint8Array.from(atob(textContent.trim()), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).text();
  }

  return { text };
})();
