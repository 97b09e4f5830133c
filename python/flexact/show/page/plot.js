// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Two scores of all cards over each other, axes as chosen; each point leads to its card.

const Plot = (() => {
  const NARROW = 280, WIDE = 620, SHAPE = 0.62; // widths [px], and the height in parts of it
  const LEFT = 62, RIGHT = 14, TOP = 16, BOTTOM = 48;
  const RADIUS = 11; // of a number
  const ROOM = 0.08; // free beside the outermost points, in parts of the axis
  const DECADE = 8; // a ratio of values from which an axis is logarithmic
  const ROUNDS = 60; // by which numbers that lie over each other come apart
  let width = WIDE, height = SHAPE * WIDE; // of the drawing

  class Plot {
    /** Of the data of `cards`; `go(number)` leads to a card. */
    constructor(root, cards, go) {
      Object.assign(this, { cards, go });
      this.figure = root.querySelector(".plot");
      if (!this.figure) return;
      this.choices = Array.from(this.figure.querySelectorAll("select.axis"));
      this.known = JSON.parse(this.figure.querySelector(".axes").textContent).axes;
      this.figure.hidden = false;
      for (const each of this.choices) each.addEventListener("change", () => this.draw());
      new ResizeObserver(() => this.figure.clientWidth && this.draw()).observe(this.figure);
    }

    /** Keys of both axes. */
    axes() {
      return this.figure ? this.choices.map(({ value }) => value) : [];
    }

    choose(keys) {
      if (!this.figure || !keys) return;
      this.choices.forEach((each, k) => {
        if (this.known.some(({ key }) => key === keys[k])) each.value = keys[k];
      });
      this.draw();
    }

    draw() {
      if (!this.figure) return;
      width = Math.max(NARROW, Math.min(WIDE, this.figure.clientWidth));
      height = SHAPE * width + BOTTOM / 2;
      const [x, y] = this.choices.map(({ value }) => this.known.find(({ key }) => key === value));
      const points = this.cards
        .map((card) => ({ card, x: x.factor * Number(card.dataset[x.key]), y: y.factor * Number(card.dataset[y.key]) }))
        .filter((each) => Number.isFinite(each.x) && Number.isFinite(each.y));
      const across = scale(points.map((each) => each.x), LEFT, width - RIGHT);
      const up = scale(points.map((each) => each.y), height - BOTTOM, TOP);
      for (const each of points) {
        each.at = [across.place(each.x), up.place(each.y)];
        each.shown = [...each.at];
      }
      part(points);
      const svg = made("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "group",
        "aria-label": `${y.words} over ${x.words}` });
      svg.append(...grid(across, up), ...titles(x, y));
      // What is hidden lies below, the Pareto set above.
      const order = ({ card }) => 2 * !card.hidden + (card.dataset.best === "best");
      points.sort((a, b) => order(a) - order(b));
      for (const each of points) svg.append(this.point(each, x, y));
      this.figure.querySelector(".plotted").replaceChildren(svg);
    }

    point({ card, at, shown, x, y }, along, upwards) {
      const { number, name, best, held } = card.dataset;
      const link = made("a", { href: `#card-${number}`, class: `point-of ${best} ${held}` });
      if (card.hidden) link.setAttribute("class", "point-of away");
      const says = `${number} ${name}: ${along.words} ${told(x)} ${along.unit}, `
        + `${upwards.words} ${told(y)} ${upwards.unit}${best === "best" ? ", in the Pareto set" : ""}`;
      link.append(made("title", {}, says));
      if (Math.hypot(at[0] - shown[0], at[1] - shown[1]) > 2) {
        link.append(made("line", { class: "leader", x1: at[0], y1: at[1], x2: shown[0], y2: shown[1] }),
          made("circle", { class: "exactly", cx: at[0], cy: at[1], r: 2.5 }));
      }
      link.append(made("circle", { class: "disc", cx: shown[0], cy: shown[1], r: RADIUS }),
        made("text", { x: shown[0], y: shown[1] + 4, class: "middle small" }, number));
      link.setAttribute("aria-label", says);
      link.addEventListener("click", (event) => {
        event.preventDefault();
        event.stopPropagation();
        if (!card.hidden) this.go(number);
      });
      return link;
    }
  }

  /** An axis: where values are, and its ticks; logarithmic over more than a decade. */
  function scale(values, from, to) {
    let low = Math.min(...values), high = Math.max(...values);
    const isLog = low > 0 && high / low > DECADE;
    const way = isLog ? Math.log10 : (value) => value;
    if (!(high > low)) [low, high] = high ? [low - Math.abs(low) / 2, high + Math.abs(high) / 2] : [-1, 1];
    const room = ROOM * (way(high) - way(low));
    const [first, last] = [way(low) - room, way(high) + room];
    const place = (value) => from + ((way(value) - first) / (last - first)) * (to - from);
    const ticks = isLog ? decades(first, last) : steps(first, last);
    return { place, ticks };
  }

  function steps(first, last) {
    const rough = (last - first) / 4, ten = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((each) => each * ten).find((each) => each >= rough);
    const count = Math.floor(last / step) - Math.ceil(first / step) + 1;
    return Array.from({ length: count }, (_, k) => (Math.ceil(first / step) + k) * step);
  }

  function decades(first, last) {
    const parts = last - first < 2 ? [1, 2, 5] : last - first < 3 ? [1, 3] : [1], ticks = [];
    for (let k = Math.floor(first); k <= last; k++) ticks.push(...parts.map((each) => each * 10 ** k));
    return ticks.filter((each) => Math.log10(each) >= first && Math.log10(each) <= last);
  }

  /** Move numbers that lie over each other apart. */
  function part(points) {
    for (let round = 0; round < ROUNDS; round++) {
      points.forEach((one, k) => {
        for (const other of points.slice(k + 1)) {
          let dx = other.shown[0] - one.shown[0], dy = other.shown[1] - one.shown[1];
          const apart = Math.hypot(dx, dy), near = 2 * RADIUS + 1 - apart;
          if (near <= 0) continue;
          if (apart < 1e-6) [dx, dy] = [Math.cos(k), Math.sin(k)];
          const share = near / 2 / (Math.hypot(dx, dy) || 1);
          one.shown = inside(one.shown[0] - share * dx, one.shown[1] - share * dy);
          other.shown = inside(other.shown[0] + share * dx, other.shown[1] + share * dy);
        }
      });
    }
  }

  const inside = (x, y) => [Math.max(LEFT + RADIUS, Math.min(width - RADIUS, x)),
    Math.max(RADIUS, Math.min(height - BOTTOM - RADIUS, y))];

  function grid(across, up) {
    const right = width - RIGHT, foot = height - BOTTOM;
    return [
      ...across.ticks.flatMap((tick) => {
        const x = across.place(tick);
        return [made("line", { class: "grid", x1: x, x2: x, y1: TOP, y2: foot }),
          made("text", { x, y: foot + 18, class: "soft middle" }, told(tick))];
      }),
      ...up.ticks.flatMap((tick) => {
        const y = up.place(tick);
        return [made("line", { class: "grid", x1: LEFT, x2: right, y1: y, y2: y }),
          made("text", { x: LEFT - 8, y: y + 4, class: "soft end" }, told(tick))];
      }),
      made("line", { class: "axis", x1: LEFT, x2: right, y1: foot, y2: foot }),
      made("line", { class: "axis", x1: LEFT, x2: LEFT, y1: TOP, y2: foot }),
    ];
  }

  /** What the axes are, with arrows to where it is better. */
  function titles(x, y) {
    const words = ({ words: name, unit }) => `${name}${unit ? ` [${unit}]` : ""}`;
    const foot = height - 8, middle = (TOP + height - BOTTOM) / 2;
    return [
      made("text", { x: (LEFT + width - RIGHT) / 2, y: foot, class: "middle" },
        x.lower ? `\u2190 better: ${words(x)}` : `${words(x)}: better \u2192`),
      made("text", { x: 0, y: 0, class: "middle", transform: `translate(13 ${middle}) rotate(-90)` },
        y.lower ? `\u2190 better: ${words(y)}` : `${words(y)}: better \u2192`),
    ];
  }

  /** Three digits, without an exponent where a person would write none. */
  function told(value) {
    const short = Number(value.toPrecision(3));
    const text = Math.abs(short) < 1e-3 || Math.abs(short) >= 1e7 ? short.toExponential() : String(short);
    return short === 0 ? "0" : text.replace("-", "\u2212");
  }

  function made(kind, attributes, text) {
    const part_ = document.createElementNS("http://www.w3.org/2000/svg", kind);
    for (const [name, value] of Object.entries(attributes)) part_.setAttribute(name, value);
    if (text !== undefined) part_.textContent = text;
    return part_;
  }

  return { Plot };
})();
