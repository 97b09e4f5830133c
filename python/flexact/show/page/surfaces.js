// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Which corners of the shapes make triangles and edges: in full, plainly where there are very
// many members, or lightly while something turns that is slow to draw.

const Surfaces = (() => {
  const FULL = "full", PLAIN = "plain", LIGHT = "light";
  const FEWER = { [PLAIN]: 4, [LIGHT]: 3 }; // corners of a round section
  // Parts that are shaded in their own way: flat faces, and the sides of members that look round.
  const FLAT = "flat", ROUND = "round";
  // One face of a thin rectangle, by the axis along which it is wide.
  const ONE_FACE = { 1: [2, 3], 2: [1, 2] };

  /** Triangles of members in some detail, or a part of them, and the member of each triangle. */
  function triangles(plan, rows, detail = FULL, part = "") {
    const index = [], owner = [];
    for (const m of rows) {
      const before = index.length;
      const kind = plan.smooth && plan.round[m] ? ROUND : FLAT;
      if (!part || part === kind) sides(plan, m, detail, index);
      if (part !== ROUND && detail === FULL) ends(plan, m, index);
      for (let i = before; i < index.length; i += 3) owner.push(m);
    }
    return { index, owner: Int32Array.from(owner) };
  }

  /** The corners of a section that are used, and whether they go round. */
  function ringOf(plan, m, detail) {
    const every = Array.from({ length: plan.corners[m] }, (_, c) => c);
    if (every.length === 2) return [every, false];
    if (detail === FULL) return [every, true];
    if (plan.round[m]) {
      const count = FEWER[detail];
      return [every.slice(0, count).map((i) => Math.round((i * every.length) / count)), true];
    }
    return plan.wide[m] ? [ONE_FACE[plan.wide[m]], false] : [every, true];
  }

  function sides(plan, m, detail, index) {
    const [ring, closed] = ringOf(plan, m, detail);
    const last = plan.stations[m] - 1;
    const step = detail === LIGHT ? Math.max(1, last / 2) : 1;
    const corners = plan.corners[m];
    for (let s = 0; s < last; s += step) {
      const here = plan.vertex[m] + s * corners, there = here + step * corners;
      for (let j = closed ? 0 : 1; j < ring.length; j++) {
        const a = ring[(j + ring.length - 1) % ring.length], b = ring[j];
        index.push(here + a, here + b, there + b, here + a, there + b, there + a);
        // A face that closes nothing is seen from both sides.
        if (!closed) index.push(here + b, here + a, there + b, there + b, here + a, there + a);
      }
    }
  }

  function ends(plan, m, index) {
    const c = plan.corners[m];
    for (const s of [0, plan.stations[m] - 1]) {
      // Within a divided sheet nothing ends.
      if (plan.joined[2 * m + (s ? 1 : 0)]) continue;
      const at = plan.vertex[m] + s * c;
      for (let j = 2; j < c; j++) {
        index.push(at, ...(s ? [at + j - 1, at + j] : [at + j, at + j - 1]));
      }
    }
  }

  /** The edges of members: along them where the section has corners, and round their ends. */
  function edges(plan, rows) {
    const index = [];
    for (const m of rows) {
      const c = plan.corners[m], last = plan.stations[m] - 1, first = plan.vertex[m];
      for (let s = 0; s < last && !plan.round[m]; s++) {
        for (let j = 0; j < c; j++) index.push(first + s * c + j, first + (s + 1) * c + j);
      }
      for (const at of [first, first + last * c]) {
        if (plan.joined[2 * m + (at > first ? 1 : 0)]) continue;
        for (let j = 0; j < (c > 2 ? c : 1); j++) index.push(at + j, at + ((j + 1) % c));
      }
    }
    return index;
  }

  return { triangles, edges, FULL, PLAIN, LIGHT, FLAT, ROUND };
})();
