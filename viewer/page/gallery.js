"use strict";
// The stones of a page that has several: a strip of small pictures with arrow keys.

class Gallery {
  constructor(page, nav) {
    this.page = page;
    this.nav = nav;
    this.items = page.document.items;
    this.build();
  }

  build() {
    if (this.items.length < 2) return;
    this.nav.hidden = false;
    this.buttons = this.items.map((item, index) => {
      const one = button("", () => this.go(index), {class: "thumb"});
      // Only pictures inside the page; anything else could be a foreign address.
      if (/^data:image\/(png|jpeg|webp);/.test(item.picture || ""))
        one.append(element("img", {src: item.picture, alt: "", loading: "lazy"}));
      one.append(element("span", {}, stone_title(item.name)));
      return one;
    });
    this.list = element("div", {class: "thumbs"}, ...this.buttons);
    this.nav.replaceChildren(
      button("\u2039", () => this.step(-1),
        {class: "step", "aria-label": "Stone before (Page up)", title: "Stone before (Page up)"}),
      this.list,
      button("\u203a", () => this.step(1),
        {class: "step", "aria-label": "Next stone (Page down)", title: "Next stone (Page down)"}));
    this.list.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1}[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      this.step(step);
      this.buttons[this.page.state.get("item")].focus();
    });
  }

  step(by) {
    if (this.items.length < 2) return;
    this.go((this.page.state.get("item") + by + this.items.length) % this.items.length);
  }
  go(index) {
    if (index !== this.page.state.get("item")) this.page.open_item(index);
  }
  // Of a stone that was dropped.
  take_picture(canvas) {
    this.page.item().picture = canvas.toDataURL("image/jpeg");
    this.build();
    this.update();
  }
  update() {
    if (!this.buttons) return;
    const now = this.page.state.get("item");
    this.buttons.forEach((one, index) => {
      one.setAttribute("aria-current", String(index === now));
      one.tabIndex = index === now ? 0 : -1;
    });
    const chosen = this.buttons[now];
    this.list.scrollTo(
      {left: chosen.offsetLeft - this.list.clientWidth / 2 + chosen.clientWidth / 2});
  }
}
