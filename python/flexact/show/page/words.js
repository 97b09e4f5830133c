// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// What is told of an element or a node: at the pointer, and to screen readers.

const Words = (() => {
  const AXES = ["x", "y", "z"];
  const unitOf = (data, quantity) => data.units[quantity].replace(" ", "\u00a0");

  /** A number in four digits, with a real minus sign. */
  function number(value) {
    const size = Math.abs(value);
    const text = size !== 0 && (size < 1e-3 || size >= 1e5)
      ? size.toExponential(2).replace("e", "\u202fe") : String(Number(size.toPrecision(4)));
    return (value < 0 ? "\u2212" : "") + text;
  }

  const element = ({ number: numbers, names, keyword }, row) => [
    `Element ${PageData.array(numbers)[row]}${names[row] ? ` \u201c${names[row]}\u201d` : ""}`,
    keyword[row],
  ];

  function quantities(data, values, ends) {
    return data.quantities.filter((each) => values[each]).map((each) => {
      const [p, q] = ends(PageData.array(values[each]));
      const one = Math.abs(p - q) <= 1e-6 * Math.max(Math.abs(p), Math.abs(q));
      const text = one ? number(p) : `${number(p)} at p, ${number(q)} at q`;
      return `${data.names[each]}: ${text} ${unitOf(data, each)}`;
    });
  }

  /** Lines about a member; `stress` is what colours it, or null. */
  function member(data, row, stress) {
    const [head, keyword] = element(data.members, row);
    const lines = [head, `${keyword}, ${data.forms[PageData.array(data.members.form)[row]]}`];
    if (!stress) return lines;
    const told = quantities(data, stress.members, (values) => [values[2 * row], values[2 * row + 1]]);
    return [...lines, ...(told.length ? told : ["no stress"])];
  }

  /** Lines about a body. */
  const body = ({ bodies }, row) =>
    [bodies.names[row], bodies.about ? bodies.about[row] : "rigid body"];

  function hinge(data, row, stress) {
    const told = stress ? quantities(data, stress.hinges, (values) => [values[row], values[row]]) : [];
    return [...element(data.hinges, row), ...told];
  }

  /** Lines about a node: what is held, and how far it is displaced in the present pose. */
  function node(data, index, pose, moving) {
    const lines = [`Node ${PageData.array(data.nodes.number)[index]}`];
    const held = data.nodes.held[index];
    if (held) lines.push(`held: ${held}`);
    const then = PageData.array(data.reference.position);
    const way = AXES.map((_, k) =>
      (pose.position[3 * index + k] - then[3 * index + k]) * data.size);
    if (moving) {
      const parts = AXES.slice(0, data.planar ? 2 : 3).map((axis, k) => `${axis} ${number(way[k])}`);
      lines.push(`drawn displaced: ${parts.join(", ")} m`);
    }
    return lines;
  }

  return { member, body, hinge, node, number, unitOf };
})();
