"use strict";
// Unit quaternions (w, x, y, z) and frames of three columns, in flat arrays.

const Rotations = (() => {
  /** out[o..] = a[i..] * b[j..]; out may be a or b. */
  function multiply(a, i, b, j, out, o) {
    const aw = a[i], ax = a[i + 1], ay = a[i + 2], az = a[i + 3];
    const bw = b[j], bx = b[j + 1], by = b[j + 2], bz = b[j + 3];
    out[o] = aw * bw - ax * bx - ay * by - az * bz;
    out[o + 1] = aw * bx + ax * bw + ay * bz - az * by;
    out[o + 2] = aw * by - ax * bz + ay * bw + az * bx;
    out[o + 3] = aw * bz + ax * by - ay * bx + az * bw;
  }

  /** The frame [ex, ey, ez] of a quaternion. */
  function frameOf(q, i, out) {
    const w = q[i], x = q[i + 1], y = q[i + 2], z = q[i + 3];
    out[0] = 1 - 2 * (y * y + z * z);
    out[1] = 2 * (x * y + w * z);
    out[2] = 2 * (x * z - w * y);
    out[3] = 2 * (x * y - w * z);
    out[4] = 1 - 2 * (x * x + z * z);
    out[5] = 2 * (y * z + w * x);
    out[6] = 2 * (x * z + w * y);
    out[7] = 2 * (y * z - w * x);
    out[8] = 1 - 2 * (x * x + y * y);
  }

  /** The quaternion at a share of the way from one to the other, along the shorter arc. */
  function between(a, i, b, j, share, out, o) {
    let cosine = a[i] * b[j] + a[i + 1] * b[j + 1] + a[i + 2] * b[j + 2] + a[i + 3] * b[j + 3];
    const sign = cosine < 0 ? -1 : 1;
    cosine = Math.min(1, cosine * sign);
    const angle = Math.acos(cosine);
    const sine = Math.sin(angle);
    // Below this the arc is straight to the last bit of single precision.
    const near = sine < 1e-5;
    const first = near ? 1 - share : Math.sin((1 - share) * angle) / sine;
    const second = sign * (near ? share : Math.sin(share * angle) / sine);
    let norm = 0;
    for (let k = 0; k < 4; k++) {
      const value = first * a[i + k] + second * b[j + k];
      out[o + k] = value;
      norm += value * value;
    }
    norm = Math.sqrt(norm);
    for (let k = 0; k < 4; k++) out[o + k] /= norm;
  }

  /** Turn a vector in place by a quaternion. */
  function turn(q, i, v, k) {
    const w = q[i], x = q[i + 1], y = q[i + 2], z = q[i + 3];
    const vx = v[k], vy = v[k + 1], vz = v[k + 2];
    const tx = 2 * (y * vz - z * vy), ty = 2 * (z * vx - x * vz), tz = 2 * (x * vy - y * vx);
    v[k] = vx + w * tx + y * tz - z * ty;
    v[k + 1] = vy + w * ty + z * tx - x * tz;
    v[k + 2] = vz + w * tz + x * ty - y * tx;
  }

  /** Turn a frame the shortest way so that ex lies along (x, y, z), which need not be a unit. */
  function align(frame, x, y, z) {
    const length = Math.hypot(x, y, z);
    if (!(length > 0)) return;
    x /= length; y /= length; z /= length;
    const cosine = frame[0] * x + frame[1] * y + frame[2] * z;
    if (cosine <= 1e-12 - 1) {
      for (let k = 0; k < 3; k++) { frame[k] *= -1; frame[6 + k] *= -1; }
      return;
    }
    const ax = frame[1] * z - frame[2] * y;
    const ay = frame[2] * x - frame[0] * z;
    const az = frame[0] * y - frame[1] * x;
    const part = 1 / (1 + cosine);
    for (let c = 3; c < 9; c += 3) {
      const vx = frame[c], vy = frame[c + 1], vz = frame[c + 2];
      const along = (ax * vx + ay * vy + az * vz) * part;
      frame[c] = cosine * vx + ay * vz - az * vy + along * ax;
      frame[c + 1] = cosine * vy + az * vx - ax * vz + along * ay;
      frame[c + 2] = cosine * vz + ax * vy - ay * vx + along * az;
    }
    frame[0] = x; frame[1] = y; frame[2] = z;
  }

  return { multiply, frameOf, between, turn, align };
})();
