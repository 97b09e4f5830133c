"use strict";
// The data of the scene as the page holds them, and arrays out of their packed form.
// Lengths are parts of the scene's size, measured from its centre.

const SceneData = (() => {
  const KINDS = { f4: Float32Array, i4: Int32Array, u1: Uint8Array };
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

  /** The data in a <script type="application/json">; null where the page has none. */
  function read(id) {
    const element = document.getElementById(id);
    return element ? JSON.parse(element.textContent) : null;
  }

  return { array, read };
})();
