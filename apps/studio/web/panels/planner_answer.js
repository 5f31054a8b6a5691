// SPDX-License-Identifier: Apache-2.0
//
// What the planner's panel says of an answer.
import { secondsText } from "../measures.js";

const PASSAGE_NAMES = ["point", "line", "sheet"];
const MOST_PASSAGES = 30; // that are listed

// By the answer's status.
export const STATUS_SENTENCES = {
  path: ({ motions }) => (motions === "translation" ? "There is a path." : "There is a path, certified."),
  infeasible: ({ motions }) => (motions === "translation" ? "Proved: there is no path by translation." : "Proved: there is no path, however the robot turns."),
  invalid_start: ({ collision }) => `The start is not free: ${collision?.text ?? ""}`,
  invalid_goal: ({ collision }) => `The goal is not free: ${collision?.text ?? ""}`,
  free_space: () => "Give a start and a goal.",
  undecided: () => "Not decided: neither a path nor a proof was found.",
};

// Rows about the OMPL planner beside ours, if one was run.
export function fillOmpl(rows, { ompl, op_s: seconds }) {
  if (!ompl) return;
  const found = { path: "a path", infeasible: "a proof that there is none", none: "nothing in its time" }[ompl.status];
  const size = ompl.length !== undefined ? `, length ${Number(ompl.length.toPrecision(8))}` : ompl.waypoints ? `, ${ompl.waypoints} way-points` : "";
  rows.push([ompl.name, `${found}${size}, ${secondsText(ompl.seconds)} (ours ${secondsText(seconds)})`]);
}

const pointName = (point) => `(${point.map((x) => (x.length > 9 ? Number(Number(x.split("/")[0]) / Number(x.split("/")[1] ?? 1)).toPrecision(5) : x)).join(", ")})`;

// Tight passages by name; a click on one looks at it.
export function fillPassages(list, { tight, passages_used: used = [] }, viewer) {
  const all = tight ?? [];
  list.hidden = all.length === 0;
  const value = (x) => Number(x.split("/")[0]) / Number(x.split("/")[1] ?? 1);
  const items = all.slice(0, MOST_PASSAGES).map(({ dimension, cells }, i) => {
    const corners = cells.flatMap(({ vertices }) => vertices);
    const ends = dimension === 0 ? corners.slice(0, 1) : [corners[0], corners.at(-1)];
    const button = Object.assign(document.createElement("button"), { type: "button" });
    button.textContent = `${PASSAGE_NAMES[dimension]} ${i}: ${ends.map(pointName).join(" to ")}${used.includes(i) ? ", on the path" : ""}`;
    button.addEventListener("click", () => {
      const numbers = corners.map((corner) => corner.map(value));
      const middle = [0, 1, 2].map((k) => numbers.reduce((sum, corner) => sum + corner[k], 0) / numbers.length);
      const { control, page } = viewer;
      control.shift(middle.map((x, k) => x - page.center[k] - control.target.getComponent(k)));
    });
    const item = document.createElement("li");
    item.append(button);
    return item;
  });
  if (all.length > MOST_PASSAGES) items.push(Object.assign(document.createElement("li"), { textContent: `and ${all.length - MOST_PASSAGES} more` }));
  list.replaceChildren(...items);
}
