// The studio's page: which screen is shown, and what the program tells.

class StudioPage {
  constructor() {
    this.fit = null;
    this.drawings = null;
    this.screen = "";
  }

  start() {
    this.view = new StoneView(by_id("views"), (name) => this.choose(name));
    this.sheet = new ReadingsSheet((row) => this.enter(row));
    this.begin = new BeginScreen();
    this.bench = new BenchScreen();
    this.exports = new ExportScreen();
    this.cut = new CutScreen(this);
    this.photograph = new PhotographScreen();
    this.screens = {begin: this.begin, readings: null, stone: new StoneScreen(this), photograph: this.photograph, cut: this.cut, bench: this.bench, export: this.exports};
    addEventListener("hashchange", () => this.show_screen());
    const on = (id, act) => by_id(id).addEventListener("click", act);
    on("trouble-close", () => show_trouble(""));
    on("leave", () => call("/api/begin/leave", {}));
    on("undo", () => this.sheet.change("/api/undo"));
    on("redo", () => this.sheet.change("/api/redo"));
    on("remove-row", () => this.sheet.remove());
    on("cancel-fit", () => call("/api/fit/cancel", {}));
    on("take-other", () => this.sheet.change("/api/settle", {take_other: true}));
    on("keep-own", () => this.sheet.change("/api/settle", {take_other: false}));
    on("help-button", () => by_id("help").showModal());
    on("help-close", () => by_id("help").close());
    document.querySelectorAll("[name=paint]").forEach((radio) => radio.addEventListener("change", () => this.paint()));
    document.addEventListener("keydown", (event) => this.on_key(event));
    this.listen();
  }

  listen() {
    const events = new EventSource(`/api/events?window=${window_id}`);
    events.addEventListener("open", () => this.look());
    events.addEventListener("opened", () => this.look());
    events.addEventListener("table", (event) => { if (JSON.parse(event.data).by !== window_id) this.look_at_table(); });
    events.addEventListener("fit", () => this.look_at_fit());
    events.addEventListener("progress", (event) => { by_id("progress").value = JSON.parse(event.data).fraction; });
    events.addEventListener("cut", (event) => { if (this.screen === "cut" && JSON.parse(event.data).by !== window_id) this.cut.show(); });
    events.addEventListener("cut-progress", (event) => this.cut.progress(JSON.parse(event.data).fraction));
    events.addEventListener("bench", () => this.screen === "bench" && this.bench.show());
    events.addEventListener("photograph", (event) => this.screen === "photograph" && this.photograph.hear(JSON.parse(event.data)));
    events.addEventListener("file", (event) => this.exports.draw(JSON.parse(event.data)));
    events.addEventListener("error", () => show_trouble(events.readyState === EventSource.CLOSED
      ? "Five windows of the studio are open: close one of them, and load this one again." : "The studio does not answer; trying again. What was saved is safe."));
  }

  async look() {
    const state = await call("/api/state");
    if (!state) return;
    const reads = state.screen === "readings";
    this.is_open = reads;
    by_id("title").textContent = reads ? state.name : "culet studio";
    by_id("save-page").download = `${(state.name || "stone").replaceAll(/[^\w -]/g, "_")}.html`;
    document.title = reads ? `${state.name} · culet studio` : "culet studio";
    show_trouble("");
    if (!reads) this.opened = undefined;
    if (!reads) return this.show_screen();
    const fresh = this.opened !== state.opened;
    this.opened = state.opened;
    this.drawings = (await call("/api/drawings")) || this.drawings;
    this.show_screen();
    await this.look_at_table();
    await this.look_at_fit();
    if (fresh && this.screen === "readings") this.sheet.go_to(Math.max(this.sheet.table.rows.findIndex((row) => !row.read), 0), "value");
  }

  /** The one that the address names, of a stone that is open. */
  show_screen() {
    const named = location.hash.slice(2), known = named !== "begin" && Object.keys(this.screens).includes(named);
    this.screen = !this.is_open ? "begin" : known ? named : "readings";
    for (const screen of Object.keys(this.screens)) by_id(screen).hidden = screen !== this.screen;
    // A cell that is no longer seen takes no more keys.
    if (document.activeElement.closest("[hidden]")) document.activeElement.blur();
    by_id("screens").hidden = by_id("leave").hidden = !this.is_open;
    by_id("undo").hidden = by_id("redo").hidden = this.screen !== "readings";
    for (const link of by_id("screens").children) link.hash.slice(2) === this.screen ? link.setAttribute("aria-current", "page") : link.removeAttribute("aria-current");
    if (this.screens[this.screen]) this.screens[this.screen].show();
  }

  async look_at_table() {
    const table = await call("/api/table");
    if (!table) return;
    this.sheet.show(table);
    this.table_changed();
  }

  table_changed() {
    const table = this.sheet.table;
    by_id("undo").disabled = !table.undo;
    by_id("redo").disabled = !table.redo;
    by_id("outside").hidden = !table.outside;
    by_id("outside-file").textContent = table.file;
    const read = table.rows.filter((row) => row.read).length;
    by_id("sheet-note").textContent = `${read} of ${table.rows.length} rows have a value. Saved in ${table.folder}/${table.file}.`;
    if (table.trouble) show_trouble(table.trouble);
    this.show_next();
    this.wait_for_fit(read > 0 && !(this.fit && this.fit.revision === table.revision));
    if (read === 0) this.show_card(null);
  }

  wait_for_fit(waits) {
    clearTimeout(this.timer);
    by_id("card").classList.toggle("stale", waits);
    if (!waits) { by_id("work").hidden = true; return; }
    // A fit that is done at once shows no bar.
    this.timer = setTimeout(() => { by_id("progress").removeAttribute("value"); by_id("work").hidden = false; }, 700);
  }

  async look_at_fit() {
    const fit = await call("/api/fit");
    if (!fit || !this.sheet.table) return;
    this.fit = fit;
    this.sheet.show_fit(fit);
    this.wait_for_fit(fit.runs);
    this.show_card(fit.fit);
    this.paint();
    if (!fit.runs && ["bench", "stone", "photograph", "cut"].includes(this.screen)) this.screens[this.screen].show();
  }

  /** The one thing to do next: a marked row first, which the fit may not have seen yet. */
  show_next() {
    const fit = this.fit && this.fit.fit, sheet = this.sheet, r = sheet.first_flagged();
    const known = r >= 0 && sheet.fit_of(sheet.table.rows[r]);
    const look = r >= 0 && !(known && known.flag);
    by_id("next").textContent = look ? `look at row ${r + 1} again (F2): ${sheet.words(r)}.`
      : fit && fit.card_html ? fit.next || "nothing more is needed: the readings suffice." : "";
  }

  /** The verdict on the whole stone, and the findings. */
  show_card(fit) {
    const card = by_id("card");
    by_id("looks").replaceChildren();
    if (fit && fit.card_html) {
      // The program's own page parts, in which it escapes all texts.
      card.innerHTML = fit.card_html;
      by_id("looks").innerHTML = fit.look_html;
    } else {
      const word = fit && fit.trouble ? "No fit" : "No verdict yet";
      const text = fit && fit.trouble ? fit.trouble : "Write what you read into the column value.";
      card.replaceChildren(made("div", {class: "verdict none"}, made("span", {class: "symbol", "aria-hidden": "true"}, "?"),
        made("div", {}, made("p", {class: "word"}, word), made("p", {}, text))));
    }
    const wanted = fit && fit.next_reading ? fit.next_reading.of : [];
    this.view.want(wanted);
    this.show_next();
  }

  paint() {
    const chosen = document.querySelector("[name=paint]:checked").value;
    const fitted = this.fit && this.fit.fit && this.fit.fit.drawings;
    const drawing = fitted ? fitted[chosen] : this.drawings && this.drawings.mesh;
    if (!drawing) return;
    this.view.show(drawing);
    by_id("legend").replaceChildren(...legend_of(drawing));
    if (this.sheet.table) this.enter(this.sheet.table.rows[this.sheet.row] || null);
  }

  /** A row under the cursor lights its facets. */
  enter(row) {
    this.view.light(row ? row.facets : []);
    by_id("facet-line").textContent = row && row.facets.length ? row.facets.slice(0, 2).map((name) => this.view.about(name)).join(" · ") + (row.facets.length > 2 ? ` and ${row.facets.length - 2} more` : "") : "This row is about the whole stone.";
  }

  choose(name) {
    if (this.sheet.go_to_facet(name)) return;
    this.view.light([name]);
    by_id("facet-line").textContent = `${this.view.about(name)}. No row reads it.`;
  }

  on_key(event) {
    if (event.key === "F1") { event.preventDefault(); by_id("help").showModal(); return; }
    if (event.key === "F8" && this.is_open) {
      const links = [...by_id("screens").children], at = links.findIndex((link) => link.hasAttribute("aria-current"));
      location.hash = links[(at + 1) % links.length].hash;
    }
    if (this.screen === "bench" && !by_id("help").open) this.bench.on_key(event);
    if (this.screen === "photograph" && !by_id("help").open) this.photograph.on_key(event);
    if (this.screen !== "readings") return;
    const typing = this.sheet.place_of(document.activeElement) && document.activeElement.value !== document.activeElement.dataset.shown;
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && !typing && (key === "z" || key === "y")) {
      event.preventDefault();
      this.sheet.change(key === "y" || event.shiftKey ? "/api/redo" : "/api/undo");
    } else if (event.key === "F2") {
      const flagged = this.sheet.first_flagged();
      const next = flagged >= 0 ? flagged : this.sheet.wanted_row();
      if (next >= 0) this.sheet.go_to(next, "value");
    }
  }
}

const studio = new StudioPage();
studio.start();
