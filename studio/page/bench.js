// The bench: the cutting sheet one step at a time, in letters to be read from the machine.

class BenchScreen {
  constructor() {
    this.view = new StoneView(by_id("bench-views"), (name) => this.go_to_facet(name));
    this.last = Promise.resolve();
    this.marks = 0;
    by_id("step-done").addEventListener("click", () => this.done());
    by_id("step-back").addEventListener("click", () => this.back());
    by_id("sheet-of").addEventListener("change", () => this.draw());
  }

  async show() {
    await this.last;
    const marks = this.marks, bench = await call("/api/bench");
    // Of what was marked meanwhile the program tells again.
    if (!bench || marks !== this.marks) return;
    if (!this.bench || bench.opened !== this.bench.opened) this.at = undefined;
    const before = this.at === undefined ? null : this.step();
    this.bench = bench;
    by_id("sheet-of").hidden = !bench.fitted;
    // Where another window went on, this one follows, unless somebody looks at a step on purpose.
    if (this.at === undefined || (before && !this.looks && this.step() && this.step().done)) this.at = this.first_open();
    this.view.show(studio.drawings.mesh);
    this.draw();
  }

  get of() { return this.bench.fitted ? document.querySelector("[name=sheet-of]:checked").value : "drawn"; }
  get steps() { return this.bench[this.of].steps; }
  /** Undefined: all steps are done. */
  step() { return this.steps[this.at]; }

  first_open() {
    const open = this.steps.findIndex((step) => !step.done);
    return open < 0 ? this.steps.length : open;
  }

  draw() {
    this.at = Math.min(this.at, this.steps.length);
    const step = this.step(), count = this.steps.length, done = this.steps.filter((one) => one.done).length;
    const texts = {count: (step ? `Step ${this.at + 1} of ${count}` : "Finished") + ` · ${done} done`,
      title: step ? `${step.tier}, ${step.part}` : "All steps are done",
      indices: step ? step.indices : "", depth: step ? step.depth : ""};
    for (const [name, text] of Object.entries(texts)) by_id("step-" + name).textContent = text;
    const [angle, sigma] = step ? step.angle.split(/\s*±\s*/) : [];
    by_id("step-angle").replaceChildren(...(step ? [`${angle}°`] : []), ...(sigma ? [" ", made("small", {}, `± ${sigma}°`)] : []));
    by_id("step-words").hidden = !step;
    by_id("step-done").disabled = !step;
    by_id("step-done").textContent = step && step.done ? "Next" : "Done, next";
    by_id("step-back").disabled = this.at === 0;
    by_id("steps").replaceChildren(...this.steps.map((one, i) => made("li", {},
      made("button", {type: "button", "aria-current": i === this.at ? "step" : null, onclick: () => { this.look_at(i); by_id("step-done").focus(); }},
        made("span", {"aria-hidden": "true"}, one.done ? "✓" : "○"), made("span", {class: "unseen"}, one.done ? "done, " : "to do, "), ` ${one.tier} ${one.angle.split(/\s*±/)[0]}°`))));
    by_id("bench-note").textContent = `${this.bench[this.of].note} ${this.bench[this.of].about} Marks are kept in ${this.bench.file}.`.trim();
    this.view.light(step ? step.facets : []);
  }

  look_at(i) {
    this.at = Math.min(Math.max(i, 0), this.steps.length);
    this.looks = true;
    this.draw();
  }

  go_to_facet(name) {
    const i = this.steps.findIndex((step) => step.facets.includes(name));
    if (i >= 0) this.look_at(i);
  }

  done() {
    if (!this.step()) return;
    this.mark(this.at, true);
    const next = this.steps.findIndex((step, i) => i > this.at && !step.done);
    this.at = next < 0 ? this.first_open() : next;
    this.moved();
  }

  back() {
    if (this.at === 0) return;
    --this.at;
    this.mark(this.at, false);
    this.moved();
  }

  moved() {
    this.looks = false;
    this.draw();
  }

  /** Shown at once; one after the other, so that the last word is the last key. */
  mark(i, done) {
    if (this.steps[i].done === done) return;
    this.steps[i].done = done;
    ++this.marks;
    const asked = {opened: this.bench.opened, step: i + 1, tier: this.steps[i].tier, done};
    this.last = this.last.then(async () => { if (!await call("/api/bench/mark", asked)) this.show(); });
  }

  on_key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || !this.bench) return;
    const acts = {Backspace: () => this.back(), ArrowLeft: () => this.look_at(this.at - 1), ArrowRight: () => this.look_at(this.at + 1)};
    if (event.target.closest("input")) return;
    // A button takes Space itself.
    if (!event.target.closest("button")) acts[" "] = () => event.repeat || this.done();
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }
}
