// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The corners of sections along members, as flexact.drawing.solids has them.

const Shapes = (() => {
  const MANY = 400; // members; more of them get fewer corners
  const ROUND = 24, ROUGH = 8; // corners of round sections: of thick ones, and of others
  const THICK = 0.015; // from this part of the drawing's size
  const THIN = 6; // a section so many times as wide as it is high looks flat
  const PLAIN = [1, 1, 0, 0]; // of members that are neither cut nor folded
  const FLAT = [[-1, 0], [1, 0]]; // in the plane
  const RECTANGLE = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
  const circle = (count) => Array.from({ length: count }, (_, c) =>
    [Math.cos((2 * c * Math.PI) / count), Math.sin((2 * c * Math.PI) / count)]);

  const SECTIONS = new Map([FLAT, RECTANGLE, circle(ROUGH), circle(ROUND)]
    .map((around) => [around.length, around]));

  /**
   * How many stations and corners each member has, where its own begin, along which axis thin
   * ones are wide, which are round, and whether those are to look smooth.
   */
  function layout({ members, planar, segments }) {
    const bends = PageData.array(members.bends);
    const round = PageData.array(members.round).map((each) => each && !planar);
    const count = bends.length;
    const smooth = count <= MANY && round.includes(1);
    const stations = new Int32Array(count);
    const corners = new Int32Array(count);
    const station = new Int32Array(count + 1);
    const vertex = new Int32Array(count + 1);
    const wide = new Uint8Array(count);
    const section = PageData.array(members.section);
    for (let m = 0; m < count; m++) {
      stations[m] = bends[m] ? segments + 1 : 2;
      corners[m] = (planar ? FLAT : RECTANGLE).length;
      if (round[m]) corners[m] = smooth && section[2 * m] > THICK ? ROUND : ROUGH;
      wide[m] = widthOf(section[2 * m], section[2 * m + 1]);
      station[m + 1] = station[m] + stations[m];
      vertex[m + 1] = vertex[m] + stations[m] * corners[m];
    }
    const joined = PageData.array(members.joined);
    // Of what is cut or folded: its row of the profiles, which have four numbers a station.
    const neck = new Map(members.necks.map((m, i) => [m, 4 * i * (segments + 1)]));
    return { neck, count, segments, stations, corners, station, vertex, wide, round, smooth, joined };
  }

  /** The local axis along which a thin section is wide: 1 or 2; 0 of others. */
  function widthOf(height, width) {
    if (width > THIN * height) return 2;
    return height > THIN * width ? 1 : 0;
  }

  /**
   * Room for what `compute` finds: of each station its frame, of each corner a place, and where round members look smooth the normals of their sides.
   */
  function room(plan) {
    return {
      frame: new Float32Array(9 * plan.station[plan.count]),
      corner: new Float32Array(3 * plan.vertex[plan.count]),
      normal: new Float32Array(plan.smooth ? 3 * plan.vertex[plan.count] : 0),
    };
  }

  /** The corners of all members in a state of the tracks. */
  function compute(members, plan, { centre, section: turns }, out) {
    const section = PageData.array(members.section);
    const { corner, normal, frame } = out, profile = PageData.array(members.profile);
    let at = 0, turn = 0;
    for (let m = 0; m < plan.count; m++) {
      const around = SECTIONS.get(plan.corners[m]);
      const neck = plan.neck.get(m);
      const straight = plan.stations[m] === 2;
      for (let s = plan.station[m]; s < plan.station[m + 1]; s++) {
        // Both ends of a straight member have one cross-section.
        if (!straight || s === plan.station[m]) turn += 4;
        const f = 9 * s;
        frameOf(turns, turn - 4, frame, f);
        const p = neck === undefined ? -1 : neck + 4 * (s - plan.station[m]);
        const [high, wide, up, aside] = p < 0 ? PLAIN : profile.subarray(p, p + 4);
        const height = high * section[2 * m] / 2, width = wide * section[2 * m + 1] / 2;
        for (const [y, z] of around) {
          for (let k = 0; k < 3; k++, at++) {
            const ey = frame[f + 3 + k], ez = frame[f + 6 + k];
            corner[at] = centre[3 * s + k] + (height * y + up) * ey + (width * z + aside) * ez;
            if (plan.smooth) normal[at] = y * ey + z * ez;
          }
        }
      }
    }
    out.centre = centre;
  }

  /** Write the frame [ex, ey, ez] of a quaternion of any length to out[o..]. */
  function frameOf(q, i, out, o) {
    const size = Math.hypot(q[i], q[i + 1], q[i + 2], q[i + 3]);
    const w = q[i] / size, x = q[i + 1] / size, y = q[i + 2] / size, z = q[i + 3] / size;
    out[o] = 1 - 2 * (y * y + z * z);
    out[o + 1] = 2 * (x * y + w * z);
    out[o + 2] = 2 * (x * z - w * y);
    out[o + 3] = 2 * (x * y - w * z);
    out[o + 4] = 1 - 2 * (x * x + z * z);
    out[o + 5] = 2 * (y * z + w * x);
    out[o + 6] = 2 * (x * z + w * y);
    out[o + 7] = 2 * (y * z - w * x);
    out[o + 8] = 1 - 2 * (x * x + y * y);
  }

  return { layout, room, compute };
})();
