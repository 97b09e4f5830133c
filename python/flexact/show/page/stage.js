// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The canvas, the camera and its controls; draws a frame when something has changed, no more.

const Stage = (() => {
  const { OrthographicCamera, OrbitControls, Vector3 } = THREE;
  const DISTANCE = 8; // of the camera, in sizes of the drawing
  const EDGE = 16; // pixels left free round the drawing when it is fitted
  const CORNERS = Array.from({ length: 8 }, (_, i) => [i & 1, (i >> 1) & 1, (i >> 2) & 1]);
  // Milliseconds: frames that follow so soon are one run, and are slow if so long apart on average.
  const RUNNING = 60, LONG = 45, GAPS = 4, REST = 250;
  const SELDOM = 150; // ms between frames while the processor that draws is wanted elsewhere
  const GROUND = 0xd8d8dc; // what surfaces get of the light that look down
  const DIRECTIONS = { front: [0, -1, 0], top: [0, -1e-4, 1], right: [1, 0, 0] };

  class Stage {
    /** A stage on a canvas with its WebGL context, or on that which another stage has left. */
    constructor(canvas, context, { planar, iso }, before = null) {
      Object.assign(this, { canvas, planar, iso });
      this.ending = new AbortController(); // of what listens to the canvas
      this.peers = []; // stages that are seen from the same side
      this.apart = false; // of cards each has its own middle and size
      this.frames = 0; // drawn so far
      this.fitted = false; // and not been turned, moved or zoomed since
      this.swing = (look) => look(); // calls `look` in every pose that is to have room
      this.drawn = this.last = 0; // when a frame was drawn
      this.gaps = [];
      this.heavy = false; // whether there is something to leave out
      this.slow = this.light = this.dull = false; // dull: without shadows while something moves
      this.seldom = false;
      this.software = before ? before.software : isSoftware(context);
      this.lightened = () => {};
      this.after = []; // called behind each frame
      this.before = []; // and in front of it; those that return true want another frame
      this.scene = new THREE.Scene();
      this.camera = new OrthographicCamera(-1, 1, 1, -1, 0.01, 2 * DISTANCE);
      this.camera.up.set(0, planar ? 1 : 0, planar ? 0 : 1);
      this.renderer = before ? before.renderer
        : new THREE.WebGLRenderer({ canvas, context, alpha: true });
      // Colours as they are given, so that they agree with the legend.
      this.renderer.outputColorSpace = "srgb-linear";
      this.illuminate();
      this.shadow = planar ? null : new Shadow.Shadow();
      this.control();
      this.observer = new ResizeObserver(() => this.fill());
      this.observer.observe(canvas.parentElement);
      const { signal } = this.ending;
      canvas.addEventListener("webglcontextrestored", () => this.request(), { signal });
      this.fill();
    }

    illuminate() {
      const head = new THREE.DirectionalLight(0xffffff, 1.5);
      head.position.set(0.35, 0.6, 1);
      // From the sky, and less of it from the ground.
      const around = new THREE.HemisphereLight(0xffffff, this.planar ? 0xffffff : GROUND, this.planar ? 1.95 : 2.1);
      around.position.set(0, 0, 1);
      this.scene.add(around, this.camera);
      this.camera.add(head);
    }

    control() {
      const controls = new OrbitControls(this.camera, this.canvas);
      controls.zoomToCursor = true;
      controls.minZoom = 0.2;
      controls.maxZoom = 200;
      if (this.planar) {
        controls.enableRotate = false;
        controls.mouseButtons.LEFT = 2; // pan
        controls.touches.ONE = 1; // pan
      }
      controls.addEventListener("change", () => {
        this.fitted = false;
        if (!this.follows) this.lead();
        this.request();
      });
      this.controls = controls;
    }

    /** Fit the drawing to the room that the page gives. */
    fill() {
      const { clientWidth: width, clientHeight: height } = this.canvas;
      if (!width || !height) return;
      this.foot = this.canvas.parentElement.clientHeight - height; // for the axes and the scale
      this.width = width;
      this.height = height;
      this.setRatio();
      this.shape();
      this.refit();
      this.request();
    }

    /** Pixels drawn for one of the page; more at rest where edges are not smoothed otherwise. */
    setRatio() {
      const { antialias } = this.renderer.getContext().getContextAttributes();
      const ratio = Math.min(window.devicePixelRatio || 1, 2);
      const finer = !antialias && !this.light && !this.software;
      this.renderer.setPixelRatio(finer ? 2 : ratio);
      this.renderer.setSize(this.width, this.height, false);
    }

    shape() {
      const aspect = this.width / this.height;
      Object.assign(this.camera, { left: -aspect / 2, right: aspect / 2, top: 0.5, bottom: -0.5 });
      this.camera.updateProjectionMatrix();
    }

    /** Leave the canvas, and what draws on it, to another stage: programs are compiled already. */
    leave() {
      this.left = true;
      this.end();
    }

    /** Whether another stage may have it, which wants its edges smoothed or not. */
    canLeave(antialias) {
      const context = this.renderer.getContext();
      return !this.disposed && !context.isContextLost()
        && context.getContextAttributes().antialias === antialias;
    }

    end() {
      this.disposed = true;
      this.ending.abort();
      cancelAnimationFrame(this.waiting);
      clearTimeout(this.resting);
      clearTimeout(this.later);
      this.observer.disconnect();
      this.controls.dispose();
    }

    /** Free what the stage holds; it cannot be drawn on any more. */
    dispose() {
      if (!this.disposed) this.end();
      if (this.shadow) this.shadow.dispose();
      if (this.left) {
        this.scene.traverse((each) => {
          for (const held of [each.geometry, each.material, each.isInstancedMesh && each].flat()) {
            if (held) held.dispose();
          }
        });
        return;
      }
      this.renderer.dispose();
      this.renderer.forceContextLoss();
    }

    /** From where it is seen, as plain data. */
    looks() {
      this.settle();
      const { camera, controls, fitted } = this;
      const target = controls.target.toArray();
      return { eye: camera.position.toArray(), target, zoom: camera.zoom, fitted };
    }

    /** Be seen from there again; what was fitted is fitted. */
    lookAgain({ eye, target, zoom, fitted }) {
      this.camera.position.set(...eye);
      this.controls.target.set(...target);
      this.camera.zoom = zoom;
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.fitted = fitted;
      this.refit();
      this.lead();
      this.request();
    }

    /** Look along a named direction, and fit. */
    look(view) {
      const direction = this.planar ? [0, 0, 1] : DIRECTIONS[view] || this.iso;
      const towards = new Vector3(...direction).normalize();
      this.camera.position.copy(this.controls.target).addScaledVector(towards, DISTANCE);
      this.controls.update();
      this.fitted = true;
      this.refit();
    }

    /** Fit again what has changed before the next frame, unless somebody has chosen a view. */
    refit() {
      this.unfit = true;
      this.request();
    }

    /** Fit what waits for it: what has changed is looked at once, however much that is. */
    settle() {
      if (this.unfit && this.fitted) this.fit();
      this.unfit = false;
    }

    /** Centre what is drawn and fill the canvas with it, in every pose that it takes. */
    fit(leads = true) {
      this.camera.updateMatrixWorld();
      const axes = [0, 1, 2].map((k) => new Vector3().setFromMatrixColumn(this.camera.matrixWorld, k));
      const [low, high] = this.reach(axes);
      const [wide, tall] = [0, 1].map((k) => Math.max(1e-3, high[k] - low[k]));
      const free = [this.width - 2 * EDGE, this.height - 2 * EDGE];
      const room = free.map((each) => Math.max(each, 1));
      const { minZoom, maxZoom } = this.controls;
      const zoom = Math.min(room[0] / wide, room[1] / tall) / this.height;
      this.camera.zoom = Math.max(minZoom, Math.min(maxZoom, zoom));
      this.camera.updateProjectionMatrix();
      const middle = axes.reduce((sum, axis, k) =>
        sum.addScaledVector(axis, (low[k] + high[k]) / 2), new Vector3());
      this.follows = !leads;
      this.centre(...middle);
      this.follows = false;
      this.fitted = true;
      if (leads) this.lead();
    }

    /** Have the others seen from where this one is seen. */
    lead() {
      for (const each of this.peers) each.adopt(this);
    }

    adopt({ camera, controls, fitted }) {
      const { position, quaternion, zoom } = camera;
      if (this.apart) {
        const way = position.clone().sub(controls.target);
        this.camera.position.copy(this.controls.target).add(way);
        this.camera.quaternion.copy(quaternion);
        if (fitted) this.fit(false);
        this.request();
        return;
      }
      this.camera.position.copy(position);
      this.camera.quaternion.copy(quaternion);
      this.camera.zoom = zoom;
      this.camera.updateProjectionMatrix();
      this.controls.target.copy(controls.target);
      this.fitted = fitted;
      this.request();
    }

    /** Least and largest coordinates along three axes of all that is drawn, here and by peers. */
    reach(axes) {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      const take = (x, y, z) => axes.forEach((axis, k) => {
        const value = axis.x * x + axis.y * y + axis.z * z;
        low[k] = Math.min(low[k], value);
        high[k] = Math.max(high[k], value);
      });
      for (const { swing, scene } of this.apart ? [this] : [this, ...this.peers]) swing(() => eachPlace(scene, take));
      return low[0] <= high[0] ? [low, high] : [[0, 0, 0], [0, 0, 0]];
    }

    /** Bring a place into the middle without turning. */
    centre(x, y, z) {
      this.carry(new Vector3(x, y, z).sub(this.controls.target));
    }

    /** Move the eye and what it looks at. */
    carry(shift) {
      this.controls.target.add(shift);
      this.camera.position.add(shift);
      this.controls.update();
      this.request();
    }

    /** Turn by angles [rad] to the left and upwards; the plane is moved instead. */
    turn(left, up) {
      if (this.planar) return this.shift(left * 0.3, up * 0.3);
      const target = this.controls.target;
      const offset = this.camera.position.clone().sub(target);
      const flat = Math.hypot(offset.x, offset.y);
      const around = Math.atan2(offset.y, offset.x) - left;
      const limit = Math.PI / 2 - 1e-4;
      const height = Math.max(-limit, Math.min(limit, Math.atan2(offset.z, flat) + up));
      const reach = offset.length();
      this.camera.position.set(
        target.x + reach * Math.cos(height) * Math.cos(around),
        target.y + reach * Math.cos(height) * Math.sin(around),
        target.z + reach * Math.sin(height));
      this.controls.update();
      this.request();
    }

    /** Move the view by parts of its height. */
    shift(right, up) {
      const matrix = this.camera.matrix.elements;
      const size = 1 / this.camera.zoom;
      const shift = new Vector3(matrix[0], matrix[1], matrix[2]).multiplyScalar(right * size)
        .add(new Vector3(matrix[4], matrix[5], matrix[6]).multiplyScalar(up * size));
      this.carry(shift);
    }

    zoom(factor) {
      const { minZoom, maxZoom } = this.controls;
      this.camera.zoom = Math.max(minZoom, Math.min(maxZoom, this.camera.zoom * factor));
      this.fitted = false;
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.lead();
      this.request();
    }

    /** Where a place is on the canvas, in CSS pixels, and how far from the eye. */
    project(x, y, z) {
      const seen = new Vector3(x, y, z).project(this.camera);
      return [((seen.x + 1) / 2) * this.width, ((1 - seen.y) / 2) * this.height, seen.z];
    }

    /** The direction to the eye. */
    get towards() {
      return this.camera.position.clone().sub(this.controls.target).normalize().toArray();
    }

    /** Length of the drawing that a pixel shows. */
    get pixel() {
      return 1 / (this.camera.zoom * this.height);
    }

    /** Have a frame drawn soon; where frames take long, a light one until all is at rest. */
    request() {
      if (this.waiting || this.later || this.disposed) return;
      if (!this.seldom) return this.ask();
      this.later = setTimeout(() => {
        this.later = 0;
        this.ask();
      }, SELDOM);
    }

    ask() {
      const running = performance.now() - this.drawn < RUNNING;
      this.waiting = requestAnimationFrame((time) => {
        this.settle();
        this.waiting = 0;
        if (running) this.pace(time - this.last);
        this.last = time;
        let more = false;
        for (const step of this.before) more = step(time) || more;
        this.lighten(this.slow);
        // Where frames follow each other slowly shadows are drawn at rest.
        const dull = running && this.dull;
        this.draw(!dull);
        if (this.slow || dull) this.rest();
        if (more) this.request();
      });
    }

    /** Learn from the time [ms] between two frames of a run whether frames take long. */
    pace(gap) {
      this.gaps = [...this.gaps.slice(1 - GAPS), gap];
      const mean = this.gaps.reduce((sum, each) => sum + each, 0) / this.gaps.length;
      if (this.gaps.length < GAPS || mean <= LONG) return;
      this.slow = this.heavy;
      this.dull = true;
    }

    /** Draw in full as soon as nothing has moved for a while. */
    rest() {
      clearTimeout(this.resting);
      this.resting = setTimeout(() => {
        // What has been asked for meanwhile is not at rest.
        if (this.waiting) return;
        this.lighten(false);
        this.draw();
      }, REST);
    }

    lighten(on) {
      if (on === this.light) return;
      this.light = on;
      this.setRatio();
      this.lightened(on);
    }

    draw(shaded = true) {
      this.settle();
      this.frames += 1;
      this.drawn = performance.now();
      this.renderer.render(this.scene, this.camera);
      // A processor has no time for shadows.
      if (this.shadow && shaded && !this.light && !this.software) this.shadow.draw(this);
      for (const step of this.after) step();
    }
  }

  /** Call `take` with the corners of all that is visible; of copies, with those of their boxes. */
  function eachPlace(scene, take) {
    const done = new Set(); // many bodies share their corners
    scene.traverseVisible(({ isInstancedMesh, geometry, count, instanceMatrix }) => {
      if (isInstancedMesh) {
        geometry.computeBoundingBox();
        for (let i = 0; i < count; i++) eachCorner(geometry.boundingBox, instanceMatrix, i, take);
      } else if (geometry && !done.has(geometry.attributes.position)) {
        const { array } = geometry.attributes.position;
        done.add(geometry.attributes.position);
        for (let i = 0; i < array.length; i += 3) take(array[i], array[i + 1], array[i + 2]);
      }
    });
  }

  function eachCorner({ min, max }, { array }, i, take) {
    const copy = new THREE.Matrix4().fromArray(array, 16 * i);
    for (const [x, y, z] of CORNERS) {
      take(...new Vector3(x ? max.x : min.x, y ? max.y : min.y, z ? max.z : min.z)
        .applyMatrix4(copy));
    }
  }

  /** Whether the processor draws, for want of a graphics card. */
  function isSoftware(context) {
    let name = context.getParameter(context.RENDERER);
    const more = name === "WebKit WebGL" && context.getExtension("WEBGL_debug_renderer_info");
    if (more) name = context.getParameter(more.UNMASKED_RENDERER_WEBGL);
    return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  }

  return { Stage };
})();
