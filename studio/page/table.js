// The table of readings: as a spreadsheet, each row bound to its facets.

class ReadingsSheet {
  /** `enter` is called with a row when the cursor comes to it. */
  constructor(enter) {
    this.enter = enter;
    this.body = by_id("sheet");
    this.table = null;
    this.fit = null;
    this.row = -1;
    this.last = Promise.resolve();
    this.body.addEventListener("focusin", (event) => this.on_focus(event.target));
    this.body.addEventListener("focusout", (event) => this.commit(event.target));
    this.body.addEventListener("keydown", (event) => this.on_key(event));
    this.body.addEventListener("paste", (event) => this.on_paste(event));
  }

  show(table) {
    if (this.table && table.opened === this.table.opened && table.revision < this.table.revision) return;
    const same = this.table && table.opened === this.table.opened && table.shape === this.table.shape && table.rows.length === this.table.rows.length;
    this.table = table;
    if (same) return this.fill();
    const typed = document.activeElement, place = this.place_of(typed);
    this.build();
    this.fill();
    if (!place) return;
    this.go_to(Math.min(place.row, table.rows.length), place.column);
    // What was being typed goes on in the new cell.
    if (typed.value !== typed.dataset.shown) Object.assign(document.activeElement, {value: typed.value, selectionStart: typed.value.length});
  }

  show_fit(fit) { this.fit = fit; this.fill(); }

  build() {
    by_id("sheet-columns").replaceChildren(made("tr", {}, made("th", {scope: "col"}, made("span", {class: "unseen"}, "row")),
      ...this.table.columns.map((name) => made("th", {scope: "col", class: "of-" + name}, name))));
    // One more, to write into.
    const count = this.table.rows.length + 1;
    this.builds = true;
    this.body.replaceChildren(...Array.from({length: count}, (_, r) => made("tr", {"data-row": r}, made("th", {scope: "row"}),
      ...this.table.columns.map((name) => made("td", {class: "of-" + name},
        made("input", {"data-column": name, "data-shown": "", autocomplete: "off", spellcheck: "false", inputmode: name === "value" || name === "sigma" ? "decimal" : null}))))));
    this.builds = false;
  }

  line(r) { return this.body.querySelector(`tr[data-row="${r}"]`); }

  cell(r, column) { return this.body.querySelector(`tr[data-row="${r}"] [data-column="${column}"]`); }

  text(r, column) {
    const row = this.table.rows[r];
    return row ? row.cells[this.table.columns.indexOf(column)] || "" : "";
  }

  words(r) { return `${this.text(r, "kind")} ${this.text(r, "of")}`.trim() || "new row"; }

  /** What is wrong in a row: the fit knows best, where other readings check this one. */
  flag(r) {
    const row = this.table.rows[r], known = row && this.fit_of(row);
    if (known && known.flag) return known.flag;
    const judged = known && known.checked && ["converged", "contradictory"].includes(this.fit.fit.status);
    return row && row.flag && (row.flag.refused || !judged) ? row.flag : null;
  }

  first_flagged() { return this.table.rows.findIndex((_, r) => this.flag(r)); }

  fit_of(row) {
    const fit = this.fit;
    if (!fit || fit.opened !== this.table.opened || fit.revision !== this.table.revision || !fit.fit || !fit.fit.rows) return null;
    return fit.fit.rows.find((one) => one.line === row.line) || {};
  }

  wanted_row() {
    const next = this.fit && this.fit.fit && this.fit.fit.next_reading;
    if (!next) return -1;
    return this.table.rows.findIndex((row, r) => !row.read && this.text(r, "kind").toLowerCase() === next.kind
      && (next.of.includes(this.text(r, "of")) || next.of.some((name) => row.facets.includes(name))));
  }

  fill() {
    if (!this.table) return;
    this.body.querySelectorAll(".why").forEach((line) => line.remove());
    const wanted = this.wanted_row();
    for (let r = 0; r <= this.table.rows.length; ++r) {
      const line = this.line(r), flag = this.flag(r);
      line.classList.toggle("flagged", !!flag);
      line.classList.toggle("wanted", r === wanted);
      const head = line.querySelector("th");
      head.replaceChildren(...this.head_of(r, r === wanted));
      for (const input of line.querySelectorAll("input")) {
        const column = input.dataset.column, text = this.text(r, column);
        // What a person is typing stays, and what could not be saved.
        if (input.value === input.dataset.shown) input.value = text;
        input.dataset.shown = text;
        input.classList.toggle("unsaved", input.value !== text && input !== document.activeElement);
        input.setAttribute("aria-label", `${column}, row ${r + 1}, ${this.words(r)}`);
        const here = flag && column === "value";
        here ? input.setAttribute("aria-invalid", "true") : input.removeAttribute("aria-invalid");
        here ? input.setAttribute("aria-describedby", "why-" + r) : input.removeAttribute("aria-describedby");
      }
      if (flag) line.after(this.why(r, flag));
    }
  }

  head_of(r, wanted) {
    const row = this.table.rows[r], known = row && this.fit_of(row), parts = [];
    if (known && known.off !== undefined) {
      const swatch = made("span", {class: "off", title: `${known.off.toFixed(1)} times its ± off`});
      swatch.style.background = residual_colour(known.off);
      parts.push(swatch);
    }
    if (wanted) parts.push(made("span", {title: "read this next"}, "▸ "), made("span", {class: "unseen"}, "read this next, "));
    parts.push(row ? String(r + 1) : "+");
    return parts;
  }

  why(r, flag) {
    const cell = made("td", {colspan: this.table.columns.length + 1, id: "why-" + r}, flag.what);
    if (flag.suggested) {
      cell.append(made("button", {type: "button", title: "Alt+Enter", onclick: () => this.accept(r)}, `Write ${flag.suggested}`));
    }
    return made("tr", {class: "why"}, cell);
  }

  async accept(r) {
    const flag = this.flag(r);
    if (!flag || !flag.suggested) return;
    this.go_to(r, "value");
    await this.post([{row: r, column: "value", text: flag.suggested}]);
  }

  place_of(element) {
    const line = element && element.closest && element.closest("#sheet tr[data-row]");
    return line && element.dataset.column ? {row: Number(line.dataset.row), column: element.dataset.column} : null;
  }

  go_to(r, column) {
    const input = this.cell(r, column);
    if (!input) return;
    input.focus();
    input.select();
  }

  /** The row that reads this facet, best by its inclination alone. */
  go_to_facet(name) {
    const cost = (row, r) => row.facets.length + (this.text(r, "kind") === "inclination" ? 0 : 1000);
    let best = -1;
    this.table.rows.forEach((row, r) => {
      if (row.facets.includes(name) && (best < 0 || cost(row, r) < cost(this.table.rows[best], best))) best = r;
    });
    if (best >= 0) this.go_to(best, "value");
    return best >= 0;
  }

  on_focus(input) {
    const place = this.place_of(input);
    if (!place) return;
    if (this.row >= 0 && this.line(this.row)) this.line(this.row).classList.remove("here");
    this.row = place.row;
    this.line(place.row).classList.add("here");
    this.enter(this.table.rows[place.row] || null);
  }

  async commit(input) {
    const place = this.place_of(input);
    if (!place || this.builds || input.value === input.dataset.shown) return;
    const text = input.value;
    input.dataset.shown = text;
    await this.post([{...place, text}]);
  }

  /** One change after the other, since each must know of the rows that the one before made. */
  change(path, body = {}) {
    this.last = this.last.then(async () => {
      const {opened, shape} = this.table, table = await call(path, {opened, shape, ...body});
      if (table) { this.show(table); studio.table_changed(); }
      return table;
    });
    return this.last;
  }

  async post(cells) {
    if (!await this.change("/api/cells", {cells})) return this.not_saved(cells);
    const flag = this.flag(cells[0].row);
    if (flag) say(`Row ${cells[0].row + 1}: ${flag.what}`);
  }

  /** What was typed stays, marked, and is tried again when its cell is left again. */
  async not_saved(cells) {
    for (const {row, column} of cells) {
      const input = this.cell(row, column);
      if (input) input.dataset.shown = this.text(row, column);
    }
    this.fill();
    const table = await call("/api/table");
    if (table) { this.show(table); studio.table_changed(); }
  }

  remove() {
    if (this.row >= 0 && this.table.rows[this.row]) this.change("/api/remove", {row: this.row});
  }

  on_key(event) {
    const input = event.target, place = this.place_of(input);
    if (!place) return;
    const columns = this.table.columns, at = columns.indexOf(place.column);
    const all = input.selectionStart === 0 && input.selectionEnd === input.value.length;
    const moves = {ArrowUp: [-1, 0], ArrowDown: [1, 0], Enter: [event.shiftKey ? -1 : 1, 0]};
    if (event.key === "ArrowLeft" && (all || input.selectionEnd === 0)) moves.ArrowLeft = [0, -1];
    if (event.key === "ArrowRight" && (all || input.selectionStart === input.value.length)) moves.ArrowRight = [0, 1];
    if (event.altKey && event.key === "Enter") {
      event.preventDefault();
      this.accept(place.row);
    } else if (event.key === "Escape") {
      input.value = input.dataset.shown;
    } else if (event.ctrlKey && event.key === "Delete") {
      event.preventDefault();
      this.remove();
    } else if (moves[event.key] && !event.ctrlKey && !event.altKey && !event.metaKey) {
      event.preventDefault();
      const [down, right] = moves[event.key];
      const column = columns[Math.min(Math.max(at + right, 0), columns.length - 1)];
      const go = () => this.go_to(place.row + down, column);
      // Writing in the last row makes the next one.
      this.cell(place.row + down, column) ? go() : this.commit(input).then(go);
    }
  }

  on_paste(event) {
    const place = this.place_of(event.target);
    const text = event.clipboardData.getData("text/plain").replace(/\r\n?/g, "\n").replace(/\n$/, "");
    if (!place || !/[\n\t]/.test(text)) return;
    event.preventDefault();
    const first = this.table.columns.indexOf(place.column);
    let lines = text.split("\n").map((line) => line.split("\t"));
    // A copied header names the columns, and is no reading.
    if (lines[0].every((name, i) => name.trim().toLowerCase() === this.table.columns[first + i])) lines = lines.slice(1);
    const cells = lines.flatMap((line, down) => line.map((value, right) => ({row: place.row + down, column: this.table.columns[first + right], text: value.trim()})))
      .filter((cell) => cell.column);
    if (cells.length > 0) this.post(cells);
  }
}

/** The drawing's colours (page/colour_maps.cpp), roughly; the fit gives the sign of their order. */
function residual_colour(off) {
  const drawing = studio.fit && studio.fit.fit && studio.fit.fit.drawings;
  const stops = drawing ? drawing.residual.gradient.match(/#[0-9a-f]{6}/g) : [];
  return stops.length ? stops[Math.round(Math.min(off / 4, 1) * (stops.length - 1))] : "transparent";
}
