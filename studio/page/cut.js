// The cut screen: other angles for the stone with its meets kept, by hand or optimised, and graded.

class CutScreen {
  constructor(studio) {
    this.studio = studio;
    this.view = new StoneView(by_id("tried-views"), () => {});
    const on = (id, act) => by_id(id).addEventListener("click", act);
    on("cut-undo", () => this.change("undo"));
    on("cut-redo", () => this.change("redo"));
    on("cut-restart", () => this.change("restart"));
    on("cut-grade", () => this.change("grade"));
    on("cut-keep", () => this.keep());
    on("cut-stop", () => call("/api/cut/stop", {}));
    by_id("cut-recut").addEventListener("change", () => this.show_wishes());
    by_id("cut-wishes").addEventListener("submit", (event) => {
      event.preventDefault();
      this.change("optimise", {objective: by_id("cut-objective").value, recut: by_id("cut-recut").checked, most_loss: Number(by_id("cut-loss").value)});
    });
    this.show_wishes();
  }

  async show() {
    const cut = await call("/api/cut");
    if (cut) this.draw(cut);
    by_id("cut-body").hidden = !cut;
  }

  async change(what, more = {}) {
    const cut = await call(`/api/cut/${what}`, {opened: this.cut.opened, at: this.cut.at, ...more});
    if (cut) this.draw(cut);
    else await this.show();
  }

  async keep() {
    await call("/api/cut/keep", {opened: this.cut.opened, at: this.cut.at});
  }

  show_wishes() { by_id("cut-loss-field").hidden = !by_id("cut-recut").checked; }

  draw(cut) {
    this.cut = cut;
    const names = cut.now.tiers.map((tier) => `${tier.name} ${tier.part}`).join("\n");
    if (this.names !== names) this.build(cut);
    this.names = names;
    // A cut may lose the stone's symmetry, which ties tiers.
    const before = (tier) => cut.start.tiers.find((one) => one.name === tier.name && one.part === tier.part) || tier;
    cut.now.tiers.forEach((tier, i) => this.rows[i].show(tier, before(tier)));
    this.draw_shown(cut.now);
    const history = (id, words) => {
      by_id(id).disabled = !words;
      by_id(id).title = words || "";
    };
    history("cut-undo", cut.undo);
    history("cut-redo", cut.redo);
    by_id("cut-last").textContent = cut.undo ? `Last: ${cut.undo}.` : "The stone as it is. Move a tier, or let the angles be optimised.";
    by_id("cut-restart").hidden = !cut.stale && !cut.undo && !cut.redo;
    by_id("cut-stale").hidden = !cut.stale;
    this.show_work(cut);
    by_id("cut-trouble").textContent = cut.trouble;
    by_id("grade-frame").hidden = !cut.graded;
    const graded = `${cut.opened}-${cut.graded_job}`;
    if (cut.graded && this.graded !== graded) by_id("grade-frame").src = `/grade?shown=${graded}`;
    if (cut.graded) this.graded = graded;
  }

  show_work(cut) {
    by_id("cut-work").hidden = !cut.runs;
    by_id("cut-progress").value = cut.fraction;
    this.began = cut.runs ? this.began || performance.now() : 0;
    for (const id of ["cut-optimise", "cut-grade"]) by_id(id).disabled = Boolean(cut.runs);
  }

  progress(fraction) {
    by_id("cut-progress").value = fraction;
    by_id("cut-left").textContent = time_left(this.began, fraction);
  }

  build(cut) {
    this.rows = cut.now.tiers.map((tier, i) => new TierRow(tier, (value, last) => this.turn(i, value, last), () => this.view.light(this.cut.now.tiers[i].facets)));
    by_id("cut-tiers").replaceChildren(...this.rows.map((row) => row.place));
  }

  /** One question at a time; where a slider stops, the cut is made. */
  async turn(tier, value, last) {
    this.wanted = {tier, value, last};
    if (this.asks) return;
    this.asks = true;
    while (this.wanted) {
      const {last, ...wanted} = this.wanted;
      this.wanted = null;
      if (last) { await this.change("change", wanted); continue; }
      const shown = await call("/api/cut/preview", {opened: this.cut.opened, at: this.cut.at, ...wanted});
      if (shown && !this.wanted) this.draw_shown(shown);
    }
    this.asks = false;
  }

  draw_shown(shown) {
    this.view.show(shown.drawings);
    const start = this.cut.start, percent = (value) => value.toFixed(1);
    const rows = shown.figures.map((figure, i) => [figure.words, start.figures[i].value, figure.value]);
    by_id("cut-figures").replaceChildren(...rows.map(([words, before, now]) => made("tr", {}, made("th", {scope: "row"}, words),
      made("td", {}, percent(before)), made("td", {}, made("b", {}, percent(now))), made("td", {}, Math.abs(now - before) < 0.05 ? "" : signed(now - before, 1)))));
    by_id("cut-volume").textContent = `Weight: ${signed(100 * (shown.volume / start.volume - 1), 2)} %. ${shown.note}.`;
  }
}

const signed = (value, digits) => (value < 0 ? "\u2212" : "+") + Math.abs(value).toFixed(digits);

/** A tier's slider and number. */
class TierRow {
  /** `turn(value, last)`: it is moved, or was chosen; `enter`: it has the focus. */
  constructor(tier, turn, enter) {
    this.was = made("span", {class: "note"});
    const label = `${tier.name}, ${tier.part}, ${tier.unit}`;
    this.slider = made("input", {type: "range", step: 0.05, "aria-label": `${label}: slider`});
    this.number = made("input", {type: "number", step: 0.05, "aria-label": label});
    const moved = () => Number(this.slider.value);
    this.slider.addEventListener("input", () => { this.number.value = moved().toFixed(2); turn(moved(), false); });
    this.slider.addEventListener("change", () => turn(moved(), true));
    this.number.addEventListener("change", () => this.number.value !== "" && turn(Number(this.number.value), true));
    this.place = made("div", {class: "field", onfocusin: enter}, made("span", {}, made("b", {}, tier.name), tier.part ? ` ${tier.part} ` : ", % ", this.was), this.slider, this.number);
  }

  show(tier, start) {
    const widest = tier.part ? 8 : start.value / 2;
    this.slider.min = Math.max(Math.min(start.value, tier.value) - widest, 0.5).toFixed(2);
    this.slider.max = Math.min(Math.max(start.value, tier.value) + widest, 89).toFixed(2);
    this.slider.value = tier.value;
    this.number.value = tier.value.toFixed(2);
    this.was.textContent = Math.abs(tier.value - start.value) < 0.005 ? "" : `was ${start.value.toFixed(2)}`;
  }
}
