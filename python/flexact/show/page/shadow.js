// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// A soft shadow where one thing is close behind another: as much as nearer things stand round a
// pixel, told by their depths. It lies over the frame that was drawn, in light and dark alike.

const Shadow = (() => {
  const REACH = 0.03; // of the shadow, in sizes of the drawing
  const DARKEST = 0.45;
  const CASTS = 1; // layer of what casts it, and on which it falls

  const VERTEX = "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0., 1.); }";
  const FRAGMENT = `
    #define PAIRS 18
    varying vec2 at;
    uniform sampler2D depth;
    uniform float reach; // in pixels
    uniform float deep, most; // depths of the reach, and how dark
    void main() {
      ivec2 here = ivec2(at * vec2(textureSize(depth, 0)));
      float own = texelFetch(depth, here, 0).r, sum = 0.;
      if (own >= 1.) discard;
      for (int k = 0; k < PAIRS; k++) {
        float angle = 2.39996 * float(k), far = sqrt((float(k) + .5) / float(PAIRS));
        ivec2 way = ivec2(far * reach * vec2(cos(angle), sin(angle)) + 64.5) - 64;
        // On both sides, so that a slope is in its own shadow nowhere.
        float one = own - texelFetch(depth, here + way, 0).r;
        float two = own - texelFetch(depth, here - way, 0).r;
        float share = (max(one, -4. * deep) + max(two, -4. * deep)) / deep;
        sum += smoothstep(.1, .6, share) * (1. - smoothstep(1.5, 4., share));
      }
      gl_FragColor = vec4(0., 0., 0., most * sum / float(PAIRS));
    }`;

  class Shadow {
    constructor() {
      this.target = new THREE.WebGLRenderTarget(1, 1);
      this.target.depthTexture = new THREE.DepthTexture(1, 1);
      this.material = new THREE.ShaderMaterial({
        vertexShader: VERTEX, fragmentShader: FRAGMENT,
        transparent: true, depthTest: false, depthWrite: false,
        uniforms: {
          depth: { value: this.target.depthTexture }, reach: { value: 0 },
          deep: { value: 0 }, most: { value: DARKEST },
        },
      });
      const plane = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), this.material);
      plane.frustumCulled = false;
      this.over = new THREE.Scene();
      this.over.add(plane);
    }

    /** Have some objects cast it. */
    static cast(...objects) {
      for (const each of objects) each.traverse(({ layers }) => layers.enable(CASTS));
    }

    /** Draw it over the frame. */
    draw({ renderer, scene, camera, width, height }) {
      const ratio = renderer.getPixelRatio(), { reach, deep } = this.material.uniforms;
      this.target.setSize(Math.ceil(ratio * width), Math.ceil(ratio * height));
      reach.value = REACH * camera.zoom * ratio * height;
      deep.value = REACH / (camera.far - camera.near);
      camera.layers.set(CASTS);
      renderer.setRenderTarget(this.target);
      renderer.render(scene, camera);
      renderer.setRenderTarget(null);
      camera.layers.set(0);
      renderer.autoClear = false;
      renderer.render(this.over, camera);
      renderer.autoClear = true;
    }

    dispose() {
      this.target.dispose();
      this.material.dispose();
    }
  }

  return { Shadow };
})();
