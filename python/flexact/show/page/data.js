// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The data of the drawing as the page holds them, and arrays out of their packed form.
// Lengths are parts of the drawing's size, measured from its centre. Values of a self-stress are
// coloured on the diverging scale of the legend.

const PageData = (() => {
  const KINDS = { f4: Float32Array, i4: Int32Array, i2: Int16Array, u1: Uint8Array };
  const decoded = new WeakMap();

  /** The array that {type, data} stands for, decoded when it is first asked for. */
  function array(packed) {
    if (!decoded.has(packed)) {
      const text = atob(packed.data);
      const bytes = new Uint8Array(text.length);
      for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
      decoded.set(packed, new KINDS[packed.type](bytes.buffer));
    }
    return decoded.get(packed);
  }

  /** The data in the <script type="application/json"> of a viewer. */
  const read = (root) => JSON.parse(root.querySelector(".drawing-data").textContent);

  /** What writes colours of 8 bits, (3 a member or hinge), to [red, green, blue]. */
  const own = (colour) => (row, rgb) => {
    for (let k = 0; k < 3; k++) rgb[k] = colour[3 * row + k] / 255;
  };

  /** Write the colour of a value from -1 to 1 to [red, green, blue]; `stops` as the page has. */
  function diverging(stops, value, rgb) {
    const last = stops.length - 1;
    const place = Math.max(0, Math.min(last, ((value + 1) / 2) * last));
    const before = Math.min(Math.floor(place), last - 1);
    const share = place - before;
    for (let k = 0; k < 3; k++) {
      rgb[k] = (1 - share) * stops[before][k] + share * stops[before + 1][k];
    }
  }

  const inCss = (colour) => `rgb(${colour.map((part) => Math.round(255 * part)).join(" ")})`;

  /** The scale as a CSS background from left to right. */
  const gradient = (stops) => `linear-gradient(to right, ${stops.map(inCss).join(", ")})`;

  return { array, read, own, diverging, gradient, inCss };
})();
