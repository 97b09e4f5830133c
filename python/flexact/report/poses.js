"use strict";
// Where the nodes are in a movement, at any phase of its cycle from -1 to 1.

const Poses = (() => {
  /** A pose that is the reference: {position (3 a node), rotation (w, x, y, z a node)}. */
  function reference(data) {
    const position = Float64Array.from(SceneData.array(data.nodes.position));
    const rotation = new Float64Array((position.length / 3) * 4);
    for (let i = 0; i < rotation.length; i += 4) rotation[i] = 1;
    return { position, rotation };
  }

  /** Write the pose of a movement at a phase into `pose`, whose other nodes stay as they are. */
  function move(pose, movement, phase) {
    const last = movement.phases - 1;
    const place = Math.max(0, Math.min(last, ((phase + 1) / 2) * last));
    const before = Math.min(Math.floor(place), last - 1);
    const share = place - before;
    movePositions(pose, movement, before, share);
    moveRotations(pose, movement, before, share);
  }

  function movePositions(pose, movement, before, share) {
    const nodes = SceneData.array(movement.moved);
    const values = SceneData.array(movement.position);
    const first = before * nodes.length * 3;
    const second = first + nodes.length * 3;
    for (let i = 0; i < nodes.length; i++) {
      for (let k = 0; k < 3; k++) {
        const at = 3 * i + k;
        pose.position[3 * nodes[i] + k] =
          (1 - share) * values[first + at] + share * values[second + at];
      }
    }
  }

  function moveRotations(pose, movement, before, share) {
    const nodes = SceneData.array(movement.turned);
    const values = SceneData.array(movement.rotation);
    const first = before * nodes.length * 4;
    const second = first + nodes.length * 4;
    for (let i = 0; i < nodes.length; i++) {
      Rotations.between(
        values, first + 4 * i, values, second + 4 * i, share, pose.rotation, 4 * nodes[i]);
    }
  }

  return { reference, move };
})();
