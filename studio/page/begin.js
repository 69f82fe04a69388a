// The begin screen: a cut with sliders, a file, or a stone that is there.

class BeginScreen {
  constructor() {
    this.view = new StoneView(by_id("cut-views"), () => {});
    by_id("cut-kind").addEventListener("change", () => this.choose());
    by_id("cut-form").addEventListener("submit", (event) => {
      event.preventDefault();
      call("/api/begin/cut", {...this.values(), material: by_id("cut-material").value.trim()});
    });
    by_id("words-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.describe(by_id("words").value.trim());
    });
    by_id("file").addEventListener("change", (event) => this.take(event.target.files[0]));
    take_drops(by_id("drop"), (file) => this.take(file));
  }

  async show() {
    const begin = await call("/api/begin");
    if (!begin) return;
    this.cuts = begin.cuts;
    const kind = by_id("cut-kind"), before = kind.value;
    kind.replaceChildren(...begin.cuts.map((cut) => made("option", {value: cut.name}, cut.name)));
    if (before) kind.value = before;
    by_id("materials").replaceChildren(...begin.materials.map((name) => made("option", {value: name})));
    by_id("begin-folder").textContent = begin.folder;
    const list = (files, recent) => files.map((file) => made("button", {type: "button", onclick: () => call("/api/begin/open", {recent, file})}, file));
    const stones = [...list(begin.stones, false), ...list(begin.recent.filter((file) => !begin.stones.includes(file)), true)];
    by_id("stones").replaceChildren(...(stones.length ? stones : [made("p", {class: "note"}, "None in this folder, and none was opened before.")]));
    by_id("samples").replaceChildren(...begin.samples.map((sample) => made("button", {type: "button", onclick: () => call("/api/begin/sample", {name: sample.name})}, made("b", {}, sample.name), `: ${sample.words}`)));
    if (!before) this.choose();
  }

  /** Words choose the cut, its sliders and the material. */
  async describe(text) {
    const stone = await call("/api/begin/words", {text});
    if (!stone) return;
    by_id("cut-kind").value = stone.kind;
    by_id("cut-material").value = stone.material;
    by_id("words-notes").textContent = stone.notes.join("; ") + (stone.notes.length ? "." : "");
    this.choose();
    for (const input of by_id("cut-sliders").querySelectorAll("input")) {
      const value = stone.values[input.dataset.name || input.nextElementSibling.dataset.name];
      if (value !== undefined) input.value = Number(value.toPrecision(6));
    }
    this.preview();
    by_id("cut-make").focus();
  }

  choose() {
    const cut = this.cuts.find((one) => one.name === by_id("cut-kind").value);
    by_id("cut-summary").textContent = cut.summary;
    by_id("cut-sliders").replaceChildren(...cut.parameters.map((p) => {
      const label = `${p.name.replaceAll("-", " ")}${p.unit ? ", " + p.unit : ""}`;
      const range = {min: p.least, max: p.most, value: p.value, step: "any", title: p.what, "aria-label": label};
      // The largest stones would leave the usual ones a hair of the slider.
      const most = p.unit === "mm" ? Math.min(p.most, 4 * p.value) : p.most;
      const slider = made("input", {type: "range", ...range, max: most}), number = made("input", {type: "number", ...range, "data-name": p.name});
      slider.addEventListener("input", () => { number.value = Number(Number(slider.value).toPrecision(4)); this.preview(); });
      number.addEventListener("input", () => { slider.value = number.value; this.preview(); });
      return made("div", {class: "field"}, made("span", {title: p.what}, label), slider, number);
    }));
    this.preview();
  }

  values() {
    const values = {};
    for (const input of by_id("cut-sliders").querySelectorAll("[data-name]")) {
      // Only what was moved: other defaults may follow from it.
      if (input.value !== input.defaultValue && input.value !== "") values[input.dataset.name] = Number(input.value);
    }
    return {kind: by_id("cut-kind").value, values};
  }

  /** One question at a time; the last position of a slider is always asked. */
  async preview() {
    this.again = true;
    if (this.asks) return;
    this.asks = true;
    while (this.again) {
      this.again = false;
      const drawings = await call("/api/begin/preview", this.values());
      if (drawings) { show_trouble(""); this.view.show(drawings.mesh); }
    }
    this.asks = false;
  }

  async take(file) {
    const most = 64 << 20;
    if (file && file.size > most) show_trouble(`${file.name} is larger than 64 MB: copy it into a folder, and start the studio with it.`);
    else if (file) await call("/api/begin/upload", file, `&name=${encodeURIComponent(file.name)}`);
    by_id("file").value = "";
  }
}
