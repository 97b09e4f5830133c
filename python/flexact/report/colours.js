"use strict";
// Colours of members: their own, or of a self-stress on the diverging scale of the legend.

const Colours = (() => {
  /** Write the colour of a value from -1 to 1 to out[at..at+2]; `stops` as SceneData has them. */
  function diverging(stops, value, out, at) {
    const last = stops.length - 1;
    const place = Math.max(0, Math.min(last, ((value + 1) / 2) * last));
    const before = Math.min(Math.floor(place), last - 1);
    const share = place - before;
    for (let k = 0; k < 3; k++) {
      out[at + k] = (1 - share) * stops[before][k] + share * stops[before + 1][k];
    }
  }

  const rgb = (colour) => `rgb(${colour.map((part) => Math.round(255 * part)).join(" ")})`;

  /** The scale as a CSS background from left to right. */
  const gradient = (stops) => `linear-gradient(to right, ${stops.map(rgb).join(", ")})`;

  return { diverging, gradient, rgb };
})();
