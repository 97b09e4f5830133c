"use strict";
// The shapes of members from a pose of the nodes: cubic curves and the corners of sections
// along them, as flexact.scene.shapes and flexact.scene.solids have them.

const Shapes = (() => {
  const MANY = 400; // members; more of them get fewer corners
  const FINE = 16, COARSE = 8; // pieces of bent members
  const ROUND = 24, ROUGH = 8; // corners of round sections: of thick ones, and of others
  const THICK = 0.015; // from this part of the scene's size
  const THIN = 6; // a section so many times as wide as it is high looks flat
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
  function layout(members, planar) {
    const bends = SceneData.array(members.bends);
    const round = SceneData.array(members.round).map((each) => each && !planar);
    const count = bends.length;
    const smooth = count <= MANY && round.includes(1);
    const segments = bends.reduce((sum, each) => sum + each, 0) > MANY ? COARSE : FINE;
    const stations = new Int32Array(count);
    const corners = new Int32Array(count);
    const station = new Int32Array(count + 1);
    const vertex = new Int32Array(count + 1);
    const wide = new Uint8Array(count);
    const section = SceneData.array(members.section);
    for (let m = 0; m < count; m++) {
      stations[m] = bends[m] ? segments + 1 : 2;
      corners[m] = (planar ? FLAT : RECTANGLE).length;
      if (round[m]) corners[m] = smooth && section[2 * m] > THICK ? ROUND : ROUGH;
      wide[m] = widthOf(section[2 * m], section[2 * m + 1]);
      station[m + 1] = station[m] + stations[m];
      vertex[m + 1] = vertex[m] + stations[m] * corners[m];
    }
    return { count, segments, stations, corners, station, vertex, wide, round, smooth };
  }

  /** The local axis along which a thin section is wide: 1 or 2; 0 of others. */
  function widthOf(height, width) {
    if (width > THIN * height) return 2;
    return height > THIN * width ? 1 : 0;
  }

  /**
   * Room for what `compute` finds: of each station its centre and frame, of each corner a place,
   * and where round members look smooth the normals of their sides.
   */
  function room(plan) {
    return {
      centre: new Float32Array(3 * plan.station[plan.count]),
      frame: new Float32Array(9 * plan.station[plan.count]),
      corner: new Float32Array(3 * plan.vertex[plan.count]),
      normal: new Float32Array(plan.smooth ? 3 * plan.vertex[plan.count] : 0),
    };
  }

  const start = new Float64Array(9), end = new Float64Array(9), frame = new Float64Array(9);
  const turns = new Float64Array(12);
  const centre = new Float64Array(3), tangent = new Float64Array(3);

  /** The shapes of all members in a pose. */
  function compute(members, plan, pose, out) {
    const arrays = {
      nodes: SceneData.array(members.nodes),
      frame: SceneData.array(members.frame),
      length: SceneData.array(members.length),
      section: SceneData.array(members.section),
      stiff: SceneData.array(members.stiff),
      bends: SceneData.array(members.bends),
    };
    for (let m = 0; m < plan.count; m++) {
      if (arrays.bends[m]) bent(arrays, plan, pose, out, m);
      else straight(arrays, plan, pose, out, m);
    }
  }

  /** The reference frame of a member turned with a node, as a quaternion at turns[at..]. */
  function turned(arrays, pose, m, node, at) {
    for (let k = 0; k < 4; k++) turns[at + k] = arrays.frame[4 * m + k];
    if (node >= 0) Rotations.multiply(pose.rotation, 4 * node, turns, at, turns, at);
  }

  function bent(arrays, plan, pose, out, m) {
    const [p, op, q, oq] = arrays.nodes.subarray(4 * m, 4 * m + 4);
    const length = arrays.length[m];
    turned(arrays, pose, m, op, 0);
    turned(arrays, pose, m, oq, 4);
    Rotations.frameOf(turns, 0, start);
    Rotations.frameOf(turns, 4, end);
    const last = plan.stations[m] - 1;
    for (let s = 0; s <= last; s++) {
      const t = s / last, t2 = t * t, t3 = t2 * t;
      for (let k = 0; k < 3; k++) {
        const a = pose.position[3 * p + k], b = pose.position[3 * q + k];
        const u = length * start[k], v = length * end[k];
        centre[k] = (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * u
          + (3 * t2 - 2 * t3) * b + (t3 - t2) * v;
        tangent[k] = 6 * (t2 - t) * (a - b) + (3 * t2 - 4 * t + 1) * u + (3 * t2 - 2 * t) * v;
      }
      Rotations.between(turns, 0, turns, 4, t, turns, 8);
      Rotations.frameOf(turns, 8, frame);
      Rotations.align(frame, tangent[0], tangent[1], tangent[2]);
      place(arrays, plan, out, m, s);
    }
  }

  function straight(arrays, plan, pose, out, m) {
    const [p, op, q] = arrays.nodes.subarray(4 * m, 4 * m + 3);
    turned(arrays, pose, m, op, 0);
    Rotations.frameOf(turns, 0, frame);
    for (let k = 0; k < 3; k++) tangent[k] = pose.position[3 * q + k] - pose.position[3 * p + k];
    const stiff = arrays.stiff[m];
    // A rigid body keeps its own direction, and every stiff member its length.
    if (!stiff || op < 0) Rotations.align(frame, tangent[0], tangent[1], tangent[2]);
    const stretch = stiff ? arrays.length[m] : Math.hypot(tangent[0], tangent[1], tangent[2]);
    for (let s = 0; s < 2; s++) {
      for (let k = 0; k < 3; k++) {
        centre[k] = (pose.position[3 * p + k] + pose.position[3 * q + k]) / 2
          + (s - 0.5) * stretch * frame[k];
      }
      place(arrays, plan, out, m, s);
    }
  }

  /** Store the centre and the frame of a station, and the corners of the section round it. */
  function place(arrays, plan, out, m, s) {
    const station = plan.station[m] + s;
    out.centre.set(centre, 3 * station);
    out.frame.set(frame, 9 * station);
    const corners = plan.corners[m];
    const around = SECTIONS.get(corners);
    const height = arrays.section[2 * m] / 2, width = arrays.section[2 * m + 1] / 2;
    let at = 3 * (plan.vertex[m] + s * corners);
    for (let c = 0; c < corners; c++) {
      const y = around[c][0] * height, z = around[c][1] * width;
      for (let k = 0; k < 3; k++, at++) {
        out.corner[at] = centre[k] + y * frame[3 + k] + z * frame[6 + k];
        if (plan.smooth) out.normal[at] = around[c][0] * frame[3 + k] + around[c][1] * frame[6 + k];
      }
    }
  }

  return { layout, room, compute };
})();
