"use strict";
// The buttons, the divider and the dropping of files on the stage.

Object.assign(Page.prototype, {
  wire_stage() {
    this.hand = new Hand(this, by_id("hand"));
    for (const one of document.querySelectorAll("[data-view]"))
      one.addEventListener("click", () => this.ready() && this.motion.look(one.dataset.view));
    by_id("help-button").addEventListener("click", () => this.keys.help());
    by_id("full-button").addEventListener("click", () => this.full_screen());
    by_id("trouble-close").addEventListener("click", () => {
      by_id("trouble").hidden = true;
    });
    by_id("theme-button").addEventListener("click", () => {
      const root = document.documentElement;
      const dark = root.dataset.theme ? root.dataset.theme === "dark"
                                      : matchMedia("(prefers-color-scheme: dark)").matches;
      root.dataset.theme = dark ? "light" : "dark";
    });
    by_id("panel-button").addEventListener("click", () => {
      const closed = by_id("app").classList.toggle("panel-closed");
      by_id("panel-button").setAttribute("aria-expanded", String(!closed));
    });
    this.wire_divider(by_id("divider"));
    this.wire_drop();
    new ResizeObserver(() => {
      if (!this.ready()) return;
      this.fit_stage();
      this.overlay.draw();
      this.loop.moved();
    }).observe(this.stage);
    addEventListener("hashchange", () => {
      if (!this.ready()) return;
      const before = this.state.get("item");
      this.restore_link();
      if (this.state.get("item") !== before) {
        this.info = null;
        this.show_item();
        this.open_engine().catch((error) => this.failed(error));
      }
    });
  },
  // On a low stage the names and buttons over it would cover the stone.
  fit_stage() {
    const {height} = this.stage.getBoundingClientRect();
    this.opened.free_height = height < 520 ? Math.max(0.5, 1 - 84 / Math.max(1, height)) : 1;
  },
  wire_divider(divider) {
    const to = (percent) => this.state.set({divider: Math.min(100, Math.max(0, percent))});
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
      if (!(event.buttons & 1)) return;
      const box = this.stage.getBoundingClientRect();
      to(100 * (event.clientX - box.left) / box.width);
    });
    divider.addEventListener("keydown", (event) => {
      const now = this.state.get("divider");
      const next = {
        ArrowLeft: now - 2,
        ArrowRight: now + 2,
        Home: 0,
        End: 100,
        PageUp: now - 10,
        PageDown: now + 10
      }[event.key];
      if (next === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      to(next);
    });
  },
  wire_drop() {
    const drop = by_id("drop");
    let depth = 0;
    const files = (event) => event.dataTransfer && [...event.dataTransfer.types].includes("Files");
    const seen = (by) => (event) => {
      if (!files(event)) return;
      event.preventDefault();
      depth += by;
      drop.hidden = depth <= 0;
    };
    addEventListener("dragenter", seen(1));
    addEventListener("dragleave", seen(-1));
    addEventListener("dragover", (event) => {
      if (files(event)) event.preventDefault();
    });
    addEventListener("drop", (event) => {
      if (!files(event)) return;
      event.preventDefault();
      depth = 0;
      drop.hidden = true;
      if (event.dataTransfer.files[0]) this.take_file(event.dataTransfer.files[0]);
    });
  },
});
