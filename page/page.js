"use strict";
// Without this script the page still shows everything. The script only moves the dividers and
// repeats a facet's title in a line that touch screens can show.
document.querySelectorAll(".slider").forEach(move_divider);
for (const drawings of document.querySelectorAll(".drawings")) {
  const line = drawings.querySelector(".facet-line");
  let chosen = null;
  const choose = (facet) => {
    if (chosen) chosen.classList.remove("chosen");
    chosen = facet;
    facet.classList.add("chosen");
    line.textContent = facet.getAttribute("aria-label");
  };
  for (const facet of drawings.querySelectorAll(".facet")) {
    facet.addEventListener("pointerenter", () => choose(facet));
    facet.addEventListener("click", () => choose(facet));
    facet.addEventListener("focus", () => choose(facet));
  }
}
// A stone of `culet spin` turns beside its photographs.
for (const player of document.querySelectorAll(".spin-player")) {
  const data = JSON.parse(player.querySelector(".spin-data").textContent);
  const [photograph, stone, control, play, lines, name] =
    [".spin-photograph", ".spin-stone", ".spin-turn", ".spin-play", ".spin-lines", ".spin-name"].map((c) => player.querySelector(c));
  for (const canvas of [photograph, stone]) {
    canvas.width = data.width;
    canvas.height = data.height;
  }
  const pictures = data.frames.map((frame) => Object.assign(new Image(), { src: frame.uri }));
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  // Where the three planes of a projection's rows meet is the eye: Cramer's rule.
  const eye_of = ([a, b, c]) => {
    const det = dot(a, cross(b, c));
    if (!det) return cross(b, a).map((x) => 1e6 * x);  // a distant camera
    return [0, 1, 2].map((i) => -(a[3] * cross(b, c)[i] + b[3] * cross(c, a)[i] + c[3] * cross(a, b)[i]) / det);
  };
  const place = (p, x) => {
    const [u, v, w] = p.map((row) => dot(row, x) + row[3]);
    return [u / w, v / w];
  };
  const polygon = (context, points) => {
    context.beginPath();
    for (const at of points) context.lineTo(...at);
    context.closePath();
  };
  const draw = () => {
    const frame = data.frames[control.value], eye = eye_of(frame.projection);
    const at = data.corners.map((corner) => place(frame.projection, corner));
    const facing = data.facets.filter(({ plane }) => dot(plane, eye) > plane[3]);
    const on_photograph = photograph.getContext("2d"), on_stone = stone.getContext("2d");
    const picture = pictures[control.value];
    if (picture.naturalWidth) on_photograph.drawImage(picture, 0, 0, data.width, data.height);
    on_stone.clearRect(0, 0, data.width, data.height);
    on_photograph.lineWidth = 1.4;
    const sides = new Map();
    for (const { corners, plane, seen } of facing) {
      const way = eye.map((e, i) => e - data.corners[corners[0]][i]);
      const bright = 90 + 150 * dot(plane, way) / Math.hypot(...way);
      polygon(on_stone, corners.map((c) => at[c]));
      on_stone.fillStyle = `rgb(${bright * 0.92}, ${bright * 0.97}, ${bright})`;
      on_stone.fill();
      on_stone.strokeStyle = "#30404f";
      on_stone.stroke();
      corners.forEach((corner, i) => {
        const next = corners[(i + 1) % corners.length], key = [corner, next].sort((a, b) => a - b).join();
        const side = sides.get(key) || { corner, next, facets: 0, seen: true };
        side.facets += 1;
        side.seen = side.seen && seen;
        sides.set(key, side);
      });
    }
    if (lines.checked) {
      for (const { corner, next, facets, seen } of sides.values()) {
        on_photograph.beginPath();
        on_photograph.moveTo(...at[corner]);
        on_photograph.lineTo(...at[next]);
        on_photograph.setLineDash(seen ? [] : [4, 4]);
        on_photograph.strokeStyle = facets === 1 ? "#e8590c" : "#1c7ed6";
        on_photograph.stroke();
      }
    }
    name.textContent = `${frame.name}: ${frame.note}`;
  };
  control.max = data.frames.length - 1;
  for (const part of [control, lines]) part.addEventListener("input", draw);
  pictures[0].addEventListener("load", draw);
  let timer = 0;
  play.addEventListener("click", () => {
    clearInterval(timer);
    timer = timer ? 0 : setInterval(() => {
      control.value = (Number(control.value) + 1) % data.frames.length;
      draw();
    }, 120);
    play.setAttribute("aria-pressed", timer !== 0);
  });
  draw();
}
// The viewer is a separate page inside this one, made when it is first opened.
const viewer = document.getElementById("viewer");
if (viewer) {
  let frame = null;
  const open_viewer = () => {
    if (!frame) {
      const page = JSON.parse(document.getElementById("culet-viewer").textContent);
      frame = document.createElement("iframe");
      frame.title = viewer.getAttribute("aria-label");
      frame.allow = "fullscreen";
      frame.src = URL.createObjectURL(new Blob([page], { type: "text/html" }));
      viewer.append(frame);
    }
    viewer.showModal();
    frame.focus();
  };
  for (const button of document.querySelectorAll(".turn-stone")) {
    button.hidden = false;
    button.addEventListener("click", open_viewer);
  }
  for (const picture of document.querySelectorAll(".turns img")) picture.addEventListener("click", open_viewer);
  viewer.querySelector(".viewer-close").addEventListener("click", () => viewer.close());
}
// Paper cannot be clicked, so print collapsed parts open. The date is added at printing because the
// file has none: the same input gives the same bytes.
const opened = [];
const printed = document.createElement("p");
printed.className = "printed note";
document.querySelector("main").prepend(printed);
addEventListener("beforeprint", () => {
  printed.textContent = `${document.title} · printed ` + new Date().toLocaleDateString(undefined, { dateStyle: "long" });
  for (const part of document.querySelectorAll("details:not([open])")) {
    part.open = true;
    opened.push(part);
  }
});
addEventListener("afterprint", () => {
  for (const part of opened.splice(0)) part.open = false;
});
