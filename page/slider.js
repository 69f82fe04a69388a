// Also in the page of the studio.
/** Two pictures of one size under a divider (page/parts.h, slider). */
function move_divider(slider) {
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
  if (!blink) return;
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
