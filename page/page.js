"use strict";
// Without this script the page still shows everything. The script only moves the dividers and
// repeats a facet's title in a line that touch screens can show.
for (const slider of document.querySelectorAll(".slider")) {
  const control = slider.querySelector("input");
  const pictures = slider.querySelector(".slider-pictures");
  const move = (percent) => slider.style.setProperty("--cut", percent + "%");
  control.addEventListener("input", () => move(control.value));
  const follow = (event) => {
    const box = pictures.getBoundingClientRect();
    const percent = Math.round(Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width)));
    control.value = percent;
    move(percent);
  };
  pictures.addEventListener("pointerdown", (event) => {
    pictures.setPointerCapture(event.pointerId);
    follow(event);
  });
  pictures.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) follow(event);
  });
  pictures.addEventListener("dragstart", (event) => event.preventDefault());
  // Up and down scroll the page; a sideways drag on a touch screen moves the divider.
  pictures.style.touchAction = "pan-y";
  pictures.style.cursor = "ew-resize";
  move(control.value);
  // Shows both in turn in the same place, so that differences jump. Twice a second is slow enough
  // for people whom flicker harms (WCAG 2.3.1 allows three).
  const blink = slider.querySelector(".blink");
  if (!blink) continue;
  let timer = 0;
  blink.hidden = false;
  blink.addEventListener("click", () => {
    const on = !timer;
    clearInterval(timer);
    timer = on ? setInterval(() => slider.classList.toggle("first"), 500) : 0;
    slider.classList.toggle("blinking", on);
    blink.setAttribute("aria-pressed", on);
  });
}
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
